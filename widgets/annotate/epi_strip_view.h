// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/outline.h"

#include <QColor>
#include <QImage>
#include <QString>
#include <QWidget>

#include <vector>

namespace episcope {

/// EPIs through a label, one below the other, with the boundaries of labels drawn: those of the
/// label in its colour, others thin. Each EPI is stretched to the width of the widget.
class EpiStripView : public QWidget {
  Q_OBJECT

 public:
  struct Epi {
    QString caption;        ///< "row 120"
    QImage picture;         ///< A row for each view.
    PixelEdges boundaries;  ///< Of the label, in pixels of the picture,
    PixelEdges others;      ///< and between others.
  };

  explicit EpiStripView(QWidget* parent = nullptr);

  /// `current_view`: the row of all EPIs that is marked.
  void setEpis(std::vector<Epi> epis, const QColor& color, int current_view);
  /// Shown without EPIs.
  void setHint(const QString& hint);
  [[nodiscard]] int count() const { return static_cast<int>(epis_.size()); }
  [[nodiscard]] const std::vector<Epi>& epis() const { return epis_; }
  /// Where an EPI is, in widget coordinates.
  [[nodiscard]] QRectF areaOf(int index) const;

  [[nodiscard]] QSize sizeHint() const override;

 signals:
  /// A click on a pixel of an EPI: which one, the view and the place on the line.
  void clicked(int index, int view, int place);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  void paintEpi(QPainter& painter, int index) const;

  std::vector<Epi> epis_;
  QColor color_;
  int current_view_ = 0;
  QString hint_;
};

}  // namespace episcope
