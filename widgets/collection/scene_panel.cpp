// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/collection/scene_panel.h"

#include "widgets/collection/scene_delegate.h"
#include "widgets/collection/scene_list.h"
#include "widgets/controls/elided_label.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QCollator>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QLocale>
#include <QSortFilterProxyModel>
#include <QToolButton>
#include <QVBoxLayout>

namespace episcope {
namespace {

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
      filter_(new QLineEdit(this)),
      order_(new QComboBox(this)),
      view_(new QListView(this)),
      hint_(new QLabel(this)),
      folder_label_(new ElidedLabel(this, Qt::ElideMiddle)),
      count_(new ElidedLabel(this)),
      head_(new QWidget(this)) {
  setObjectName("scenePanel");
  shown_->setSourceModel(list);
  shown_->setDynamicSortFilter(true);
  view_->setObjectName("scenes.list");
  view_->setAccessibleName(tr("Scenes"));
  filter_->setAccessibleName(tr("Filter"));
  order_->setAccessibleName(tr("Order"));
  view_->setModel(shown_);
  view_->setItemDelegate(new SceneDelegate(view_));
  view_->setUniformItemSizes(true);
  view_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  view_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  filter_->setObjectName("scenes.filter");
  filter_->setPlaceholderText(tr("Filter: name, form, truth …"));
  filter_->setClearButtonEnabled(true);
  order_->setObjectName("scenes.order");
  order_->setToolTip(tr("Order of the list"));
  order_->addItem(tr("Name"), Qt::DisplayRole);
  order_->addItem(tr("Form"), SceneList::kForm);
  order_->addItem(tr("Size"), SceneList::kSamples);
  order_->addItem(tr("Truth"), SceneList::kHasTruth);
  hint_->setObjectName("scenes.hint");
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  count_->setObjectName("scenes.count");
  buildRows();
  connect(filter_, &QLineEdit::textChanged, shown_, &QSortFilterProxyModel::setFilterFixedString);
  connect(order_, &QComboBox::currentIndexChanged, this, &ScenePanel::sort);
  connect(view_, &QListView::activated, this, [this](const QModelIndex& index) {
    emit openRequested(index.data(SceneList::kPath).toString());
  });
  connect(shown_, &QAbstractItemModel::rowsInserted, this, &ScenePanel::showCount);
  connect(shown_, &QAbstractItemModel::rowsRemoved, this, &ScenePanel::showCount);
  connect(shown_, &QAbstractItemModel::modelReset, this, &ScenePanel::showCount);
  sort();
  setFolder({}, false);
}

void ScenePanel::buildRows() {
  auto* row = new QHBoxLayout(head_);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(theme::kSpacing);
  row->addWidget(filter_, 1);
  row->addWidget(order_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(theme::kMargin, theme::kMargin, theme::kMargin, theme::kMargin);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(folder_label_);
  layout->addWidget(head_);
  layout->addWidget(view_, 1);
  layout->addWidget(hint_, 1);
  layout->addWidget(count_);
}

void ScenePanel::setOpenAction(QAction* action) {
  auto* button = make_action_button(action, "scenes.open", this);
  static_cast<QHBoxLayout*>(head_->layout())->addWidget(button);
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

void ScenePanel::showCount() {
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
        tr("Open a folder of light fields, or drop it here: all that it holds at any "
           "depth is listed."));
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

}  // namespace episcope

#include "moc_scene_panel.cpp"
