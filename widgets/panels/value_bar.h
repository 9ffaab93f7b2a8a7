// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/render/shade.h"
#include "widgets/controls/labels.h"

#include <QColor>
#include <QLabel>
#include <QString>
#include <QStringList>
#include <QWidget>

#include <optional>
#include <vector>

class QSlider;

namespace episcope {

/// Value of one estimate at the cursor.
struct EstimateReading {
  QString name;
  std::optional<double> disparity_px;  ///< None = invalid there.
  /// Disparity of the second surface, where two are visible.
  std::optional<double> background_px = {};
};

/// Everything known about one pixel.
struct PixelReading {
  PixelIndex pixel;
  QString samples;  ///< As stored, e.g. "120 88 40"; color of the swatch beside it:
  QColor color;
  bool has_truth = false;          ///< The scene has truth for this view;
  std::optional<double> truth_px;  ///< none = invalid at this pixel.
  std::vector<EstimateReading> estimates;
  std::optional<double> background_truth_px = {};  ///< Second surface, where two are visible.
  QStringList labels{};                            ///< Painted, segmented and true ones.
};

/// The line at the bottom: pixel, color, labels, truth, every estimate with its difference
/// (estimate − truth), and on the right a short state ("1 job · ready").
class ValueBar : public QWidget {
  Q_OBJECT

 public:
  explicit ValueBar(QWidget* parent = nullptr);

  /// None = the cursor is not on a pixel.
  void setReading(const std::optional<PixelReading>& reading);
  void setStatus(const QString& status) { status_->setText(status); }

  /// The line as plain text, e.g. "x 301 y 417 · rgb 120 88 40 · truth 0.312 · EPI_S 0.318
  /// (−0.006)".
  [[nodiscard]] QString text() const { return values_->fullText(); }

 private:
  void updateColors();

  bool has_reading_ = false;
  QLabel* swatch_;
  PartsLabel* values_;
  QLabel* status_;
};

class NumberSpin;

/// Exposure, gamma and black point of displayed views. Setters never emit.
class TonePanel : public QWidget {
  Q_OBJECT

 public:
  explicit TonePanel(QWidget* parent = nullptr);

  void setTone(const render::Tone& tone);
  [[nodiscard]] render::Tone tone() const;

 signals:
  void toneEdited(const episcope::render::Tone& tone);
  void automaticRequested();

 private:
  /// A number with slider and field.
  struct Row {
    QSlider* slider = nullptr;
    NumberSpin* field = nullptr;
  };
  struct Quality {
    const char* name;
    QString text;
    QString tip;
    Interval range;
    QString suffix;
  };

  Row addRow(int place, const Quality& quality);
  void addButtons();
  /// Adds the text on what brightness affects.
  void addReach();
  void showRow(const Row& row, double value);

  Row exposure_;
  Row gamma_;
  Row black_;
};

}  // namespace episcope
