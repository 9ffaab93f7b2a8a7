// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/label_palette.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QBoxLayout>
#include <QDropEvent>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>

namespace episcope {
namespace {

constexpr int kLabelRowPadding = 8;

enum LabelColumn { kColor, kId, kLabelName, kAmount, kShown, kLock, kLabelColumns };

int label_of(const QTreeWidgetItem* item) {
  return item->data(kColor, Qt::UserRole).toInt();
}

}  // namespace

LabelPalette::LabelPalette(QWidget* parent)
    : QWidget(parent),
      filter_(named("labels.filter", new QLineEdit(this))),
      tree_(make_list("labels.tree", tr("Labels"), this)),
      hint_(named("labels.hint", new QLabel(this))),
      add_(make_tool_button({"labels.add", "add", tr("Add a label"), tr("Add")}, this)),
      rename_(make_tool_button({"labels.rename", "rename", tr("Rename this label"), tr("Rename")},
                               this)),
      remove_(make_tool_button(
          {"labels.remove", "trash",
           tr("Remove this label and everything painted with it (Delete)"), tr("Remove")},
          this)) {
  setObjectName("labelPalette");
  setUpTree();
  setUpActions();
  hint_->setMargin(theme::kMargin);
  lay_out_list(this, hint_, tree_, {add_, rename_, remove_});
  filter_->setPlaceholderText(tr("Filter by name or number"));
  filter_->setAccessibleName(tr("Filter of labels"));
  filter_->setClearButtonEnabled(true);
  qobject_cast<QBoxLayout*>(layout())->insertWidget(0, filter_);
  connect(filter_, &QLineEdit::textChanged, this, &LabelPalette::filter);
  setLabels({});
}

void LabelPalette::setUpTree() {
  tree_->viewport()->installEventFilter(this);
  tree_->setColumnCount(kLabelColumns);
  tree_->setHeaderHidden(true);
  tree_->setIconSize({kSwatchSize, kSwatchSize});
  tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  tree_->setDragDropMode(QAbstractItemView::InternalMove);
  tree_->header()->setMinimumSectionSize(22);
  tree_->header()->setSectionResizeMode(kLabelName, QHeaderView::Stretch);
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (!item) return;
    current_ = label_of(item);
    markCurrent();
    emit currentChosen(current_);
  });
  connect(tree_, &QTreeWidget::itemDoubleClicked, this,
          [this](const QTreeWidgetItem* item) { editName(label_of(item)); });
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (column == kLabelName) emit renameRequested(label_of(item), item->text(kLabelName));
  });
  connect(tree_, &QTreeWidget::customContextMenuRequested, this, &LabelPalette::showMenu);
}

void LabelPalette::setUpActions() {
  connect(add_delete_action(tree_), &QAction::triggered, remove_, &QToolButton::click);
  connect(add_, &QToolButton::clicked, this, &LabelPalette::addRequested);
  connect(rename_, &QToolButton::clicked, this, [this] { editName(current_); });
  connect(remove_, &QToolButton::clicked, this, [this] { emit removeRequested(current_); });
}

void LabelPalette::setLabels(const std::vector<LabelInfo>& labels) {
  const QSignalBlocker blocker(tree_);
  labels_ = labels;
  const bool has_focus = tree_->hasFocus();
  tree_->clear();
  for (const LabelInfo& label : labels) {
    auto* item = new QTreeWidgetItem(tree_);
    const QString name = label_name(label);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable |
                   Qt::ItemIsDragEnabled);
    item->setData(kColor, Qt::UserRole, label.id);
    item->setIcon(kColor, swatch(label.color, palette()));
    item->setSizeHint(kColor, {0, fontMetrics().height() + kLabelRowPadding});
    item->setToolTip(kColor, tr("Click to change the color of “%1”").arg(name));
    item->setText(kId, QString::number(label.id));
    item->setTextAlignment(kId, Qt::AlignRight | Qt::AlignVCenter);
    item->setText(kLabelName, name);
    item->setToolTip(kLabelName, name);
    item->setTextAlignment(kAmount, Qt::AlignRight | Qt::AlignVCenter);
  }
  showMarks();
  if (has_focus) tree_->setFocus();
  filter();
  tree_->setVisible(!labels.empty());
  hint_->setVisible(labels.empty());
  markCurrent();
}

// Of a short list, all are shown.
void LabelPalette::filter() {
  constexpr std::size_t kShortList = 12;
  const bool is_long = labels_.size() > kShortList;
  filter_->setVisible(is_long);
  const QString wanted = is_long ? filter_->text() : QString();
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = tree_->topLevelItem(i);
    const bool fits =
        item->text(kLabelName).contains(wanted, Qt::CaseInsensitive) || item->text(kId) == wanted;
    item->setHidden(!fits);
  }
}

void LabelPalette::setCurrent(int id) {
  current_ = id;
  markCurrent();
}

void LabelPalette::setHidden(const std::set<std::int32_t>& ids) {
  hidden_ = ids;
  showMarks();
}

void LabelPalette::setLocked(const std::set<std::int32_t>& ids) {
  locked_ = ids;
  showMarks();
}

void LabelPalette::setAmounts(const std::map<std::int32_t, Amount>& amounts) {
  amounts_ = amounts;
  showMarks();
}

void LabelPalette::showMarks() {
  const QSignalBlocker blocker(tree_);
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = tree_->topLevelItem(i);
    const int id = label_of(item);
    const bool is_hidden = hidden_.contains(id);
    const bool is_locked = locked_.contains(id);
    item->setIcon(kShown, themed_icon(is_hidden ? "eye_off" : "eye"));
    item->setToolTip(kShown, is_hidden ? tr("Hidden: click to show it") : tr("Click to hide it"));
    item->setData(kShown, Qt::AccessibleTextRole, is_hidden ? tr("hidden") : tr("shown"));
    item->setIcon(kLock, themed_icon(is_locked ? "lock" : "unlock"));
    item->setToolTip(kLock, is_locked
                                ? tr("Locked: neither painted nor painted over. Click to unlock it")
                                : tr("Click to lock it: it is then neither painted nor painted "
                                     "over"));
    item->setData(kLock, Qt::AccessibleTextRole, is_locked ? tr("locked") : tr("not locked"));
    const auto amount = amounts_.find(id);
    item->setText(kAmount, amount == amounts_.end() ? QString() : amount->second.text);
    item->setToolTip(kAmount, amount == amounts_.end() ? QString() : amount->second.tip);
  }
  tree_->resizeColumnToContents(kAmount);
}

QTreeWidgetItem* LabelPalette::itemOf(int id) const {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    if (label_of(tree_->topLevelItem(i)) == id) return tree_->topLevelItem(i);
  }
  return nullptr;
}

void LabelPalette::markCurrent() {
  const QSignalBlocker blocker(tree_);
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    QFont font = tree_->font();
    font.setBold(label_of(tree_->topLevelItem(i)) == current_);
    for (const int column : {kId, kLabelName}) tree_->topLevelItem(i)->setFont(column, font);
  }
  QTreeWidgetItem* item = itemOf(current_);
  tree_->setCurrentItem(item);
  if (item) tree_->scrollToItem(item);
  updateButtons();
}

void LabelPalette::updateButtons() {
  for (auto* button : {rename_, remove_}) button->setEnabled(itemOf(current_) != nullptr);
}

void LabelPalette::editName(int id) {
  QTreeWidgetItem* item = itemOf(id);
  if (!item) return;
  tree_->scrollToItem(item);
  tree_->editItem(item, kLabelName);
}

bool LabelPalette::eventFilter(QObject* watched, QEvent* event) {
  const bool is_press =
      event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick;
  if (watched == tree_->viewport() && is_press) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() == Qt::LeftButton && clickMark(mouse->position().toPoint())) return true;
  }
  if (watched == tree_->viewport() && event->type() == QEvent::MouseButtonRelease) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    const QPoint position = mouse->position().toPoint();
    const auto* item = tree_->itemAt(position);
    const bool is_on_color = tree_->header()->logicalIndexAt(position.x()) == kColor;
    if (item && is_on_color && mouse->button() == Qt::LeftButton)
      emit colorRequested(label_of(item));
  }
  // The list follows its owner: the tree moves nothing itself.
  if (watched == tree_->viewport() && event->type() == QEvent::Drop) {
    auto* drop = static_cast<QDropEvent*>(event);
    drop->setDropAction(Qt::IgnoreAction);
    drop->accept();
    dropAt(drop->position().toPoint());
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

// Moves the current label, which the drag began on, to the nearest border of two rows.
void LabelPalette::dropAt(QPoint position) {
  const int from = tree_->indexOfTopLevelItem(itemOf(current_));
  QTreeWidgetItem* item = tree_->itemAt(position);
  const bool is_below = item && position.y() > tree_->visualItemRect(item).center().y();
  const int border =
      item ? tree_->indexOfTopLevelItem(item) + (is_below ? 1 : 0) : tree_->topLevelItemCount();
  const int by = border - from - (border > from ? 1 : 0);
  if (from >= 0 && by != 0) emit moveRequested(current_, by);
}

// Whoever hides or locks a label does not want to paint it.
bool LabelPalette::clickMark(QPoint position) {
  const auto* item = tree_->itemAt(position);
  if (!item) return false;
  const int id = label_of(item);
  const int column = tree_->header()->logicalIndexAt(position.x());
  if (column == kShown) emit hiddenRequested(id, !hidden_.contains(id));
  if (column == kLock) emit lockedRequested(id, !locked_.contains(id));
  return column == kShown || column == kLock;
}

void LabelPalette::showMenu(const QPoint& position) {
  const auto* item = tree_->itemAt(position);
  if (!item) return;
  const int id = label_of(item);
  auto* menu = named("labels.menu", new QMenu(this));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(themed_icon("rename"), tr("Rename"), this, [this, id] { editName(id); });
  menu->addAction(tr("Change color…"), this, [this, id] { emit colorRequested(id); });
  menu->addAction(tr("Change number…"), this, [this, id] { emit numberRequested(id); });
  menu->addAction(tr("Merge into…"), this, [this, id] { emit mergeRequested(id); })
      ->setEnabled(labels_.size() > 1);
  menu->addAction(tr("Move up"), this, [this, id] { emit moveRequested(id, -1); });
  menu->addAction(tr("Move down"), this, [this, id] { emit moveRequested(id, 1); });
  menu->addSeparator();
  const bool is_hidden = hidden_.contains(id);
  const bool is_locked = locked_.contains(id);
  menu->addAction(themed_icon(is_hidden ? "eye" : "eye_off"), is_hidden ? tr("Show") : tr("Hide"),
                  this, [this, id, is_hidden] { emit hiddenRequested(id, !is_hidden); });
  menu->addAction(tr("Show only this"), this, [this, id] { emit onlyRequested(id); });
  menu->addAction(themed_icon(is_locked ? "unlock" : "lock"), is_locked ? tr("Unlock") : tr("Lock"),
                  this, [this, id, is_locked] { emit lockedRequested(id, !is_locked); });
  menu->addSeparator();
  menu->addAction(themed_icon("trash"), tr("Remove"), this,
                  [this, id] { emit removeRequested(id); });
  menu->popup(tree_->viewport()->mapToGlobal(position));
}

}  // namespace episcope

#include "moc_label_palette.cpp"
