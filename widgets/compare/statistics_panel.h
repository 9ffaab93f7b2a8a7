// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/region_statistics.h"
#include "engine/render/shade.h"

#include <QString>
#include <QWidget>

#include <array>
#include <optional>

class QGridLayout;
class QLabel;

namespace episcope {

class ElidedLabel;
class HistogramView;
class NumberSpin;

/// What is in sight of a map: a histogram and a few numbers. Setters never emit.
class StatisticsPanel : public QWidget {
  Q_OBJECT

 public:
  struct Summary {
    QString title;  ///< "error of EPI_L"
    QString unit;   ///< "px"; may be empty.
    render::RegionStatistics statistics;
    std::optional<double> bad_percent;  ///< Off by more than the threshold.
    render::Shading shading;
  };

  explicit StatisticsPanel(QWidget* parent = nullptr);

  void setSummary(const Summary& summary);
  void setBadThreshold(double threshold_px);
  /// No map: says why.
  void clear(const QString& why);
  /// "min −0.120, median …", "–" where nothing is known.
  [[nodiscard]] QString text() const;

 signals:
  void rangeEdited(episcope::Interval range);
  void badThresholdEdited(double threshold_px);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void addThreshold(QGridLayout& layout);
  void updateColors();

  ElidedLabel* title_;
  HistogramView* histogram_;
  std::array<QLabel*, 6> names_;
  std::array<QLabel*, 6> values_;
  NumberSpin* threshold_;
};

}  // namespace episcope
