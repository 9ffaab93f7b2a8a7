// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QPalette>
#include <QPointF>
#include <QString>
#include <QWidget>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

class PlotChart;

struct PlotAxis {
  QString title;                ///< With its unit: "MSE×100 [px²]".
  bool is_logarithmic = false;  ///< Ignored if not all values are positive.
};

struct PlotSeries {
  QString name;                 ///< Shown in a legend, if there are several series.
  std::vector<QPointF> points;  ///< In order of x; points that are not finite are skipped.
};

struct Plot {
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
};

struct PlotPlace {
  std::size_t series = 0;
  std::size_t point = 0;
  friend bool operator==(const PlotPlace&, const PlotPlace&) = default;
};

enum class PlotMarker { Circle, Square, Diamond, Cross, Plus };

/// How a line of a plot looks: colors of Okabe and Ito, which the color-blind tell apart, and a
/// marker of its own, so that color is not the only difference.
struct SeriesLook {
  QColor color;  ///< Contrast ≥ 3 against the base of the palette.
  PlotMarker marker;
};

/// Colors repeat after six series, markers after five.
[[nodiscard]] SeriesLook series_look(std::size_t series, const QPalette& palette);

/// Lines over an axis, with their points. A click near a point chooses it; with the focus, arrows
/// walk over points and lines, and Return chooses. Setters never emit.
class LinePlot : public QWidget {
  Q_OBJECT

 public:
  explicit LinePlot(QWidget* parent = nullptr);
  ~LinePlot() override;

  void setPlot(const Plot& plot);
  /// Text shown without points.
  void setEmptyText(const QString& text);
  /// Marks a point; none = no mark.
  void setMark(std::optional<PlotPlace> place);

  [[nodiscard]] const Plot& plot() const { return plot_; }
  [[nodiscard]] const QString& emptyText() const { return empty_text_; }
  [[nodiscard]] std::optional<PlotPlace> mark() const { return mark_; }
  /// Last drawn position of a point, in widget coordinates.
  [[nodiscard]] QPointF positionOf(PlotPlace place) const;
  /// Nearest point within reach of the mouse.
  [[nodiscard]] std::optional<PlotPlace> placeAt(QPointF position) const;

  [[nodiscard]] QSize sizeHint() const override { return {320, 190}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {200, 70}; }

 signals:
  void pointChosen(episcope::PlotPlace place);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent*) override { setHovered(std::nullopt); }
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;

 private:
  [[nodiscard]] QPointF valueOf(PlotPlace place) const;
  [[nodiscard]] std::optional<PlotPlace> firstPoint() const;
  void walk(int points, int series);
  void setHovered(std::optional<PlotPlace> place);
  void paintMark(QPainter& painter, PlotPlace place, double radius) const;

  Plot plot_;
  QString empty_text_;
  std::unique_ptr<PlotChart> chart_;
  std::optional<PlotPlace> mark_;
  std::optional<PlotPlace> walked_;  // with the keys
  std::optional<PlotPlace> hovered_;
};

}  // namespace episcope
