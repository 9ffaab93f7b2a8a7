// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/measure_panel.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QBoxLayout>
#include <QHeaderView>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>

namespace episcope {
namespace {

enum MeasureColumn { kLineName, kDisparity, kDepth, kPlace };

}  // namespace

MeasurePanel::MeasurePanel(QWidget* parent)
    : QWidget(parent),
      actions_(make_row({kRoom}, {.spacing = 2})),
      list_(make_list("measure.list", tr("Measured lines"), this)),
      hint_(named("measure.hint", new QLabel(this))),
      chosen_actions_(new QVBoxLayout) {
  setObjectName("measurePanel");
  setUpList();
  hint_->setTextFormat(Qt::PlainText);
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  hint_->setMargin(theme::kMargin);
  chosen_actions_->setSpacing(2);
  make_column(this, {actions_, {hint_, 1}, {list_, 1}, chosen_actions_},
              {.margins = {0, theme::kSpacing, 0, theme::kSpacing}, .spacing = 4});
  setRows({}, -1);
}

void MeasurePanel::setUpList() {
  list_->setHeaderLabels({tr("Name"), tr("Disparity"), tr("Depth"), tr("Place")});
  list_->header()->setSectionResizeMode(kLineName, QHeaderView::Stretch);
  const auto index_of = [this](QTreeWidgetItem* item) { return list_->indexOfTopLevelItem(item); };
  connect(add_delete_action(list_), &QAction::triggered, this, [this, index_of] {
    if (QTreeWidgetItem* item = list_->currentItem()) emit removeRequested(index_of(item));
  });
  const auto choose = [this, index_of](QTreeWidgetItem* item) { emit chosen(index_of(item)); };
  connect(list_, &QTreeWidget::itemClicked, this, choose);
  connect(list_, &QTreeWidget::itemActivated, this, choose);
  // After what the first of the two clicks brings about.
  connect(
      list_, &QTreeWidget::itemDoubleClicked, this,
      [this, index_of](QTreeWidgetItem* item) { editName(index_of(item)); }, Qt::QueuedConnection);
  connect(list_, &QTreeWidget::itemChanged, this,
          [this, index_of](QTreeWidgetItem* item, int column) {
            if (column == kLineName) emit renameRequested(index_of(item), item->text(kLineName));
          });
}

void MeasurePanel::addChosenAction(QAction* action) {
  auto* button = make_action_button(action, this);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  chosen_actions_->addWidget(button);
}

void MeasurePanel::setRows(const std::vector<Row>& rows, int current) {
  const QSignalBlocker blocker(list_);
  const auto count = static_cast<int>(rows.size());
  // Rows stay what they are, so that a name that is being typed stays too.
  while (list_->topLevelItemCount() > count) delete list_->takeTopLevelItem(count);
  while (list_->topLevelItemCount() < count) {
    auto* item = new QTreeWidgetItem(list_);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
  }
  for (int i = 0; i < count; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    QTreeWidgetItem* item = list_->topLevelItem(i);
    item->setText(kLineName, row.name);
    item->setText(kDisparity, row.disparity);
    item->setText(kDepth, row.depth);
    item->setText(kPlace, row.place);
    for (const int column : {kDisparity, kDepth}) {
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
    for (const int column : {kLineName, kDisparity, kDepth, kPlace})
      item->setToolTip(column, row.tip);
  }
  list_->setCurrentItem(current < 0 ? nullptr : list_->topLevelItem(current));
  list_->setVisible(!rows.empty());
  hint_->setVisible(rows.empty());
}

void MeasurePanel::editName(int index) {
  if (QTreeWidgetItem* item = list_->topLevelItem(index)) list_->editItem(item, kLineName);
}

}  // namespace episcope

#include "moc_measure_panel.cpp"
