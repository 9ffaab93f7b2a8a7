// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "widgets/canvas/canvas_geometry.h"

#include <QColor>
#include <QImage>
#include <QLabel>
#include <QString>
#include <QWidget>

#include <cstdint>
#include <vector>

class QAction;
class QGridLayout;
class QTreeWidget;

namespace episcope {

/// Places to check in the labels of a view: uncertain regions, amounts of labels, islands and
/// holes. Setters never emit; a click on a row is a signal.
class LabelReviewPanel : public QWidget {
  Q_OBJECT

 public:
  /// An uncertain region.
  struct Doubt {
    LabelInfo label;
    LabelInfo rival;
    int pixels = 0;
  };
  struct Row {
    LabelInfo label;
    std::int64_t pixels = 0;
    QString share;   ///< "12.4 %"
    QString mean{};  ///< Mean disparity: "0.42"; may be empty, like the next two.
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

  explicit LabelReviewPanel(QWidget* parent = nullptr);

  /// Adds a button above the lists, in order of the calls.
  void addAction(QAction* action);
  /// Sentence above the lists; empty = none.
  void setNote(const QString& sentence);
  void setDoubts(const std::vector<Doubt>& doubts);
  /// −1 = none.
  void setCurrentDoubt(int index);
  void setRows(const std::vector<Row>& rows, int current_label);
  void setPieces(const QString& title, const std::vector<Piece>& pieces);
  [[nodiscard]] QString note() const { return note_->text(); }

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

/// EPIs through a label, one below the other, with label boundaries: the label's own in its color,
/// others thin. Each EPI is stretched to the widget's width.
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

  /// `current_view`: the row marked in all EPIs.
  void setEpis(std::vector<Epi> epis, const QColor& color, int current_view);
  /// Text shown without EPIs.
  void setHint(const QString& hint);
  [[nodiscard]] int count() const { return static_cast<int>(epis_.size()); }
  [[nodiscard]] const std::vector<Epi>& epis() const { return epis_; }
  /// Area of an EPI in widget coordinates.
  [[nodiscard]] QRectF areaOf(int index) const;

  [[nodiscard]] QSize sizeHint() const override;

 signals:
  /// The user clicked a pixel of an EPI: index of the EPI, view, and place on the line.
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
