// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/command_palette.h"

#include "app/gui/shell/commands.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kPaletteWidth = 520;
constexpr int kHeight = 320;
constexpr int kActionIdRole = Qt::UserRole;

// Every typed word occurs somewhere, in any order.
bool matches(const QString& haystack, const QString& text) {
  const QStringList words = text.split(' ', Qt::SkipEmptyParts);
  return std::all_of(words.begin(), words.end(), [&](const QString& word) {
    return haystack.contains(word, Qt::CaseInsensitive);
  });
}

}  // namespace

CommandPalette::CommandPalette(const Commands& commands, QWidget* parent)
    : QDialog(parent, Qt::Popup),
      commands_(commands),
      edit_(new QLineEdit(this)),
      list_(new QListWidget(this)) {
  setObjectName("command_palette");
  edit_->setObjectName("command_palette.edit");
  edit_->setAccessibleName(tr("Name of a command"));
  edit_->setPlaceholderText(tr("Type the name of a command"));
  edit_->installEventFilter(this);
  list_->setObjectName("command_palette.list");
  list_->setAccessibleName(tr("Commands"));
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setItemDelegate(new AsideDelegate(AsideDelegate::Place::End, list_));
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(edit_);
  layout->addWidget(list_);
  connect(edit_, &QLineEdit::textChanged, this, &CommandPalette::filter);
  connect(edit_, &QLineEdit::returnPressed, this, &CommandPalette::runCurrent);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::runCurrent);
}

void CommandPalette::popUp() {
  edit_->clear();
  filter({});
  resize(kPaletteWidth, kHeight);
  const QPoint top = parentWidget()->mapToGlobal(QPoint(parentWidget()->width() / 2, 60));
  move(top.x() - width() / 2, top.y());
  show();
  edit_->setFocus();
}

// Commands that cannot run now are listed last, in grey.
void CommandPalette::filter(const QString& text) {
  list_->clear();
  list(text, true);
  if (!text.isEmpty()) list(text, false);
  if (list_->count() == 0) {
    (new QListWidgetItem(tr("No command has this name."), list_))->setFlags(Qt::NoItemFlags);
  }
  list_->setCurrentRow(0);
}

void CommandPalette::list(const QString& text, bool can_run) {
  for (const Command& command : commands_.all()) {
    const QAction* action = commands_.find(command.id);
    const QString title = QStringLiteral("%1: %2").arg(menu_path(command.menu), action->text());
    if (action->isEnabled() != can_run || command.submenu || !matches(title, text)) continue;
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    auto* item = new QListWidgetItem(title, list_);
    if (!can_run) item->setFlags(Qt::NoItemFlags);
    item->setData(kActionIdRole, command.id);
    item->setData(AsideDelegate::kAsideRole, keys);
    item->setToolTip(command.tip);
  }
}

void CommandPalette::runCurrent() {
  const QListWidgetItem* item = list_->currentItem();
  if (!item || !item->flags().testFlag(Qt::ItemIsEnabled)) return;
  QAction* action = commands_.find(item->data(kActionIdRole).toString());
  close();
  // After the popup is gone, so that the command finds the window in front.
  QTimer::singleShot(0, action, &QAction::trigger);
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == edit_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const int step = key == Qt::Key_Down ? 1 : key == Qt::Key_Up ? -1 : 0;
    if (step != 0) {
      list_->setCurrentRow(std::clamp(list_->currentRow() + step, 0, list_->count() - 1));
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

}  // namespace episcope

#include "moc_command_palette.cpp"
