// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shortcut_window.h"

#include "app/gui/action_table.h"

#include <QHeaderView>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace episcope {
namespace {

QString key_text(const QList<QKeySequence>& keys) {
  QStringList texts;
  for (const QKeySequence& key : keys) texts << key.toString(QKeySequence::NativeText);
  return texts.join(QStringLiteral(", "));
}

void add_group(QTreeWidget* tree, const QString& title, QTreeWidgetItem*& group) {
  group = new QTreeWidgetItem(tree, {title});
  QFont font = group->font(0);
  font.setBold(true);
  group->setFont(0, font);
  group->setFirstColumnSpanned(true);
  group->setExpanded(true);
}

}  // namespace

ShortcutWindow::ShortcutWindow(const ActionTable& table, QWidget* parent) : QDialog(parent) {
  setObjectName("shortcut_window");
  setWindowTitle(tr("Keys and mouse"));
  auto* tree = new QTreeWidget(this);
  tree->setHeaderLabels({tr("Key"), tr("What it does")});
  tree->setRootIsDecorated(false);
  tree->setItemsExpandable(false);
  tree->setSelectionMode(QAbstractItemView::NoSelection);
  tree->setFocusPolicy(Qt::StrongFocus);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(tree);

  QTreeWidgetItem* group = nullptr;
  add_group(tree, tr("In the view"), group);
  const QStringList gestures[] = {
      {tr("Click"), tr("Moves the cross-hair")},
      {tr("Shift+click"), tr("Focuses at the pixel")},
      {tr("Double click"), tr("Shows the centre view")},
      {tr("Drag"), tr("Moves between the views (parallax)")},
      {tr("Middle drag, Space+drag"), tr("Pans")},
      {tr("Wheel"), tr("Zooms at the cursor")},
      {tr("Alt+wheel"), tr("Moves the focus plane")},
      {tr("Tab held"), tr("Shows the other result, while it is held")},
      {tr("Drag in an EPI"), tr("Draws a line and measures its disparity")},
  };
  for (const QStringList& gesture : gestures) new QTreeWidgetItem(group, gesture);
  QString menu;
  for (const Command& command : table.commands()) {
    if (command.keys.isEmpty()) continue;
    if (command.menu != menu) add_group(tree, menu = command.menu, group);
    new QTreeWidgetItem(group, {key_text(command.keys), command.tip});
  }
  tree->resizeColumnToContents(0);
  resize(600, 640);
}

}  // namespace episcope
