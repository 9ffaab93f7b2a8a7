// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/tone.h"

#include <QWidget>

class QSlider;

namespace episcope {

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
