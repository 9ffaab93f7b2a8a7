// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

namespace episcope {

class ElidedLabel;
class LinePlot;
struct Plot;

/// Errors by true disparity: two plots under each other, or why there are none.
class ErrorPlotPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ErrorPlotPanel(QWidget* parent = nullptr);

  void setPlots(const QString& title, const Plot& squares, const Plot& bad);
  /// No plots: says why.
  void clear(const QString& why);

 private:
  ElidedLabel* title_;
  LinePlot* squares_;
  LinePlot* bad_;
};

}  // namespace episcope
