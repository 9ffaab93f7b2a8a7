// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"
#include "widgets/canvas/canvas_geometry.h"

#include <QColor>
#include <QImage>
#include <QString>
#include <QWidget>

#include <cstdint>
#include <vector>

class QAction;
class QGridLayout;
class QLabel;
class QTreeWidget;

namespace episcope {

/// What there is to check in the labels of a view: where a stroke would help, how much of each
/// label there is, its islands and holes. Setters never emit; a click on a row is a signal.
class CheckPanel : public QWidget {
  Q_OBJECT

 public:
  /// A region in doubt.
  struct Doubt {
    LabelInfo label;
    LabelInfo rival;
    int pixels = 0;
  };
  /// A label of the view, as text.
  struct Row {
    LabelInfo label;
    std::int64_t pixels = 0;
    QString share;   ///< "12.4 %"
    QString mean{};  ///< Of the disparity, as the next two: "0.42"; may be empty.
    QString min{};
    QString max{};
    int islands = 0;
    int holes = 0;
    QString tip{};  ///< More on the disparity.
  };
  /// An island or hole of the current label.
  struct Piece {
    QString kind;     ///< "hole"
    LabelInfo label;  ///< It has.
    int pixels = 0;
  };

  explicit CheckPanel(QWidget* parent = nullptr);

  /// Buttons above the lists, in order of the calls.
  void addAction(QAction* action, const QString& object_name);
  /// What is said above the lists; empty = nothing.
  void setNote(const QString& sentence);
  void setDoubts(const std::vector<Doubt>& doubts);
  /// −1 = none.
  void setCurrentDoubt(int index);
  void setRows(const std::vector<Row>& rows, int current_label);
  void setPieces(const QString& title, const std::vector<Piece>& pieces);
  [[nodiscard]] QString note() const;

 signals:
  void doubtChosen(int index);
  void labelChosen(int id);
  void pieceChosen(int index);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] QTreeWidget* makeList(const QString& name, const QString& title,
                                      const QStringList& columns);
  void fitNames();

  QGridLayout* actions_;
  QLabel* note_;
  QLabel* pieces_title_;
  QTreeWidget* doubts_;
  QTreeWidget* labels_;
  QTreeWidget* pieces_;
};

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
