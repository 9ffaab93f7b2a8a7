// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/manual_window.h"

#include "app/gui/shell/appearance.h"
#include "app/gui/shell/commands.h"
#include "engine/core/version.h"
#include "widgets/controls/aside_delegate.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QKeyEvent>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QString>
#include <QTimer>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr int kPaletteWidth = 520;
constexpr int kHeight = 320;
constexpr int kEntryRole = Qt::UserRole;

// Every typed word occurs somewhere, in any order.
bool matches(const QString& haystack, const QString& text) {
  const QStringList words = text.split(' ', Qt::SkipEmptyParts);
  return std::all_of(words.begin(), words.end(), [&](const QString& word) {
    return haystack.contains(word, Qt::CaseInsensitive);
  });
}

struct Synonyms {
  const char* id;  // of a command; with a dot or underscore at the end, of all that begin so
  const char* words;
};

// Words that other programs use.
constexpr Synonyms kSynonyms[] = {
    {"file.open", QT_TRANSLATE_NOOP("episcope::Synonyms", "load import directory")},
    {"file.builtin", QT_TRANSLATE_NOOP("episcope::Synonyms", "example sample synthetic")},
    {"file.conventions", QT_TRANSLATE_NOOP("episcope::Synonyms", "settings options crop order")},
    {"file.save_picture", QT_TRANSLATE_NOOP("episcope::Synonyms", "screenshot image save")},
    {"file.save_map", QT_TRANSLATE_NOOP("episcope::Synonyms", "image heat map save")},
    {"file.save_movie", QT_TRANSLATE_NOOP("episcope::Synonyms", "video animation save")},
    {"file.export", QT_TRANSLATE_NOOP("episcope::Synonyms", "save depth point cloud")},
    {"file.save_metrics_csv",
     QT_TRANSLATE_NOOP("episcope::Synonyms", "scores errors spreadsheet save")},
    {"file.save_metrics_tex", QT_TRANSLATE_NOOP("episcope::Synonyms", "scores errors paper save")},
    {"cloud.", QT_TRANSLATE_NOOP("episcope::Synonyms", "point cloud")},
    {"cloud.export", QT_TRANSLATE_NOOP("episcope::Synonyms", "mesh save")},
    {"tab.cloud", QT_TRANSLATE_NOOP("episcope::Synonyms", "point cloud mesh depth")},
    {"tab.compare", QT_TRANSLATE_NOOP("episcope::Synonyms", "histogram statistics scores errors")},
    {"tab.errors", QT_TRANSLATE_NOOP("episcope::Synonyms", "plot curve distribution histogram")},
    {"view.actual_size", QT_TRANSLATE_NOOP("episcope::Synonyms", "zoom percent original")},
    {"view.fit", QT_TRANSLATE_NOOP("episcope::Synonyms", "zoom whole window")},
    {"view.tone", QT_TRANSLATE_NOOP("episcope::Synonyms", "contrast dark light levels")},
    {"view.play", QT_TRANSLATE_NOOP("episcope::Synonyms", "parallax animate movie")},
    {"view.focus_", QT_TRANSLATE_NOOP("episcope::Synonyms", "refocus shear slope")},
    {"view.refocus", QT_TRANSLATE_NOOP("episcope::Synonyms", "shift sum synthetic aperture")},
    {"overlay.", QT_TRANSLATE_NOOP("episcope::Synonyms", "overlay heat map")},
    {"overlay.disparity", QT_TRANSLATE_NOOP("episcope::Synonyms", "depth")},
    {"overlay.truth", QT_TRANSLATE_NOOP("episcope::Synonyms", "reference depth")},
    {"overlay.bad_pixels", QT_TRANSLATE_NOOP("episcope::Synonyms", "outliers")},
    {"compare.wipe", QT_TRANSLATE_NOOP("episcope::Synonyms", "split curtain swipe")},
    {"compare.flip", QT_TRANSLATE_NOOP("episcope::Synonyms", "blink toggle")},
    {"compare.difference", QT_TRANSLATE_NOOP("episcope::Synonyms", "subtract minus")},
    {"compare.tiles", QT_TRANSLATE_NOOP("episcope::Synonyms", "grid gallery")},
    {"annotate.brush", QT_TRANSLATE_NOOP("episcope::Synonyms", "paint draw scribble pen")},
    {"annotate.eraser", QT_TRANSLATE_NOOP("episcope::Synonyms", "rubber delete")},
    {"theme.dark", QT_TRANSLATE_NOOP("episcope::Synonyms", "night mode")},
    {"help.keys", QT_TRANSLATE_NOOP("episcope::Synonyms", "shortcuts hotkeys bindings")},
    {"help.manual", QT_TRANSLATE_NOOP("episcope::Synonyms", "documentation guide")}};

QString synonyms_of(const QString& id) {
  QStringList words;
  for (const Synonyms& each : kSynonyms) {
    const QString known(each.id);
    const bool is_group = known.endsWith('.') || known.endsWith('_');
    if (is_group ? id.startsWith(known) : id == known) {
      words << QCoreApplication::translate("episcope::Synonyms", each.words);
    }
  }
  return words.join(' ');
}

}  // namespace

/// Finds commands, methods, open and recent light fields by words of their names, descriptions or
/// synonyms; Enter runs, chooses or opens what was found. Those whose name matches come first.
class CommandPalette : public QDialog {
  Q_OBJECT

 public:
  CommandPalette(const Commands& commands, QWidget* parent)
      : QDialog(parent, Qt::Popup),
        commands_(commands),
        edit_(named("command_palette.edit", new QLineEdit(this))),
        list_(named("command_palette.list", new QListWidget(this))) {
    setObjectName("command_palette");
    edit_->setAccessibleName(tr("Words of a command, method or light field"));
    edit_->setPlaceholderText(tr("Type words of a command, method or light field"));
    edit_->installEventFilter(this);
    list_->setAccessibleName(tr("What was found"));
    list_->setFocusPolicy(Qt::NoFocus);
    list_->setTextElideMode(Qt::ElideMiddle);
    list_->setItemDelegate(new AsideDelegate(AsideDelegate::Place::End, list_));
    make_column(this, {edit_, list_}, {.margins = kStyleMargins});
    connect(edit_, &QLineEdit::textChanged, this, &CommandPalette::filter);
    connect(edit_, &QLineEdit::returnPressed, this, &CommandPalette::runCurrent);
    connect(list_, &QListWidget::itemClicked, this, &CommandPalette::runCurrent);
  }

  /// Opens empty under the top edge of the parent.
  void popUp() {
    entries_ = entries();
    edit_->clear();
    filter({});
    resize(kPaletteWidth, kHeight);
    const QPoint top = parentWidget()->mapToGlobal(QPoint(parentWidget()->width() / 2, 60));
    move(top.x() - width() / 2, top.y());
    show();
    edit_->setFocus();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
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

 private:
  struct Entry {
    PaletteTarget target;
    QString keys;
    bool can_run = true;
  };
  /// How well an entry matches; the best is 0.
  enum class Rank { Name, Description, CannotRun, None };

  [[nodiscard]] std::vector<Entry> entries() const {
    std::vector<Entry> entries;
    for (const Command& command : commands_.all()) {
      if (command.submenu) continue;
      QAction* action = commands_.find(command.id);
      const QString title = QStringLiteral("%1: %2").arg(menu_path(command.menu), action->text());
      entries.push_back(
          {{title, command.tip, synonyms_of(command.id), [action] { action->trigger(); }},
           action->shortcut().toString(QKeySequence::NativeText),
           action->isEnabled()});
    }
    for (PaletteTarget& target : commands_.targets()) entries.push_back({std::move(target), {}});
    return entries;
  }

  // Without a text, all that can run.
  [[nodiscard]] static Rank rankOf(const Entry& entry, const QString& text) {
    const PaletteTarget& target = entry.target;
    const bool is_named = matches(target.title, text);
    if (!is_named && !matches(target.title + ' ' + target.tip + ' ' + target.words, text)) {
      return Rank::None;
    }
    if (!entry.can_run) return text.isEmpty() ? Rank::None : Rank::CannotRun;
    return is_named ? Rank::Name : Rank::Description;
  }

  void filter(const QString& text) {
    list_->clear();
    std::vector<Rank> ranks;
    for (const Entry& entry : entries_) ranks.push_back(rankOf(entry, text));
    for (const Rank rank : {Rank::Name, Rank::Description, Rank::CannotRun}) {
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (ranks[i] == rank) add(entries_[i]);
      }
    }
    if (list_->count() == 0) {
      (new QListWidgetItem(tr("Nothing has this name or description."), list_))
          ->setFlags(Qt::NoItemFlags);
    }
    list_->setCurrentRow(0);
  }

  void add(const Entry& entry) {
    auto* item = new QListWidgetItem(entry.target.title, list_);
    if (!entry.can_run) item->setFlags(Qt::NoItemFlags);
    item->setData(kEntryRole, static_cast<int>(&entry - entries_.data()));
    item->setData(AsideDelegate::kAsideRole, entry.keys);
    item->setToolTip(entry.target.tip);
  }

  void runCurrent() {
    const QListWidgetItem* item = list_->currentItem();
    if (!item || !item->flags().testFlag(Qt::ItemIsEnabled)) return;
    const auto place = static_cast<std::size_t>(item->data(kEntryRole).toInt());
    const auto run = entries_[place].target.run;
    close();
    // After the popup is gone, so that the command finds the window in front.
    QTimer::singleShot(0, parentWidget(), run);
  }

  const Commands& commands_;
  std::vector<Entry> entries_;  // as of the opening
  QLineEdit* edit_;
  QListWidget* list_;
};

namespace {

constexpr int kIdRole = Qt::UserRole;
constexpr int kWordsRole = Qt::UserRole + 1;  // that it is found by, besides those seen

QString key_text(const QList<QKeySequence>& keys) {
  QStringList texts;
  for (const QKeySequence& key : keys) texts << key.toString(QKeySequence::NativeText);
  return texts.join(QStringLiteral(", "));
}

QTreeWidgetItem* add_group(QTreeWidget* tree, const QString& title) {
  auto* group = new QTreeWidgetItem(tree, {title});
  QFont font = group->font(0);
  font.setBold(true);
  group->setFont(0, font);
  group->setFlags(Qt::ItemIsEnabled);
  group->setFirstColumnSpanned(true);
  group->setExpanded(true);
  return group;
}

}  // namespace

/// Every key and mouse gesture, from the table of commands. To change a key, choose a command,
/// press the new key and set it. A key of another command is named, and taken from it only on
/// request. Does not block.
class ShortcutWindow : public QDialog {
  Q_OBJECT

 public:
  ShortcutWindow(Commands& commands, QWidget* parent)
      : QDialog(parent),
        commands_(commands),
        find_(named("keys.find", new QLineEdit(this))),
        tree_(named("keys.tree", new QTreeWidget(this))) {
    setObjectName("shortcut_window");
    setWindowTitle(tr("Keys and mouse"));
    tree_->setHeaderLabels({tr("Key"), tr("What it does")});
    tree_->setRootIsDecorated(false);
    tree_->setItemsExpandable(false);
    find_->setPlaceholderText(tr("Find a key or a command"));
    find_->setClearButtonEnabled(true);
    make_column(this, {find_, {tree_, 1}, makeEditor()}, {.margins = kStyleMargins});
    fillGestures();
    fillCommands();
    showKeys();
    // Fonts draw the dots of capital umlauts above their height.
    for (QTreeWidgetItemIterator item(tree_); *item; ++item) {
      (*item)->setSizeHint(1, QSize(0, fontMetrics().height() + 4));
    }
    tree_->resizeColumnToContents(0);
    tree_->setColumnWidth(0, std::clamp(tree_->columnWidth(0), 190, 330));
    connect(tree_, &QTreeWidget::itemSelectionChanged, this, [this] {
      Quietly(edit_)->clear();
      updateEditor();
    });
    connect(tree_, &QTreeWidget::itemActivated, edit_, qOverload<>(&QWidget::setFocus));
    connect(find_, &QLineEdit::textChanged, this, &ShortcutWindow::filter);
    connect(&commands_, &Commands::keysChanged, this, &ShortcutWindow::showKeys);
    resize(700, 680);
  }

 private:
  void fillGestures() {
    addGestures(
        tr("In the view"),
        {
            {tr("Click"), tr("Moves the cross-hair")},
            {tr("Shift+click"), tr("Focuses on the pixel")},
            {tr("Double click"), tr("Shows the center view; in tiles: shows that tile alone")},
            {tr("Drag"), tr("Moves between the views (parallax); in tiles: pans")},
            {tr("Middle drag, Space+drag"), tr("Pans")},
            {tr("Wheel"), tr("Zooms at the cursor")},
            {tr("Alt+wheel, Ctrl+wheel"), tr("Moves the focus plane")},
            {tr("Drag in an EPI"), tr("Draws a line and measures its disparity")},
            {tr("Right click"), tr("Opens a menu for the pixel")},
        });
    addGestures(tr("In the view, while annotating"),
                {
                    {tr("Drag"), tr("Paints the current label, or uses the current tool")},
                    {tr("Right drag"), tr("Erases")},
                    {tr("Shift+drag"), tr("Paints without changing other labels")},
                    {tr("Ctrl+click"), tr("Moves the cross-hair")},
                    {tr("Ctrl+Shift+wheel"), tr("Changes the size of brush or eraser")},
                    {tr("Esc"), tr("Cancels the current stroke")},
                });
  }

  void addGestures(const QString& title, const QList<QStringList>& gestures) {
    auto* group = add_group(tree_, title);
    for (const QStringList& gesture : gestures) {
      auto* item = new QTreeWidgetItem(group, gesture);
      item->setFlags(Qt::ItemIsEnabled);
      item->setToolTip(1, gesture[1]);
    }
  }

  void fillCommands() {
    for (const MenuInfo& menu : menus()) {
      QTreeWidgetItem* group = nullptr;
      for (const Command& command : commands_.all()) {
        if (command.menu != menu.menu || command.submenu) continue;
        if (!group) group = add_group(tree_, menu_path(menu.menu));
        auto* item = new QTreeWidgetItem(group, {QString(), command.tip});
        item->setToolTip(1, command.tip);
        item->setData(0, kWordsRole, menu_path(menu.menu) + ' ' + command.text);
        item->setData(0, kIdRole, command.id);
      }
    }
  }

  QWidget* makeEditor() {
    auto* editor = new QWidget(this);
    edit_ = named("keys.edit", new QKeySequenceEdit(editor));
    set_ = named("keys.set", new QPushButton(tr("Set key"), editor));
    reset_ = named("keys.reset", new QPushButton(tr("Default"), editor));
    reset_->setToolTip(tr("Restores the default keys of the selected command"));
    auto* reset_all = named("keys.resetAll", new QPushButton(tr("All defaults"), editor));
    reset_all->setToolTip(tr("Restores the default keys of all commands"));
    for (auto* button : {set_, reset_, reset_all}) button->setAutoDefault(false);
    hint_ = named("keys.hint", new QLabel(editor));
    hint_->setWordWrap(true);
    auto* row = make_row({{edit_, 1}});
    for (auto* button : {set_, reset_, reset_all}) row->addWidget(button);
    make_column(editor, {hint_, row});
    connect(edit_, &QKeySequenceEdit::keySequenceChanged, this, [this](const QKeySequence& keys) {
      // One chord; the edit would gather up to four.
      if (keys.count() > 1) edit_->setKeySequence(QKeySequence(keys[0]));
      updateEditor();
    });
    connect(set_, &QPushButton::clicked, this, &ShortcutWindow::setKey);
    connect(reset_, &QPushButton::clicked, this, [this] { commands_.resetKeys(command()); });
    connect(reset_all, &QPushButton::clicked, &commands_, &Commands::resetAllKeys);
    updateEditor();
    return editor;
  }

  void showKeys() {
    for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
      QTreeWidgetItem* group = tree_->topLevelItem(i);
      for (int row = 0; row < group->childCount(); ++row) {
        QTreeWidgetItem* item = group->child(row);
        const QString id = item->data(0, kIdRole).toString();
        if (id.isEmpty()) continue;
        item->setText(0, key_text(commands_.keys(id)));
        QFont font = item->font(0);
        font.setBold(commands_.hasOwnKeys(id));
        item->setFont(0, font);
      }
    }
    updateEditor();
  }

  /// Shows only rows that contain the text.
  void filter(const QString& text) {
    for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
      QTreeWidgetItem* group = tree_->topLevelItem(i);
      bool is_empty = true;
      for (int row = 0; row < group->childCount(); ++row) {
        QTreeWidgetItem* item = group->child(row);
        const bool is_found =
            item->text(0).contains(text, Qt::CaseInsensitive) ||
            item->text(1).contains(text, Qt::CaseInsensitive) ||
            item->data(0, kWordsRole).toString().contains(text, Qt::CaseInsensitive);
        item->setHidden(!is_found);
        is_empty &= !is_found;
      }
      group->setHidden(is_empty);
    }
  }

  /// Id of the selected command; empty on gestures.
  [[nodiscard]] QString command() const {
    const auto selected = tree_->selectedItems();
    return selected.isEmpty() ? QString() : selected.front()->data(0, kIdRole).toString();
  }

  void updateEditor() {
    const QString id = command();
    const QKeySequence key = edit_->keySequence();
    edit_->setEnabled(!id.isEmpty());
    set_->setEnabled(!id.isEmpty() && !key.isEmpty());
    set_->setText(tr("Set key"));
    reset_->setEnabled(!id.isEmpty() && commands_.hasOwnKeys(id));
    hint_->setPalette(QPalette());
    if (id.isEmpty()) {
      hint_->setText(tr("Choose a command to change its key."));
      return;
    }
    const QString name = commands_.find(id)->text();
    const QString user = key.isEmpty() ? QString() : commands_.userOf(key);
    if (user.isEmpty() || user == id) {
      hint_->setText(tr("%1: press the new key in the field.").arg(name));
      return;
    }
    const QString text = key.toString(QKeySequence::NativeText);
    hint_->setText(tr("%1 already belongs to “%2”, which would lose it.")
                       .arg(text, commands_.find(user)->text()));
    hint_->setPalette(theme::text_palette(theme::warning_text(palette())));
    set_->setText(tr("Reassign"));
  }

  void setKey() {
    const QString id = command();
    const QKeySequence key = edit_->keySequence();
    if (id.isEmpty() || key.isEmpty()) return;
    if (const QString user = commands_.userOf(key); !user.isEmpty() && user != id) {
      QList<QKeySequence> left = commands_.keys(user);
      left.removeAll(key);
      commands_.setKeys(user, left);
    }
    commands_.setKeys(id, {key});
    Quietly(edit_)->clear();
    updateEditor();
  }

  Commands& commands_;
  QLineEdit* find_;
  QTreeWidget* tree_;
  QKeySequenceEdit* edit_ = nullptr;
  QLabel* hint_ = nullptr;
  QPushButton* set_ = nullptr;
  QPushButton* reset_ = nullptr;
};

namespace {

constexpr int kIconSize = 64;

struct HelpText {
  Q_DECLARE_TR_FUNCTIONS(episcope::Help)
};

void show_shortcuts(Commands& commands, QWidget& window) {
  auto* shortcuts = window.findChild<ShortcutWindow*>();
  if (!shortcuts) shortcuts = new ShortcutWindow(commands, &window);
  shortcuts->show();
  shortcuts->raise();
}

void show_about(QWidget& window) {
  auto* box =
      named("about",
            new QMessageBox(
                QMessageBox::NoIcon, HelpText::tr("About Episcope"),
                HelpText::tr(
                    "<b>Episcope %1</b><p>Views, EPIs, disparity and labels of 4D light fields.</p>"
                    "<p>BSD 3-Clause license.</p>")
                    .arg(kVersion),
                QMessageBox::Close, &window));
  box->setIconPixmap(program_icon().pixmap(kIconSize));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

}  // namespace

// The list of keys, the command palette, colors, language and About.
void add_help(const Workbench& bench) {
  Commands& commands = bench.commands;
  QWidget& window = bench.window;
  auto* palette = new CommandPalette(commands, &window);
  add_theme_commands(commands);
  add_language_commands(commands, bench.messages);
  const auto open_manual = make_manual(window);
  commands.add({.menu = Menu::Help},
               {{.id = "help.manual",
                 .text = HelpText::tr("Manual"),
                 .tip = HelpText::tr("Opens the pages of the manual"),
                 .icon = "info",
                 .run = open_manual},
                {.id = "help.keys",
                 .text = HelpText::tr("Keys and mouse"),
                 .tip = HelpText::tr("Lists every key and mouse gesture"),
                 .icon = "help",
                 .keys = {Qt::Key_F1, Qt::Key_Question},
                 .run = [&commands, &window] { show_shortcuts(commands, window); },
                 .bar = BarSection::Help},
                {.id = "help.palette",
                 .text = HelpText::tr("Find a command…"),
                 .tip = HelpText::tr(
                     "Finds commands, methods, open and recent light fields by words of their "
                     "names and descriptions"),
                 .keys = {HelpText::tr("Ctrl+Shift+P")},
                 .run = [palette] { palette->popUp(); }},
                {.id = "help.about",
                 .text = HelpText::tr("About Episcope"),
                 .tip = HelpText::tr("Shows version and license"),
                 .icon = "info",
                 .run = [&window] { show_about(window); }}});
}

}  // namespace episcope

#include "command_palette.moc"
