// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/appearance.h"
#include "app/gui/shell/jobs.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"
#include "widgets/panels/label_palette.h"
#include "widgets/panels/metric_table.h"

#include <QAbstractButton>
#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QKeySequence>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QMenuBar>
#include <QSet>
#include <QSignalSpy>
#include <QTabBar>
#include <QTabWidget>
#include <QTreeWidget>

#include <clocale>
#include <cstdlib>

namespace episcope::in_language_test {
namespace {

QString menu_file() {
  return QCoreApplication::translate("episcope::Menu", "File");
}

// Keys that two entries of a menu share.
QStringList shared_mnemonics(const QMenu& menu) {
  QStringList shared;
  QSet<QChar> used;
  for (const QAction* action : menu.actions()) {
    QString text = action->text();
    const qsizetype place = text.remove("&&").indexOf('&');
    if (place < 0 || place + 1 >= text.size()) continue;
    const QChar key = text[place + 1].toLower();
    if (used.contains(key)) shared << action->text();
    used.insert(key);
  }
  return shared;
}

bool wraps_or_elides(const QWidget& widget) {
  const auto* label = qobject_cast<const QLabel*>(&widget);
  return qobject_cast<const ElidedLabel*>(&widget) || (label && label->wordWrap());
}

// Visible labels and buttons that are narrower than their text.
QStringList cut_texts(const QWidget& window) {
  QStringList cut;
  for (const auto* widget : window.findChildren<QWidget*>()) {
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    const auto* label = qobject_cast<const QLabel*>(widget);
    const QString text = button ? button->text() : label ? label->text() : QString();
    if (text.isEmpty() || !widget->isVisible() || wraps_or_elides(*widget)) continue;
    const int needed = widget->minimumSizeHint().width();
    if (widget->width() < needed) {
      cut << QString("%1 “%2”: %3 < %4 px")
                 .arg(widget->objectName(), text)
                 .arg(widget->width())
                 .arg(needed);
    }
  }
  return cut;
}

// The keys of a CSV table and, for each cell, whether it is a number; words are in the language of
// the window.
QStringList kinds_of_cells(const QString& csv) {
  const QStringList lines = csv.trimmed().split('\n');
  QStringList kinds{lines.front()};
  for (const QString& cell : lines.mid(1).join(',').split(',')) {
    bool is_number = false;
    cell.toDouble(&is_number);
    kinds << (is_number ? "number" : "text");
  }
  return kinds;
}

// What a user takes out of the window after a run.
QStringList copied_from_a_window() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.trigger("estimate.copy_command");
  const QString command = QGuiApplication::clipboard()->text();
  const auto* table = f.window.findChild<MetricTable*>();
  const auto is_scored = [&] { return kinds_of_cells(table->toCsv()).count("number") > 10; };
  (void)QTest::qWaitFor(is_scored, 60000);  // in the background
  return QStringList{command.section(' ', 0, 2), command.section("--", 1)} +
         kinds_of_cells(table->toCsv());
}

}  // namespace

class LanguageTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    if (!languages().contains("de")) QSKIP("built without lrelease: the window is in English");
    QVERIFY(apply_language("en"));
  }
  void cleanup() { apply_language("en"); }
  void languageOfTheDesktop_isTheFirstThatIsThere_data();
  void languageOfTheDesktop_isTheFirstThatIsThere();
  void appliedLanguage_translatesTheWindowAndQt();
  void unknownLanguage_changesNothing();
  void composedSteps_areTranslated();
  void failuresOfJobs_areWholeSentences();
  void english_hasPlurals();
  void keys_areReadAndWrittenInEveryLanguage();
  void numbersOfTheCLibrary_keepThePoint();
  void whatIsCopied_isTheSameInEveryLanguage();
  void nameOfANewLabel_isTranslated();
  void labelWithoutAName_isCalledByItsIdInEveryLanguage();
  void choice_isRemembered();
  void mnemonics_areUniqueInAMenu();
  void noText_isCut_data();
  void noText_isCut();
  void tabs_doNotScroll_data();
  void tabs_doNotScroll();
};

void LanguageTest::languageOfTheDesktop_isTheFirstThatIsThere_data() {
  QTest::addColumn<QStringList>("wanted");
  QTest::addColumn<QString>("language");
  QTest::newRow("country") << QStringList{"de-AT", "de"} << "de";
  QTest::newRow("as POSIX writes it") << QStringList{"de_DE.UTF-8"} << "de";
  QTest::newRow("second choice") << QStringList{"fr-FR", "de-CH"} << "de";
  QTest::newRow("English first") << QStringList{"en-GB", "de-DE"} << "en";
  QTest::newRow("none is there") << QStringList{"fr", "it"} << "en";
  QTest::newRow("C") << QStringList{"C", "de"} << "en";
  QTest::newRow("nothing") << QStringList{} << "en";
}

void LanguageTest::languageOfTheDesktop_isTheFirstThatIsThere() {
  QFETCH(QStringList, wanted);
  QFETCH(QString, language);

  QCOMPARE(language_for(wanted, {"de", "en"}), language);
}

void LanguageTest::appliedLanguage_translatesTheWindowAndQt() {
  QVERIFY(apply_language("de"));

  QCOMPARE(menu_file(), QString("Datei"));
  QCOMPARE(QCoreApplication::translate("episcope::Schema", "Disparity range"),
           QString("Disparitätsbereich"));
  QCOMPARE(QCoreApplication::translate("QPlatformTheme", "Cancel"), QString("Abbrechen"));
  QCOMPARE(QLocale().language(), QLocale::German);

  QVERIFY(apply_language("en"));
  QCOMPARE(menu_file(), QString("File"));
  QCOMPARE(QCoreApplication::translate("QPlatformTheme", "Cancel"), QString("Cancel"));
}

void LanguageTest::unknownLanguage_changesNothing() {
  QVERIFY(apply_language("de"));

  QVERIFY(!apply_language("tlh"));

  QCOMPARE(menu_file(), QString("Datei"));
}

void LanguageTest::composedSteps_areTranslated() {
  QVERIFY(apply_language("de"));
  WindowFixture f;
  Jobs& jobs = f.window.bench().jobs;
  const QSignalSpy progressed(&jobs, &Jobs::progressed);

  jobs.start<bool>(
      Lane::Load, "",
      [](const Progress& progress) {
        progress.step("rendering the scene edge");
        return true;
      },
      [](bool) {});

  QTRY_VERIFY(!progressed.empty());
  QCOMPARE(progressed.front()[2].toString(), QString("Szene edge wird gerendert"));
}

void LanguageTest::english_hasPlurals() {
  const auto sentence = [](int count) {
    return QCoreApplication::translate("episcope::MeasureController",
                                       "%n measured line(s) copied as CSV.", nullptr, count);
  };
  QCOMPARE(sentence(1), QString("1 measured line copied as CSV."));
  QCOMPARE(sentence(2), QString("2 measured lines copied as CSV."));
}

void LanguageTest::keys_areReadAndWrittenInEveryLanguage() {
  QVERIFY(apply_language("de"));

  const QKeySequence key("Ctrl+Shift+PgDown");

  QCOMPARE(key, QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_PageDown));
  QCOMPARE(key.toString(QKeySequence::NativeText), QString("Strg+Umschalt+Bild ab"));
  QCOMPARE(QKeySequence("Strg+Umschalt+Bild ab"), key);
}

void LanguageTest::numbersOfTheCLibrary_keepThePoint() {
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8")) {
    QSKIP("the system has no German locale (locale-gen de_DE.UTF-8)");
  }
  QCOMPARE(std::strtod("0.5", nullptr), 0.0);

  QVERIFY(apply_language("de"));

  QCOMPARE(std::strtod("0.5", nullptr), 0.5);
}

void LanguageTest::whatIsCopied_isTheSameInEveryLanguage() {
  const QStringList english = copied_from_a_window();
  QVERIFY(english.count("number") > 10);

  QVERIFY(apply_language("de"));

  QCOMPARE(copied_from_a_window(), english);
}

void LanguageTest::nameOfANewLabel_isTranslated() {
  QVERIFY(apply_language("de"));
  WindowFixture f;
  f.openSmall();
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().document.document(), kPatience);
  f.trigger("annotate.mode");

  f.drag({20, 20}, {20, 40});
  f.trigger("annotate.add_label");

  QCOMPARE(f.document().labels().find(1)->name, std::string("Label 1"));
  QCOMPARE(f.document().labels().find(2)->name, std::string("Label 2"));
}

void LanguageTest::choice_isRemembered() {
  WindowFixture f;
  QCOMPARE(remembered_language(), QString("system"));
  QVERIFY(f.window.bench().commands.find("language.system")->isChecked());

  f.trigger("language.de");

  QCOMPARE(remembered_language(), QString("de"));
  QVERIFY(f.window.bench().commands.find("language.de")->isChecked());
  QVERIFY(!f.window.bench().commands.find("language.system")->isChecked());
  QCOMPARE(f.window.bench().commands.find("language.de")->text(), QString("Deutsch"));
  QCOMPARE(menu_file(), QString("File"));
}

void LanguageTest::mnemonics_areUniqueInAMenu() {
  QMenu twice;
  twice.addAction("&Open");
  twice.addAction("&Over");
  QCOMPARE(shared_mnemonics(twice), QStringList("&Over"));

  QVERIFY(apply_language("de"));
  WindowFixture f;
  const auto* bar = f.window.findChild<QMenuBar*>();
  QVERIFY(bar && bar->actions().size() > 4);
  QSet<QString> keys;
  for (const QAction* menu : bar->actions()) keys << menu->text().section('&', 1).left(1).toLower();
  QCOMPARE(keys.size(), bar->actions().size());
  const QList<QMenu*> menus = f.window.findChildren<QMenu*>();
  QVERIFY(menus.size() > 6);
  for (const QMenu* menu : menus) QCOMPARE(shared_mnemonics(*menu).join(" | "), QString());
}

void LanguageTest::noText_isCut_data() {
  QTest::addColumn<QString>("language");
  QTest::addColumn<QSize>("size");
  for (const char* language : {"de", "en"}) {
    QTest::addRow("%s, small", language) << language << QSize(1280, 760);
    QTest::addRow("%s, large", language) << language << QSize(2560, 1400);
  }
}

void LanguageTest::noText_isCut() {
  QFETCH(QString, language);
  QFETCH(QSize, size);
  QVERIFY(apply_language(language));
  WindowFixture f;
  f.window.resize(size);
  f.openSmall();
  for (const Tab& tab : f.window.bench().frame.tabs()) {
    f.window.bench().frame.showTab(tab.id);
    QCoreApplication::processEvents();
    QCOMPARE(cut_texts(f.window).join(" | "), QString());
  }
  const auto* surplus = f.window.findChild<QWidget*>("qt_toolbar_ext_button");
  QVERIFY(surplus && !surplus->isVisible());
}

void LanguageTest::tabs_doNotScroll_data() {
  QTest::addColumn<QString>("language");
  for (const char* language : {"de", "en"}) QTest::newRow(language) << language;
}

// Also those that come when they are asked for, and the pages of a task.
void LanguageTest::tabs_doNotScroll() {
  QFETCH(QString, language);
  QVERIFY(apply_language(language));
  WindowFixture f;
  f.openSmall();
  const auto* tabs = f.window.findChild<QTabWidget*>("tabs");
  QCOMPARE(tabs->count(), 5);
  for (int i = 0; i < tabs->count(); ++i) {
    const QRect tab = tabs->tabBar()->tabRect(i);
    QVERIFY2(tabs->tabBar()->rect().contains(tab), qPrintable(tabs->tabText(i)));
    QVERIFY2(tab.width() > tabs->fontMetrics().horizontalAdvance(tabs->tabText(i)),
             qPrintable(tabs->tabText(i)));
  }

  for (const Tab& tab : f.window.bench().frame.tabs()) f.window.bench().frame.showTab(tab.id);
  QCoreApplication::processEvents();

  QCOMPARE(tabs->count(), 5);
  for (const auto* bar : f.window.findChildren<QTabBar*>()) {
    if (bar->count() == 0 || !bar->isVisible()) continue;
    QVERIFY2(bar->rect().contains(bar->tabRect(bar->count() - 1)),
             qPrintable(QString("%1 ends at %2 of %3")
                            .arg(bar->tabText(bar->count() - 1))
                            .arg(bar->tabRect(bar->count() - 1).right())
                            .arg(bar->width())));
    QVERIFY(bar->tabRect(0).left() >= 0);
    for (int i = 0; i < bar->count(); ++i) {
      QVERIFY2(bar->tabRect(i).width() > bar->fontMetrics().horizontalAdvance(bar->tabText(i)),
               qPrintable(bar->tabText(i)));
    }
  }
}

void LanguageTest::failuresOfJobs_areWholeSentences() {
  QVERIFY(apply_language("de"));
  WindowFixture f;
  f.openSmall();
  const QSignalSpy failures(&f.window.bench().jobs, &Jobs::failed);

  f.window.bench().opener.open("/no/such/place");

  QTRY_COMPARE(failures.size(), 1);
  const QString sentence = failures[0][0].toString();
  QVERIFY2(sentence.startsWith("Öffnen von place fehlgeschlagen: "), qPrintable(sentence));
}

void LanguageTest::labelWithoutAName_isCalledByItsIdInEveryLanguage() {
  QVERIFY(apply_language("de"));
  LabelPalette palette;

  palette.setLabels({default_label(3), {4, "tree", {1, 2, 3}}});

  const auto* list = palette.findChild<QTreeWidget*>();
  const auto count = [&](const char* name) {
    return list->findItems(name, Qt::MatchExactly, 2).size() +
           list->findItems(name, Qt::MatchExactly, 1).size();
  };
  QCOMPARE(count("Label 3"), 1);
  QCOMPARE(count("tree"), 1);
}

}  // namespace episcope::in_language_test

EPISCOPE_WINDOW_TEST(language_test, LanguageTest)
#include "language_test.moc"
