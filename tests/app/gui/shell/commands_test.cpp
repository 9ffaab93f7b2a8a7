// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/commands.h"
#include "app/gui/files/file_controller.h"
#include "app/gui/shell/appearance.h"
#include "app/gui/shell/manual_window.h"
#include "app/session/session.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/view_grid.h"

#include <QAction>
#include <QActionGroup>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSet>
#include <QSettings>
#include <QSignalSpy>
#include <QTextBrowser>
#include <QTreeWidget>

#include <tuple>

namespace episcope::in_commands_test {

class CommandsTest : public QObject {
  Q_OBJECT

 private slots:
  void ids_areUnique();
  void keys_areUnique();
  void everyCommand_hasTextAndTip();
  void everyCommand_isInAMenu();
  void exclusiveChoices_haveRadioMarks();
  void fileMenu_opensSavesAndExports();
  void labelFiles_areInTheMenuOfLabels();
  void manual_opensAndFollowsLinks();
  void manual_isSearched();
  void helpOnAParameter_givesTheKeysBack();
  void menus_fitASmallScreen();
  void sweep_showsItsKeyInTheMenu();
  void everyCommandWithKeys_isInTheShortcutWindow();
  void shortenedTexts_areWholeInTheirTips();
  void listOfKeys_isSearched_data();
  void listOfKeys_isSearched();
  void palette_findsAndRunsACommand();
  void palette_namesWhatCannotBeRunNow();
  void palette_elidesLongNames();
  void palette_findsByDescriptionSynonymMethodAndLightField_data();
  void palette_findsByDescriptionSynonymMethodAndLightField();
  void chosenColours_areAppliedAndRemembered();
  void changedKey_worksIsShownAndRemembered();
  void keysOfTheView_areThoseOfTheTable_data();
  void keysOfTheView_areThoseOfTheTable();
  void keyOfAnotherCommand_isNamedAndTakenOnlyWhenAsked();
  void emptyCanvas_namesTheKeyThatOpens();
  void defaults_comeBack();
};

void CommandsTest::ids_areUnique() {
  WindowFixture f;
  QSet<QString> ids;
  for (const Command& command : f.window.bench().commands.all()) {
    QVERIFY2(!ids.contains(command.id), qPrintable(command.id));
    ids.insert(command.id);
  }
  QVERIFY(ids.size() > 30);
}

void CommandsTest::exclusiveChoices_haveRadioMarks() {
  WindowFixture f;
  f.openSmall();
  f.trigger("overlay.truth");
  const Commands& commands = f.window.bench().commands;

  for (const char* id :
       {"overlay.none", "overlay.truth", "compare.wipe", "annotate.brush", "theme.dark"}) {
    const QActionGroup* group = commands.find(id)->actionGroup();
    QVERIFY2(group && group->isExclusive(), id);
    QVERIFY2(!commands.find(id)->isIconVisibleInMenu(), id);  // it would hide the mark
  }
  QVERIFY(commands.find("overlay.truth")->isChecked());
  QVERIFY(!commands.find("overlay.none")->isChecked());
  f.trigger("overlay.truth");  // what is chosen stays chosen
  QVERIFY(commands.find("overlay.truth")->isChecked());
}

void CommandsTest::keys_areUnique() {
  WindowFixture f;
  QSet<QString> keys;
  for (const Command& command : f.window.bench().commands.all()) {
    for (const QKeySequence& key : command.keys) {
      QVERIFY2(!key.isEmpty(), qPrintable(command.id));
      QVERIFY2(!keys.contains(key.toString()), qPrintable(command.id + " " + key.toString()));
      keys.insert(key.toString());
    }
  }
}

void CommandsTest::everyCommand_hasTextAndTip() {
  WindowFixture f;
  for (const Command& command : f.window.bench().commands.all()) {
    QVERIFY2(!command.text.isEmpty() && !command.tip.isEmpty(), qPrintable(command.id));
    const QAction* action = f.window.bench().commands.find(command.id);
    QVERIFY2(action->toolTip().startsWith(command.tip), qPrintable(command.id));
    if (!command.icon.isEmpty()) QVERIFY2(!action->icon().isNull(), qPrintable(command.id));
  }
}

void CommandsTest::everyCommand_isInAMenu() {
  WindowFixture f;
  QSet<QAction*> in_menus;
  for (const QMenu* menu : f.window.menuBar()->findChildren<QMenu*>()) {
    for (QAction* action : menu->actions()) in_menus.insert(action);
  }
  QSet<QChar> letters;
  for (const QAction* menu : f.window.menuBar()->actions()) {
    QVERIFY2(menu->text().startsWith('&'), qPrintable(menu->text()));
    letters.insert(menu->text()[1]);
  }
  QCOMPARE(letters.size(), f.window.menuBar()->actions().size());
  for (const Command& command : f.window.bench().commands.all()) {
    QVERIFY2(in_menus.contains(f.window.bench().commands.find(command.id)), qPrintable(command.id));
  }
}

void CommandsTest::sweep_showsItsKeyInTheMenu() {
  WindowFixture f;
  QCOMPARE(f.window.bench().commands.find("estimate.sweep")->shortcut(),
           QKeySequence("Ctrl+Shift+F5"));

  f.key(Qt::Key_F5, Qt::ControlModifier | Qt::ShiftModifier);

  QCOMPARE(f.window.bench().frame.shownTab(), QString("sweep"));
}

namespace {

// Ids of the entries of a menu and of those inside.
QStringList entries_of(const QMenu* menu) {
  QStringList ids;
  for (const QAction* action : menu->actions()) {
    if (action->isSeparator()) continue;
    ids << action->objectName();
    if (action->menu()) ids << entries_of(action->menu());
  }
  return ids;
}

}  // namespace

void CommandsTest::fileMenu_opensSavesAndExports() {
  WindowFixture f;
  const auto menu = [&f](const char* name) { return f.window.findChild<QMenu*>(name); };
  QStringList first;
  for (const QAction* action : menu("menu.File")->actions().mid(0, 3)) {
    first << action->menu()->objectName();
  }
  QCOMPARE(first, (QStringList{"menu.File › Open", "menu.File › Project", "menu.File › Export"}));
  QVERIFY(menu("menu.File")->actions()[3]->isSeparator());

  QVERIFY(entries_of(menu("menu.File › Open")).contains("file.open"));
  QVERIFY(entries_of(menu("menu.File › Project")).contains("file.save_project"));
  const QStringList written = entries_of(menu("menu.File › Export"));
  for (const char* id : {"file.export", "file.export_submission", "file.save_metrics_csv",
                         "file.save_metrics_tex", "measure.save", "sweep.save", "file.save_picture",
                         "file.save_map", "file.save_movie", "cloud.export", "segment.export",
                         "segment.export_masks", "file.export_scribbles", "file.save_as.npz"}) {
    QVERIFY2(written.contains(id), id);
  }
}

void CommandsTest::labelFiles_areInTheMenuOfLabels() {
  WindowFixture f;
  const QStringList labels = entries_of(f.window.findChild<QMenu*>("menu.Annotate › Labels"));
  for (const char* id : {"annotate.add_label", "file.save_scribbles", "file.import_labels"}) {
    QVERIFY2(labels.contains(id), id);
  }
}

void CommandsTest::manual_opensAndFollowsLinks() {
  WindowFixture f;

  f.trigger("help.manual");

  auto* pages = f.window.findChild<QTextBrowser*>("manual.pages");
  QVERIFY(pages->isVisible());
  QVERIFY2(pages->toPlainText().startsWith("Episcope"), qPrintable(pages->toPlainText().left(80)));
  QVERIFY(!f.window.findChild<QPushButton*>("manual.back")->isEnabled());
  pages->setSource(QUrl("window.md"));  // as a click on the link does
  QVERIFY2(pages->window()->windowTitle().contains("The window"),
           qPrintable(pages->window()->windowTitle()));
  QVERIFY(pages->toHtml().contains("pictures/window.png"));
  f.window.findChild<QPushButton*>("manual.back")->click();
  QVERIFY(pages->toPlainText().startsWith("Episcope"));
}

void CommandsTest::manual_isSearched() {
  WindowFixture f;
  f.trigger("help.manual");
  auto* pages = f.window.findChild<QTextBrowser*>("manual.pages");
  auto* words = f.window.findChild<QLineEdit*>("manual.search");

  words->setText("parallax black point");
  QTest::keyClick(words, Qt::Key_Return);
  QVERIFY(pages->toPlainText().contains("No paragraph"));
  words->setText("exposure black");
  QTest::keyClick(words, Qt::Key_Return);

  QVERIFY2(pages->toHtml().contains("/window.md"), qPrintable(pages->toPlainText()));
  QVERIFY(!pages->toHtml().contains("/gantry.md"));
  pages->setSource(QUrl::fromLocalFile(manual_folder() + "/window.md"));  // as a click does
  QCOMPARE(pages->textCursor().selectedText().toLower(), QString("exposure"));
  f.window.findChild<QPushButton*>("manual.back")->click();
  QVERIFY(pages->toPlainText().startsWith("Search: exposure black"));
}

void CommandsTest::helpOnAParameter_givesTheKeysBack() {
  WindowFixture f;
  f.openSmall();
  f.canvas()->setFocus();

  f.click("range.help");
  auto* help = f.window.findChild<QWidget*>("parameterHelp");
  QVERIFY(help && help->isVisible());
  help->close();

  QCOMPARE(f.window.focusWidget(), f.canvas());
}

// Those that do not are broken into columns, which cover the window.
void CommandsTest::menus_fitASmallScreen() {
  WindowFixture f;
  for (const QAction* entry : f.window.menuBar()->actions()) {
    QMenu* menu = entry->menu();
    menu->popup({0, 0});
    const QList<QAction*> actions = menu->actions();
    const QRect first = menu->actionGeometry(actions.front());
    const QRect last = menu->actionGeometry(actions.back());
    menu->close();

    QCOMPARE(first.left(), last.left());
    QVERIFY2(last.bottom() < 760, qPrintable(menu->title()));
  }
}

void CommandsTest::everyCommandWithKeys_isInTheShortcutWindow() {
  WindowFixture f;

  f.window.bench().commands.find("help.keys")->trigger();

  const auto* dialog = f.window.findChild<QWidget*>("shortcut_window");
  QVERIFY(dialog && dialog->isVisible());
  const auto* tree = dialog->findChild<QTreeWidget*>();
  for (const Command& command : f.window.bench().commands.all()) {
    if (command.keys.isEmpty()) continue;
    const auto rows = tree->findItems(command.tip, Qt::MatchExactly | Qt::MatchRecursive, 1);
    QVERIFY2(rows.size() == 1, qPrintable(command.id));
  }
}

void CommandsTest::shortenedTexts_areWholeInTheirTips() {
  WindowFixture f;

  f.trigger("help.keys");

  auto* tree = f.window.findChild<QTreeWidget*>("keys.tree");
  for (QTreeWidgetItemIterator each(tree); *each; ++each) {
    if ((*each)->childCount() == 0) QCOMPARE((*each)->toolTip(1), (*each)->text(1));
  }
}

void CommandsTest::listOfKeys_isSearched_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<int>("least");
  QTest::addColumn<int>("most");
  QTest::newRow("a gesture") << "parallax" << 2 << 2;
  QTest::newRow("a name") << "wipe" << 1 << 3;
  QTest::newRow("a short name") << "fit" << 1 << 3;
  QTest::newRow("a menu") << "Annotate" << 10 << 60;
  QTest::newRow("nothing") << "xyzzy" << 0 << 0;
}

void CommandsTest::listOfKeys_isSearched() {
  QFETCH(QString, word);
  QFETCH(int, least);
  QFETCH(int, most);
  WindowFixture f;
  f.window.bench().commands.find("help.keys")->trigger();
  const auto* dialog = f.window.findChild<QWidget*>("shortcut_window");
  auto* tree = dialog->findChild<QTreeWidget*>("keys.tree");

  QTest::keyClicks(dialog->findChild<QLineEdit*>("keys.find"), word);

  int rows = 0;
  for (QTreeWidgetItemIterator each(tree, QTreeWidgetItemIterator::NotHidden); *each; ++each) {
    rows += (*each)->childCount() == 0 ? 1 : 0;
  }
  QVERIFY2(rows >= least && rows <= most, qPrintable(QString::number(rows)));
}

void CommandsTest::chosenColours_areAppliedAndRemembered() {
  const QPalette before = QApplication::palette();
  WindowFixture f;
  QVERIFY(f.window.bench().commands.find("theme.system")->isChecked());

  f.trigger("theme.dark");

  QVERIFY(theme::is_dark(QApplication::palette()));
  QTRY_VERIFY_WITH_TIMEOUT(theme::is_dark(f.window.findChild<MethodPanel*>()->palette()),
                           kPatience);
  QCOMPARE(remembered_theme(), QString("dark"));
  f.trigger("theme.light");
  QTRY_VERIFY_WITH_TIMEOUT(!theme::is_dark(f.window.findChild<MethodPanel*>()->palette()),
                           kPatience);
  f.trigger("theme.system");
  QCOMPARE(QApplication::palette().color(QPalette::Window), before.color(QPalette::Window));
  QVERIFY(!apply_theme("blue"));
}

void CommandsTest::palette_namesWhatCannotBeRunNow() {
  WindowFixture f;
  f.trigger("help.palette");
  auto* edit = f.window.findChild<QLineEdit*>("command_palette.edit");
  const auto* list = f.window.findChild<QListWidget*>("command_palette.list");

  QTest::keyClicks(edit, "export masks");
  QCOMPARE(list->count(), 1);
  QVERIFY(!list->item(0)->flags().testFlag(Qt::ItemIsEnabled));
  QTest::keyClick(edit, Qt::Key_Return);
  QVERIFY(edit->isVisible());

  QTest::keyClicks(edit, " xyzzy");
  QCOMPARE(list->count(), 1);
  QVERIFY2(list->item(0)->text().startsWith("Nothing"), qPrintable(list->item(0)->text()));
}

void CommandsTest::palette_elidesLongNames() {
  WindowFixture f;
  remember_recent("/home/" + QString("somebody/").repeated(20) + "lf.h5");

  f.trigger("help.palette");

  const auto* list = f.window.findChild<QListWidget*>("command_palette.list");
  QTest::keyClicks(f.window.findChild<QLineEdit*>("command_palette.edit"), "somebody");
  QCOMPARE(list->count(), 1);
  QVERIFY(list->fontMetrics().horizontalAdvance(list->item(0)->text()) > list->width());
  QCoreApplication::processEvents();
  QCOMPARE(list->horizontalScrollBar()->maximum(), 0);
  QCOMPARE(list->textElideMode(), Qt::ElideMiddle);
}

void CommandsTest::palette_findsByDescriptionSynonymMethodAndLightField_data() {
  QTest::addColumn<QString>("words");
  QTest::addColumn<QString>("title");
  QTest::newRow("name") << "quit"
                        << "File: Quit";
  QTest::newRow("description") << "exposure gamma"
                               << "View: Brightness…";
  QTest::newRow("synonym") << "screenshot"
                           << "File › Export: Picture…";
  QTest::newRow("synonym of a group") << "heat map background"
                                      << "View › Map: True background";
  QTest::newRow("synonym of a tab") << "histogram"
                                    << "View › Tabs: Compare tab";
  QTest::newRow("synonym of the 3D tab") << "point cloud"
                                         << "View › Tabs: 3D tab";
  QTest::newRow("method") << "Wanner Goldluecke 2012"
                          << "Method: EPI_L";
  QTest::newRow("open") << "open light field edge"
                        << "Open light field: edge";
  QTest::newRow("recent") << "recent lf.h5"
                          << "Recent: ";
}

void CommandsTest::palette_findsByDescriptionSynonymMethodAndLightField() {
  QFETCH(QString, words);
  QFETCH(QString, title);
  WindowFixture f;
  f.openSmall();
  f.trigger("help.palette");
  auto* list = f.window.findChild<QListWidget*>("command_palette.list");

  QTest::keyClicks(f.window.findChild<QLineEdit*>("command_palette.edit"), words);

  QVERIFY2(!list->findItems(title, Qt::MatchStartsWith).isEmpty(),
           qPrintable(list->item(0)->text()));
}

void CommandsTest::palette_findsAndRunsACommand() {
  WindowFixture f;
  f.openSmall();
  f.window.bench().commands.find("help.palette")->trigger();
  auto* edit = f.window.findChild<QLineEdit*>("command_palette.edit");
  auto* list = f.window.findChild<QListWidget*>("command_palette.list");
  const int all = list->count();

  QTest::keyClicks(edit, "zoom xyzzy");
  QCOMPARE(list->findItems("Nothing", Qt::MatchStartsWith).size(), 1);
  edit->clear();
  QTest::keyClicks(edit, "zoom percent");
  QCOMPARE(list->count(), 1);
  QVERIFY(all > 1);
  QTest::keyClick(edit, Qt::Key_Return);

  auto* canvas = f.window.bench().viewer_area.canvas();
  const double actual = 1 / canvas->devicePixelRatioF();
  // Not QTRY_COMPARE, which waits for equal bits.
  QTRY_VERIFY_WITH_TIMEOUT(qFuzzyCompare(canvas->canvasTransform().scale, actual), kPatience);
}

namespace {

// The window of keys with the row of a command chosen.
QWidget* choose(WindowFixture& f, const QString& id) {
  f.window.bench().commands.find("help.keys")->trigger();
  auto* dialog = f.window.findChild<QWidget*>("shortcut_window");
  auto* tree = dialog->findChild<QTreeWidget*>("keys.tree");
  const QString tip = f.window.bench().commands.find(id)->statusTip();
  tree->setCurrentItem(tree->findItems(tip, Qt::MatchExactly | Qt::MatchRecursive, 1).front());
  return dialog;
}

void press(QWidget* dialog, const QKeySequence& key) {
  dialog->findChild<QKeySequenceEdit*>("keys.edit")->setKeySequence(key);
}

void click(QWidget* dialog, const char* name) {
  auto* button = dialog->findChild<QPushButton*>(name);
  QVERIFY2(button->isEnabled(), name);
  QTest::mouseClick(button, Qt::LeftButton);
}

}  // namespace

void CommandsTest::changedKey_worksIsShownAndRemembered() {
  WindowFixture f;
  f.openSmall();
  QWidget* dialog = choose(f, "view.fit");
  press(dialog, QKeySequence("Ctrl+Alt+J"));
  click(dialog, "keys.set");
  dialog->hide();

  const QAction* action = f.window.bench().commands.find("view.fit");
  QCOMPARE(action->shortcut(), QKeySequence("Ctrl+Alt+J"));
  QVERIFY2(action->toolTip().contains("Ctrl+Alt+J"), qPrintable(action->toolTip()));
  auto* canvas = f.window.bench().viewer_area.canvas();
  canvas->zoomIn();
  f.window.activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&f.window));
  canvas->setFocus();
  QTest::keyClick(canvas, Qt::Key_J, Qt::ControlModifier | Qt::AltModifier);
  QTRY_VERIFY_WITH_TIMEOUT(canvas->isFitted(), kPatience);
  MainWindow next;
  QCOMPARE(next.bench().commands.find("view.fit")->shortcut(), QKeySequence("Ctrl+Alt+J"));
}

void CommandsTest::keysOfTheView_areThoseOfTheTable_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<bool>("in_grid");
  for (const char* id :
       {"view.zoom_in", "view.zoom_out", "view.fit", "view.actual_size", "view.play"}) {
    QTest::newRow(id) << QString(id) << false;
  }
  for (const char* id : {"view.left", "view.right_most", "view.up", "view.down", "view.center"}) {
    QTest::newRow(id) << QString(id) << false;
    QTest::addRow("%s in the grid", id) << QString(id) << true;
  }
}

// A command of the view is heard by the key it has now, and no longer by the one it had.
void CommandsTest::keysOfTheView_areThoseOfTheTable() {
  QFETCH(QString, id);
  QFETCH(bool, in_grid);
  WindowFixture f;
  f.openSmall();
  f.window.bench().session.set_view({3, 3});
  Commands& table = f.window.bench().commands;
  ViewCanvas* canvas = f.canvas();
  auto& grid = find<ViewGrid>(f.window);
  QWidget* focused = in_grid ? static_cast<QWidget*>(grid.cells()) : canvas;
  focused->setFocus();
  f.window.activateWindow();
  QTRY_VERIFY_WITH_TIMEOUT(focused->hasFocus(), kPatience);
  const QSignalSpy ran(table.find(id), &QAction::triggered);
  const QKeyCombination own = table.keys(id).front()[0];
  const auto press = [&](QKeyCombination key) {
    QTest::keyClick(focused, key.key(), key.keyboardModifiers());
  };
  const auto place = [&] {
    return std::tuple(f.window.bench().session.view(), canvas->canvasTransform().scale,
                      grid.isPlaying());
  };

  press(own);
  QCOMPARE(ran.size(), 1);
  grid.setPlaying(false);

  table.setKeys(id, {QKeySequence("Ctrl+Alt+J")});
  QVERIFY(table.find(id)->toolTip().contains("Ctrl+Alt+J"));
  const auto before = place();
  press(own);
  QCOMPARE(ran.size(), 1);
  QVERIFY(place() == before);
  press(Qt::CTRL | Qt::ALT | Qt::Key_J);
  QCOMPARE(ran.size(), 2);
}

void CommandsTest::keyOfAnotherCommand_isNamedAndTakenOnlyWhenAsked() {
  WindowFixture f;
  const Commands& table = f.window.bench().commands;
  QWidget* dialog = choose(f, "view.fit");

  press(dialog, QKeySequence("G"));

  const QString hint = dialog->findChild<QLabel*>("keys.hint")->text();
  QVERIFY2(hint.contains(table.find("compare.tiles")->text()), qPrintable(hint));
  QCOMPARE(table.find("compare.tiles")->shortcut(), QKeySequence("G"));
  click(dialog, "keys.set");
  QCOMPARE(table.find("view.fit")->shortcut(), QKeySequence("G"));
  QVERIFY(table.find("compare.tiles")->shortcut().isEmpty());
}

void CommandsTest::emptyCanvas_namesTheKeyThatOpens() {
  WindowFixture f;
  const auto drawn = [&f] { return f.window.bench().viewer_area.canvas()->grab().toImage(); };
  const QImage own = drawn();

  f.window.bench().commands.setKeys("file.open", {QKeySequence("Ctrl+Alt+J")});
  QVERIFY(drawn() != own);
  f.window.bench().commands.resetKeys("file.open");
  QCOMPARE(drawn(), own);
}

void CommandsTest::defaults_comeBack() {
  WindowFixture f;
  const Commands& table = f.window.bench().commands;
  QWidget* dialog = choose(f, "view.fit");
  press(dialog, QKeySequence("G"));
  click(dialog, "keys.set");

  click(dialog, "keys.reset");
  QCOMPARE(table.find("view.fit")->shortcut(), QKeySequence("K"));
  QVERIFY(table.find("compare.tiles")->shortcut().isEmpty());
  click(dialog, "keys.resetAll");
  QCOMPARE(table.find("compare.tiles")->shortcut(), QKeySequence("G"));
  QVERIFY(!QSettings().contains("keys/view.fit"));
}

}  // namespace episcope::in_commands_test

EPISCOPE_WINDOW_TEST(commands_test, CommandsTest)
#include "commands_test.moc"
