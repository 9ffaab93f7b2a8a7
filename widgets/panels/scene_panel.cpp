// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/scene_panel.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QApplication>
#include <QCollator>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalBlocker>
#include <QSlider>
#include <QSortFilterProxyModel>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QStyledItemDelegate>
#include <QToolButton>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

/// Paints a light field of a SceneList: thumbnail, name, form and shape, and what it comes with or
/// why it cannot be opened, one line each, elided where they do not fit.
class SceneDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                               const QModelIndex& index) const override;
};

constexpr int kLines = 3;
constexpr int kItemPadding = 6;
constexpr double kThumbnailAspect = 4.0 / 3;
constexpr int kMarkWidth = 3;
constexpr int kProblemLines = 6;

int line_height(const QStyleOptionViewItem& option) {
  return option.fontMetrics.height() + 2;
}

QRect thumbnail_place(const QStyleOptionViewItem& option) {
  const int height = kLines * line_height(option);
  return {option.rect.left() + kItemPadding, option.rect.top() + kItemPadding,
          static_cast<int>(height * kThumbnailAspect), height};
}

void paint_thumbnail(QPainter* painter, const QRect& place, const QImage& image) {
  painter->fillRect(place, theme::kCanvas);
  if (image.isNull()) return;
  const qreal ratio = painter->device()->devicePixelRatioF();
  QImage scaled = image.scaled(place.size() * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  scaled.setDevicePixelRatio(ratio);
  QRect target({}, scaled.deviceIndependentSize().toSize());
  target.moveCenter(place.center());
  painter->drawImage(target.topLeft(), scaled);
}

struct Line {
  QString text;
  QColor color;
  bool is_bold = false;
};

std::vector<Line> lines_of(const QStyleOptionViewItem& option, const QModelIndex& index) {
  const bool is_selected = option.state.testFlag(QStyle::State_Selected);
  const QPalette& palette = option.palette;
  const QColor text = palette.color(is_selected ? QPalette::HighlightedText : QPalette::Text);
  const QColor quiet = is_selected ? text : theme::muted_text(palette);
  const QString problem = index.data(SceneList::kProblem).toString();
  const QString shape = index.data(SceneList::kShape).toString();
  QString form = index.data(SceneList::kForm).toString();
  if (!shape.isEmpty()) form += QStringLiteral(" · ") + shape;
  const QString parts = index.data(SceneList::kParts).toStringList().join(QStringLiteral(" · "));
  const bool is_bad = !problem.isEmpty();
  return {{index.data(Qt::DisplayRole).toString(), text, true},
          {form, quiet},
          {is_bad ? problem : parts, is_bad && !is_selected ? theme::error_text(palette) : quiet}};
}

QSize SceneDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
  return {10 * kItemPadding, kLines * line_height(option) + 2 * kItemPadding};
}

void SceneDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                          const QModelIndex& index) const {
  painter->save();
  const QStyle* style = option.widget ? option.widget->style() : QApplication::style();
  style->drawPrimitive(QStyle::PE_PanelItemViewItem, &option, painter, option.widget);
  if (index.data(SceneList::kIsOpen).toBool()) {
    painter->fillRect(QRect(option.rect.topLeft(), QSize(kMarkWidth, option.rect.height())),
                      option.palette.color(QPalette::Highlight));
  }
  const QRect picture = thumbnail_place(option);
  paint_thumbnail(painter, picture, index.data(Qt::DecorationRole).value<QImage>());
  const int left = picture.right() + 1 + 2 * kItemPadding;
  const int width = std::max(0, option.rect.right() - kItemPadding - left);
  int top = picture.top();
  for (const Line& line : lines_of(option, index)) {
    QFont font = option.font;
    font.setBold(line.is_bold);
    painter->setFont(font);
    painter->setPen(line.color);
    const QRect place(left, top, width, line_height(option));
    painter->drawText(place, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                      QFontMetrics(font).elidedText(line.text, Qt::ElideRight, width));
    top += line_height(option);
  }
  painter->restore();
}

/// Sorted by a role, then by name; "scene 9" comes before "scene 10".
class ShownScenes : public QSortFilterProxyModel {
 public:
  explicit ShownScenes(QObject* parent)
      : QSortFilterProxyModel(parent), names_(QLocale(QLocale::English)) {  // "C" has no numbers
    names_.setNumericMode(true);
    names_.setCaseSensitivity(Qt::CaseInsensitive);
    setFilterRole(SceneList::kSearchText);
    setFilterCaseSensitivity(Qt::CaseInsensitive);
  }

 protected:
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override {
    const QVariant a = left.data(sortRole());
    const QVariant b = right.data(sortRole());
    if (sortRole() == SceneList::kHasTruth && a != b) return a.toBool();  // with truth first
    if (sortRole() == SceneList::kSamples && a != b) return a.toLongLong() < b.toLongLong();
    const int order = names_.compare(a.toString(), b.toString());
    if (order != 0 && (sortRole() == Qt::DisplayRole || sortRole() == SceneList::kForm)) {
      return order < 0;
    }
    const int by_name = names_.compare(left.data(Qt::DisplayRole).toString(),
                                       right.data(Qt::DisplayRole).toString());
    return by_name != 0
               ? by_name < 0
               : left.data(SceneList::kPath).toString() < right.data(SceneList::kPath).toString();
  }

 private:
  QCollator names_;
};

}  // namespace

ScenePanel::ScenePanel(SceneList* list, QWidget* parent)
    : QWidget(parent),
      list_(list),
      shown_(new ShownScenes(this)),
      filter_(named("scenes.filter", new QLineEdit(this))),
      order_(named("scenes.order", new QComboBox(this))),
      view_(named("scenes.list", new QListView(this))),
      hint_(named("scenes.hint", new QLabel(this))),
      problem_(named("scenes.problem", new FoldedLabel(this, kProblemLines))),
      folder_label_(new ElidedLabel(this, Qt::ElideMiddle)),
      count_(named("scenes.count", new ElidedLabel(this))),
      head_(new QWidget(this)) {
  setObjectName("scenePanel");
  shown_->setSourceModel(list);
  shown_->setDynamicSortFilter(true);
  view_->setAccessibleName(tr("Scenes"));
  filter_->setAccessibleName(tr("Filter"));
  order_->setAccessibleName(tr("Order"));
  view_->setModel(shown_);
  view_->setItemDelegate(new SceneDelegate(view_));
  view_->setUniformItemSizes(true);
  view_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  view_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  filter_->setPlaceholderText(tr("Filter: name, form, ground truth …"));
  filter_->setClearButtonEnabled(true);
  order_->setToolTip(tr("Order of the list"));
  order_->addItem(tr("Name"), Qt::DisplayRole);
  order_->addItem(tr("Form"), SceneList::kForm);
  order_->addItem(tr("Size"), SceneList::kSamples);
  order_->addItem(tr("Ground truth"), SceneList::kHasTruth);
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  buildRows();
  connect(filter_, &QLineEdit::textChanged, shown_, &QSortFilterProxyModel::setFilterFixedString);
  connect(order_, &QComboBox::currentIndexChanged, this, &ScenePanel::sort);
  connect(view_, &QListView::activated, this, [this](const QModelIndex& index) {
    emit openRequested(index.data(SceneList::kPath).toString());
  });
  connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          &ScenePanel::showProblem);
  connect(shown_, &QAbstractItemModel::rowsInserted, this, &ScenePanel::showCount);
  connect(shown_, &QAbstractItemModel::rowsRemoved, this, &ScenePanel::showCount);
  connect(shown_, &QAbstractItemModel::modelReset, this, &ScenePanel::showCount);
  sort();
  setFolder({}, false);
}

void ScenePanel::buildRows() {
  make_row(head_, {{filter_, 1}, order_}, {.spacing = theme::kSpacing});
  make_column(this, {folder_label_, head_, {view_, 1}, {hint_, 1}, problem_, count_},
              {.margins = {theme::kMargin, theme::kMargin, theme::kMargin, theme::kMargin},
               .spacing = theme::kSpacing});
}

void ScenePanel::setOpenAction(QAction* action) {
  head_->layout()->addWidget(make_action_button(action, this));
}

void ScenePanel::setFolder(const QString& folder, bool is_searching) {
  folder_ = folder;
  is_searching_ = is_searching;
  folder_label_->setFullText(folder);
  folder_label_->setVisible(!folder.isEmpty());
  showCount();
}

void ScenePanel::sort() {
  shown_->setSortRole(order_->currentData().toInt());
  shown_->sort(0);
}

QString ScenePanel::countText() const {
  const int all = list_->rowCount();
  const int shown = shown_->rowCount();
  int bad = 0;
  for (int row = 0; row < all; ++row) bad += list_->item(row).problem.isEmpty() ? 0 : 1;
  QString text = shown != all ? tr("%1 of %2 light fields").arg(shown).arg(all)
                 : all == 1   ? tr("1 light field")
                              : tr("%1 light fields").arg(all);
  if (bad > 0) text += tr(", %1 cannot be opened").arg(bad);
  return is_searching_ ? tr("Searching … %1").arg(text) : text;
}

void ScenePanel::showProblem() {
  const QString problem = view_->currentIndex().data(SceneList::kProblem).toString();
  problem_->setFullText(problem);
  problem_->setVisible(!problem.isEmpty());
}

void ScenePanel::showCount() {
  showProblem();
  const bool is_empty = list_->rowCount() == 0;
  const bool has_none = shown_->rowCount() == 0;
  view_->setVisible(!has_none);
  hint_->setVisible(has_none);
  filter_->setEnabled(!is_empty);
  order_->setEnabled(!is_empty);
  count_->setVisible(!folder_.isEmpty());
  count_->setFullText(countText());
  if (!is_empty) {
    hint_->setText(tr("No light field matches the filter."));
  } else if (folder_.isEmpty()) {
    hint_->setText(
        tr("Open a folder of light fields, or drop it here. Its subfolders are listed too."));
  } else {
    hint_->setText(is_searching_ ? tr("Searching …") : tr("There is no light field in here."));
  }
}

void ScenePanel::reveal(const QString& path) {
  for (int row = 0; row < shown_->rowCount(); ++row) {
    const QModelIndex index = shown_->index(row, 0);
    if (index.data(SceneList::kPath).toString() != path) continue;
    view_->setCurrentIndex(index);
    view_->scrollTo(index);
    return;
  }
}

QString ScenePanel::neighbour(const QString& path, int step) const {
  QStringList paths;
  for (int row = 0; row < shown_->rowCount(); ++row) {
    const QModelIndex index = shown_->index(row, 0);
    if (index.data(SceneList::kProblem).toString().isEmpty()) {
      paths += index.data(SceneList::kPath).toString();
    }
  }
  const auto at = paths.indexOf(path);
  if (at < 0) return paths.isEmpty() ? QString() : step > 0 ? paths.first() : paths.last();
  return paths.value(at + step);
}

namespace {

constexpr int kFramesPerPage = 10;

/// A click beside the handle goes to that frame, not a page nearer to it.
class TimeSlider : public QSlider {
 public:
  using QSlider::QSlider;

 protected:
  void mousePressEvent(QMouseEvent* event) override {
    QStyleOptionSlider option;
    initStyleOption(&option);
    const QPoint at = event->position().toPoint();
    const auto part = style()->hitTestComplexControl(QStyle::CC_Slider, &option, at, this);
    if (event->button() != Qt::LeftButton || part == QStyle::SC_SliderHandle) {
      QSlider::mousePressEvent(event);
      return;
    }
    const int handle = style()->pixelMetric(QStyle::PM_SliderLength, &option, this);
    setValue(QStyle::sliderValueFromPosition(minimum(), maximum(), at.x() - handle / 2,
                                             width() - handle, option.upsideDown));
  }
};

}  // namespace

TimeBar::TimeBar(QWidget* parent)
    : QWidget(parent),
      slider_(named("time.slider", new TimeSlider(Qt::Horizontal, this))),
      number_(named("time.number", new QLabel(this))) {
  setObjectName("timeBar");
  slider_->setAccessibleName(tr("Frame"));
  slider_->setToolTip(tr("Frame of the sequence"));
  make_row(this, {{slider_, 1}, number_},
           {.margins = {theme::kMargin, 0, theme::kMargin, 0}, .spacing = theme::kSpacing});
  connect(slider_, &QSlider::valueChanged, this, [this](int frame) {
    showNumber();
    emit frameChosen(frame);
  });
}

void TimeBar::setPlayAction(QAction* action) {
  static_cast<QHBoxLayout*>(layout())->insertWidget(0, make_action_button(action, this));
}

void TimeBar::setFrame(int frame, int count) {
  const QSignalBlocker blocker(slider_);
  slider_->setRange(0, count - 1);
  slider_->setPageStep(std::clamp(count / kFramesPerPage, 1, kFramesPerPage));
  slider_->setValue(frame);
  const QString widest = tr("frame %1 of 0…%2").arg(count - 1).arg(count - 1);
  number_->setMinimumWidth(number_->fontMetrics().horizontalAdvance(widest));
  showNumber();
}

void TimeBar::showNumber() {
  number_->setText(tr("frame %1 of 0…%2").arg(slider_->value()).arg(slider_->maximum()));
}

namespace {

QString tool_tip(const SceneItem& item) {
  QStringList lines{item.name, item.path};
  if (!item.shape.isEmpty()) lines += QString("%1 · %2").arg(item.form, item.shape);
  lines += item.parts;
  if (!item.problem.isEmpty()) lines += item.problem;
  return lines.join('\n').toHtmlEscaped().replace('\n', "<br>");
}

}  // namespace

void SceneList::clear() {
  beginResetModel();
  rows_.clear();
  places_.clear();
  endResetModel();
}

void SceneList::add(const SceneItem& item) {
  const int row = rowOf(item.path);
  if (row >= 0) {
    rows_[row].item = item;
    emit dataChanged(index(row), index(row));
    return;
  }
  const int last = static_cast<int>(rows_.size());
  beginInsertRows({}, last, last);
  places_[item.path] = last;
  rows_.push_back({item, {}});
  endInsertRows();
}

void SceneList::setItems(const std::vector<SceneItem>& items) {
  QHash<QString, int> wanted;
  for (const SceneItem& item : items) wanted[item.path] = 0;
  for (int row = static_cast<int>(rows_.size()) - 1; row >= 0; --row) {
    if (wanted.contains(rows_[row].item.path)) continue;
    beginRemoveRows({}, row, row);
    rows_.erase(rows_.begin() + row);
    endRemoveRows();
  }
  places_.clear();
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    places_[rows_[row].item.path] = row;
  }
  for (const SceneItem& item : items) add(item);
}

void SceneList::setThumbnail(const QString& path, const QImage& thumbnail) {
  const int row = rowOf(path);
  if (row < 0) return;
  rows_[row].thumbnail = thumbnail;
  emit dataChanged(index(row), index(row), {Qt::DecorationRole});
}

void SceneList::setOpen(const QString& path) {
  const int before = rowOf(std::exchange(open_, path));
  for (const int row : {before, rowOf(path)}) {
    if (row >= 0) emit dataChanged(index(row), index(row), {kIsOpen});
  }
}

int SceneList::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

QVariant SceneList::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[index.row()];
  const SceneItem& item = row.item;
  switch (role) {
    case Qt::DisplayRole:
      return item.name;
    case Qt::DecorationRole:
      if (row.thumbnail.isNull() && !row.is_asked && item.problem.isEmpty()) {
        row.is_asked = true;
        emit thumbnailWanted(item.path);
      }
      return row.thumbnail;
    case Qt::ToolTipRole:
      return tool_tip(item);
    case kPath:
      return item.path;
    case kForm:
      return item.form;
    case kShape:
      return item.shape;
    case kParts:
      return item.parts;
    case kProblem:
      return item.problem;
    case kSamples:
      return item.samples;
    case kHasTruth:
      return item.has_truth;
    case kIsOpen:
      return item.path == open_;
    case kSearchText:
      return QStringList{item.path,    item.form,
                         item.shape,   item.parts.join(' '),
                         item.problem, item.has_truth ? tr("ground truth") : QString()}
          .join('\n');
    default:
      return {};
  }
}

}  // namespace episcope

#include "moc_scene_panel.cpp"
#include "scene_panel.moc"
