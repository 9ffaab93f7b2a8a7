// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/label_review_panel.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QEvent>
#include <QGridLayout>
#include <QHeaderView>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kActionColumns = 2;  // Their texts are long.
constexpr int kWidestName = 140;

// Columns with numbers in the list of labels.
enum { kPixelColumn = 1, kShareColumn, kMeanColumn, kMinColumn, kMaxColumn };

QString count_text(std::int64_t count) {
  return QLocale::c().toString(static_cast<qlonglong>(count));
}

// The first columns are names, the others numbers.
QTreeWidgetItem* add_row(QTreeWidget* list, const QStringList& texts, int names) {
  auto* item = new QTreeWidgetItem(list, texts);
  for (int column = 0; column < names; ++column) item->setToolTip(column, texts[column]);
  for (int column = names; column < texts.size(); ++column) {
    item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  return item;
}

}  // namespace

LabelReviewPanel::LabelReviewPanel(QWidget* parent)
    : QWidget(parent),
      actions_(new QGridLayout),
      note_(named("check.note", new QLabel(this))),
      pieces_title_(named("check.piecesTitle", new QLabel(this))),
      doubts_(makeList("check.doubts", tr("Regions in doubt"),
                       {tr("Label"), tr("or perhaps"), tr("Pixels")})),
      labels_(makeList("check.labels", tr("Labels of this view"),
                       {tr("Label"), tr("Pixels"), tr("Share"), tr("Mean"), tr("Min"), tr("Max"),
                        tr("Islands"), tr("Holes")})),
      pieces_(makeList("check.pieces", tr("Islands and holes"),
                       {tr("Kind"), tr("Label"), tr("Pixels")})) {
  setObjectName("checkPanel");
  note_->setTextFormat(Qt::PlainText);
  note_->setWordWrap(true);
  pieces_title_->setTextFormat(Qt::PlainText);
  actions_->setSpacing(2);
  actions_->setColumnStretch(kActionColumns, 1);
  doubts_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  pieces_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  pieces_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  labels_->viewport()->installEventFilter(this);
  make_column(this,
              {actions_,
               note_,
               new QLabel(tr("Where a stroke would help most"), this),
               {doubts_, 2},
               new QLabel(tr("Labels of this view"), this),
               {labels_, 3},
               pieces_title_,
               {pieces_, 2}},
              {.margins = {0, theme::kSpacing, 0, 0}, .spacing = 4});
  const auto row_of = [](QTreeWidget* list, QTreeWidgetItem* item) {
    return list->indexOfTopLevelItem(item);
  };
  connect(doubts_, &QTreeWidget::itemClicked, this,
          [this, row_of](QTreeWidgetItem* item) { emit doubtChosen(row_of(doubts_, item)); });
  connect(pieces_, &QTreeWidget::itemClicked, this,
          [this, row_of](QTreeWidgetItem* item) { emit pieceChosen(row_of(pieces_, item)); });
  connect(labels_, &QTreeWidget::itemClicked, this, [this](const QTreeWidgetItem* item) {
    emit labelChosen(item->data(0, Qt::UserRole).toInt());
  });
}

QTreeWidget* LabelReviewPanel::makeList(const QString& name, const QString& title,
                                        const QStringList& columns) {
  auto* list = make_list(name, title, this);
  list->setHeaderLabels(columns);
  list->setIconSize({kSwatchSize, kSwatchSize});
  list->setMinimumHeight(60);
  list->header()->setMinimumSectionSize(30);
  list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  // Enter on a row does what a click does.
  connect(list, &QTreeWidget::itemActivated, list, &QTreeWidget::itemClicked);
  return list;
}

void LabelReviewPanel::addAction(QAction* action) {
  const int place = actions_->count();
  actions_->addWidget(make_action_button(action, this), place / kActionColumns,
                      place % kActionColumns, Qt::AlignLeft);
}

void LabelReviewPanel::setNote(const QString& sentence) {
  note_->setText(sentence);
  note_->setVisible(!sentence.isEmpty());
}

void LabelReviewPanel::setDoubts(const std::vector<Doubt>& doubts) {
  doubts_->clear();
  for (const Doubt& doubt : doubts) {
    auto* item = add_row(
        doubts_, {label_name(doubt.label), label_name(doubt.rival), count_text(doubt.pixels)}, 2);
    item->setIcon(0, swatch(doubt.label.color, palette()));
    item->setIcon(1, swatch(doubt.rival.color, palette()));
  }
}

void LabelReviewPanel::setCurrentDoubt(int index) {
  Quietly(doubts_)->setCurrentItem(index < 0 ? nullptr : doubts_->topLevelItem(index));
}

void LabelReviewPanel::setRows(const std::vector<Row>& rows, int current_label) {
  const QSignalBlocker blocker(labels_);
  labels_->clear();
  for (const Row& row : rows) {
    auto* item = add_row(labels_,
                         {label_name(row.label), count_text(row.pixels), row.share, row.mean,
                          row.min, row.max, count_text(row.islands), count_text(row.holes)},
                         1);
    item->setIcon(0, swatch(row.label.color, palette()));
    item->setData(0, Qt::UserRole, row.label.id);
    item->setToolTip(kPixelColumn, row.share);
    for (const int column : {kMeanColumn, kMinColumn, kMaxColumn})
      item->setToolTip(column, row.tip);
    if (row.label.id == current_label) labels_->setCurrentItem(item);
  }
  fitNames();
}

bool LabelReviewPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == labels_->viewport() && event->type() == QEvent::Resize) fitNames();
  return QWidget::eventFilter(watched, event);
}

// Names have priority over numbers: the share moves to the tool tip of the pixels, then the list
// scrolls.
void LabelReviewPanel::fitNames() {
  QHeaderView& header = *labels_->header();
  const QAbstractItemView& cells = *labels_;
  const auto width_of = [&](int column) {
    return std::max(header.sectionSizeHint(column), cells.sizeHintForColumn(column));
  };
  header.setSectionHidden(kShareColumn, false);  // What is hidden has no width.
  const int share = width_of(kShareColumn);
  const int name = std::min(width_of(0), kWidestName);
  int all = name;
  for (int column = 1; column < header.count(); ++column) all += width_of(column);
  const int room = labels_->viewport()->width();
  header.setSectionHidden(kShareColumn, all > room);
  const bool has_room = (all > room ? all - share : all) <= room;
  header.setSectionResizeMode(0, has_room ? QHeaderView::Stretch : QHeaderView::Fixed);
  if (!has_room) header.resizeSection(0, name);
}

void LabelReviewPanel::setPieces(const QString& title, const std::vector<Piece>& pieces) {
  pieces_title_->setText(title);
  pieces_->clear();
  for (const Piece& piece : pieces) {
    auto* item =
        add_row(pieces_, {piece.kind, label_name(piece.label), count_text(piece.pixels)}, 2);
    item->setIcon(1, swatch(piece.label.color, palette()));
  }
}

namespace {

constexpr int kViewHeight = 7;  // of a row of an EPI
constexpr int kStripGap = 6;

void draw_edges(QPainter& painter, const PixelEdges& edges, const QRectF& area, const QSize& pixels,
                const QPen& pen) {
  const double across = area.width() / pixels.width();
  const double down = area.height() / pixels.height();
  QList<QLineF> lines;
  for (const QLine& edge : edges) {
    lines << QLineF(area.left() + edge.x1() * across, area.top() + edge.y1() * down,
                    area.left() + edge.x2() * across, area.top() + edge.y2() * down);
  }
  painter.setPen(pen);
  painter.drawLines(lines);
}

}  // namespace

EpiStripView::EpiStripView(QWidget* parent) : QWidget(parent) {
  setObjectName("epiStrip");
  setAccessibleName(tr("EPIs through the label"));
}

void EpiStripView::setEpis(std::vector<Epi> epis, const QColor& color, int current_view) {
  epis_ = std::move(epis);
  color_ = color;
  current_view_ = current_view;
  setMinimumHeight(sizeHint().height());
  updateGeometry();
  update();
}

void EpiStripView::setHint(const QString& hint) {
  hint_ = hint;
  update();
}

QRectF EpiStripView::areaOf(int index) const {
  const int text = fontMetrics().height();
  double y = kStripGap;
  for (int i = 0; i < index; ++i) {
    y += text + epis_[static_cast<std::size_t>(i)].picture.height() * kViewHeight + kStripGap;
  }
  const QImage& picture = epis_[static_cast<std::size_t>(index)].picture;
  return {1.0 * kStripGap, y + text, width() - 2.0 * kStripGap,
          1.0 * picture.height() * kViewHeight};
}

QSize EpiStripView::sizeHint() const {
  const int height =
      epis_.empty() ? 120 : static_cast<int>(areaOf(count() - 1).bottom()) + kStripGap;
  return {560, height};
}

void EpiStripView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::kCanvas);
  if (epis_.empty()) {
    painter.setPen(theme::kCanvasText);
    painter.drawText(rect().adjusted(kStripGap, kStripGap, -kStripGap, -kStripGap),
                     Qt::AlignCenter | Qt::TextWordWrap, hint_);
  }
  for (int i = 0; i < count(); ++i) paintEpi(painter, i);
}

void EpiStripView::paintEpi(QPainter& painter, int index) const {
  const Epi& epi = epis_[static_cast<std::size_t>(index)];
  const QRectF area = areaOf(index);
  painter.setPen(theme::kCanvasMuted);
  painter.drawText(QPointF(area.left(), area.top() - fontMetrics().descent()), epi.caption);
  painter.drawImage(area, epi.picture);
  draw_edges(painter, epi.others, area, epi.picture.size(), QPen(QColor(255, 255, 255, 130), 1));
  draw_edges(painter, epi.boundaries, area, epi.picture.size(),
             QPen(QColor(0, 0, 0, 170), 4, Qt::SolidLine, Qt::FlatCap));
  draw_edges(painter, epi.boundaries, area, epi.picture.size(),
             QPen(color_, 2, Qt::SolidLine, Qt::SquareCap));
  const double y = area.top() + (current_view_ + 0.5) * kViewHeight;
  painter.setPen(QPen(theme::kCrossHair, 1));
  painter.drawLine(QPointF(area.left() - kStripGap + 1, y), QPointF(area.left() - 1, y));
  painter.drawLine(QPointF(area.right() + 1, y), QPointF(area.right() + kStripGap - 1, y));
}

void EpiStripView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  for (int i = 0; i < count(); ++i) {
    const QRectF area = areaOf(i);
    if (!area.contains(event->position())) continue;
    const QSize pixels = epis_[static_cast<std::size_t>(i)].picture.size();
    const QPointF at = event->position() - area.topLeft();
    const auto place = static_cast<int>(at.x() / area.width() * pixels.width());
    const auto view = static_cast<int>(at.y() / kViewHeight);
    emit clicked(i, std::min(view, pixels.height() - 1), std::min(place, pixels.width() - 1));
    return;
  }
}

}  // namespace episcope

#include "moc_label_review_panel.cpp"
