// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/main_window.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "app/session/session.h"
#include "engine/io/formats/write_scene.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"
#include "widgets/panels/info_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QToolButton>
#include <QTreeWidget>

namespace episcope::in_conventions_test {

namespace {

QDialog* open_dialog(MainWindow& window) {
  auto* button = window.findChild<QToolButton*>("info.conventions");
  if (!button || !button->isEnabled()) return nullptr;
  QTest::mouseClick(button, Qt::LeftButton);
  return window.findChild<QDialog*>("conventions");
}

// Chooses with keys, as a person does: the first entry, then so many down.
void choose(QDialog* dialog, const char* name, int steps_down) {
  auto* box = dialog->findChild<QComboBox*>(name);
  QVERIFY(box);
  dialog->activateWindow();
  QTRY_COMPARE_WITH_TIMEOUT(QApplication::activeWindow(), dialog, kPatience);
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Home);
  for (int i = 0; i < steps_down; ++i) QTest::keyClick(box, Qt::Key_Down);
  QCOMPARE(box->currentIndex(), steps_down);
}

void click(QDialog* dialog, const char* name) {
  auto* button = dialog->findChild<QPushButton*>(name);
  QVERIFY(button);
  QTest::mouseClick(button, Qt::LeftButton);
}

// Applies what the dialog says and waits for the scene that comes of it.
void apply(MainWindow& window, QDialog* dialog) {
  const auto before = window.bench().session.generation();
  click(dialog, "conventions.apply");
  QTRY_VERIFY_WITH_TIMEOUT(
      window.bench().session.generation() > before && window.bench().session.scene(),
      kScenePatience);
}

QString order_shown(const MainWindow& window) {
  const auto* label = window.findChild<FoldedLabel*>("info.order");
  return label ? label->fullText() : QString();
}

// A grid of three rows and four columns whose names tell the column first.
QString write_odd_grid(const QString& folder) {
  QDir().mkpath(folder);
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 4; ++u) {
      QImage image(16, 12, QImage::Format_RGB888);
      image.fill(QColor(20 * v, 20 * u, 90));
      image.save(folder + QString("/take-%1of%2-final.png").arg(u + 1).arg(v + 1));
    }
  }
  return folder;
}

// Views of one color each: nothing tells how they lie.
QString write_plain_list(const QString& folder, int count) {
  QDir().mkpath(folder);
  for (int i = 0; i < count; ++i) {
    QImage image(16, 12, QImage::Format_RGB888);
    image.fill(QColor(20 * i, 90, 90));
    image.save(folder + QString("/a%1.png").arg(i));
  }
  return folder;
}

}  // namespace

class ConventionsTest : public QObject {
  Q_OBJECT

 private slots:
  void everyLabel_isSeenInFull();
  void optionsInWarnings_areNamedAsInTheDialog();
  void chosenOrder_readsTheFileAgain();
  void reversedSign_isRememberedAndReversesBack();
  void choice_isRememberedForItsFileOnly();
  void allAutomatic_forgetsTheChoice();
  void chosenUnits_areShownAsSetByTheUser();
  void copiedCommand_readsAlike();
  void cancel_changesNothing();
  void builtinScene_hasNoChoice();
  void gridOfOddNames_opensByPattern();
  void pattern_isPreviewedWhileTyped();
  void missingViews_areToldBesideThePattern();
  void viewsThatTellNothing_areAskedFor();
  void questionThatIsCancelled_opensNothing();
  void folderThatFailed_mayBeReadOtherwise();
  void rememberedChoiceThatNoLongerFits_isToldAndNotUsed();
};

void ConventionsTest::chosenOrder_readsTheFileAgain() {
  WindowFixture f;
  f.openSmall();
  const auto before = f.window.bench().session.scene();
  const auto first = before->light_field->view<std::uint8_t>({0, 0});

  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "flip.combo", 2);
  apply(f.window, dialog);

  const auto after = f.window.bench().session.light_field()->view<std::uint8_t>({0, 8});
  QVERIFY(std::equal(first.data, first.data + first.size(), after.data));
  QTRY_VERIFY2_WITH_TIMEOUT(order_shown(f.window).contains("(set by you)"),
                            qPrintable(order_shown(f.window)), kPatience);
}

void ConventionsTest::reversedSign_isRememberedAndReversesBack() {
  WindowFixture f;
  f.openSmall();
  const ConventionReport first = f.window.bench().session.scene()->convention;
  const auto press = [&f] {
    const auto before = f.window.bench().session.generation();
    f.click("info.more.sign");
    auto* button = f.window.findChild<QToolButton*>("info.action");
    QVERIFY(button && button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.generation() > before, kScenePatience);
  };

  press();
  const ConventionReport& reversed = f.window.bench().session.scene()->convention;
  QCOMPARE(reversed.reversed_u, !first.reversed_u);
  QCOMPARE(reversed.reversed_v, !first.reversed_v);
  QCOMPARE(remembered_conventions(f.path("edge/lf.h5")).size(), std::size_t{1});

  press();
  const ConventionReport& back = f.window.bench().session.scene()->convention;
  QCOMPARE(back.reversed_u, first.reversed_u);
  QCOMPARE(back.reversed_v, first.reversed_v);
}

void ConventionsTest::choice_isRememberedForItsFileOnly() {
  WindowFixture f;
  f.openSmall();
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "flip.combo", 3);
  apply(f.window, dialog);

  f.openSmall("slant");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.input().find("slant") != std::string::npos,
                           kPatience);
  QVERIFY(f.window.bench().session.reading_options().empty());
  f.openSmall("edge");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.input().find("edge") != std::string::npos,
                           kPatience);

  QVERIFY(f.window.bench().session.reading_options() == (ParameterSet{{"flip", "v"}}));
  QVERIFY(f.window.bench().session.scene()->convention.reversed_v);
}

void ConventionsTest::allAutomatic_forgetsTheChoice() {
  WindowFixture f;
  f.openSmall();
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "flip.combo", 4);
  apply(f.window, dialog);
  QTRY_VERIFY_WITH_TIMEOUT(order_shown(f.window).contains("(set by you)"), kPatience);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.findChild<QDialog*>("conventions"), kPatience);

  dialog = open_dialog(f.window);
  QVERIFY(dialog);
  QCOMPARE(dialog->findChild<QComboBox*>("flip.combo")->currentIndex(), 4);
  click(dialog, "conventions.reset");
  apply(f.window, dialog);

  QTRY_VERIFY_WITH_TIMEOUT(!order_shown(f.window).contains("(set by you)"), kPatience);
  QVERIFY(remembered_conventions(f.path("edge/lf.h5")).empty());
}

void ConventionsTest::chosenUnits_areShownAsSetByTheUser() {
  WindowFixture f;
  f.openSmall();
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "units.combo", 1);
  apply(f.window, dialog);

  const auto text = [&f] {
    QString all;
    for (const auto* label : f.window.findChild<InfoPanel*>()->findChildren<FoldedLabel*>()) {
      all += label->fullText();
    }
    return all;
  };
  QTRY_VERIFY2_WITH_TIMEOUT(text().contains("(set by you)"), qPrintable(text()), kPatience);
}

void ConventionsTest::copiedCommand_readsAlike() {
  WindowFixture f;
  f.openSmall();
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "flip.combo", 1);
  apply(f.window, dialog);

  f.window.bench().commands.find("estimate.copy_command")->trigger();

  const QString command = QApplication::clipboard()->text();
  QVERIFY2(command.endsWith(" --flip=none"), qPrintable(command));
}

void ConventionsTest::cancel_changesNothing() {
  WindowFixture f;
  f.openSmall();
  const auto before = f.window.bench().session.generation();
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  choose(dialog, "flip.combo", 2);

  QTest::keyClick(dialog, Qt::Key_Escape);

  QTRY_VERIFY_WITH_TIMEOUT(!f.window.findChild<QDialog*>("conventions"), kPatience);
  QCOMPARE(f.window.bench().session.generation(), before);
  QVERIFY(remembered_conventions(f.path("edge/lf.h5")).empty());
}

void ConventionsTest::builtinScene_hasNoChoice() {
  WindowFixture f;
  QVERIFY(!f.window.bench().commands.find("file.conventions")->isEnabled());
  f.window.bench().opener.open("demo:fronto");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("estimate.run")->isEnabled(),
                           kScenePatience);

  QVERIFY(!f.window.bench().commands.find("file.conventions")->isEnabled());
}

void ConventionsTest::gridOfOddNames_opensByPattern() {
  WindowFixture f;
  f.window.bench().opener.open(write_odd_grid(f.path("odd")));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("file.conventions")->isEnabled(),
                           kPatience);
  QVERIFY(f.window.bench().session.scene());
  // Left alone, a reader takes the first number for the row.
  QVERIFY(f.window.bench().session.light_field()->grid() == (GridShape{4, 3}));

  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  QTest::keyClicks(dialog->findChild<QLineEdit*>("pattern.text"), "take-{col}of{row}-final.png");
  apply(f.window, dialog);

  QVERIFY(f.window.bench().session.light_field()->grid() == (GridShape{3, 4}));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<QLabel*>("info.names"), kPatience);
}

void ConventionsTest::pattern_isPreviewedWhileTyped() {
  WindowFixture f;
  f.window.bench().opener.open(write_odd_grid(f.path("odd")));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);
  auto* summary = dialog->findChild<QLabel*>("pattern.summary");
  auto* names = dialog->findChild<QTreeWidget*>("pattern.names");
  auto* line = dialog->findChild<QLineEdit*>("pattern.text");
  QVERIFY(summary && names && line);
  QTRY_COMPARE_WITH_TIMEOUT(names->topLevelItemCount(), 12, kPatience);
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().contains("4×3"), qPrintable(summary->text()),
                            kPatience);

  QTest::keyClicks(line, "take-{col}of{row}-final.png");
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().contains("12 of 12") && summary->text().contains("3×4"),
                            qPrintable(summary->text()), kPatience);
  QCOMPARE(names->topLevelItem(1)->text(0), QString("take-1of2-final.png"));
  QCOMPARE(names->topLevelItem(1)->text(1), QString("2"));

  QTest::keyClicks(line, "x");
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().contains("0 of 12"), qPrintable(summary->text()),
                            kPatience);
}

void ConventionsTest::missingViews_areToldBesideThePattern() {
  WindowFixture f;
  const QString folder = write_odd_grid(f.path("odd"));
  QFile::remove(folder + "/take-4of3-final.png");
  f.window.bench().opener.open(folder);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);
  QDialog* dialog = open_dialog(f.window);
  QVERIFY(dialog);

  auto* summary = dialog->findChild<QLabel*>("pattern.summary");
  QTRY_VERIFY2_WITH_TIMEOUT(summary->text().remove(QChar(0x200b)).contains("view 4,3 is missing"),
                            qPrintable(summary->text()), kPatience);
}

void ConventionsTest::viewsThatTellNothing_areAskedFor() {
  WindowFixture f;
  const QString folder = write_plain_list(f.path("plain"), 6);
  f.window.bench().opener.open(folder);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<QDialog*>("readingQuestion"), kScenePatience);
  auto* dialog = f.window.findChild<QDialog*>("readingQuestion");
  QVERIFY(!f.window.bench().session.scene());

  auto* choice = dialog->findChild<QRadioButton*>("readingQuestion.2x3");
  QVERIFY(choice);
  QTest::mouseClick(choice, Qt::LeftButton, {}, QPoint(10, choice->height() / 2));
  QTest::mouseClick(dialog->findChild<QPushButton*>("readingQuestion.ok"), Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene(), kScenePatience);

  QVERIFY(f.window.bench().session.light_field()->grid() == (GridShape{2, 3}));
  QVERIFY(remembered_conventions(folder) == (ParameterSet{{"grid", "2x3"}}));
}

void ConventionsTest::questionThatIsCancelled_opensNothing() {
  WindowFixture f;
  const QString folder = write_plain_list(f.path("plain"), 6);
  f.window.bench().opener.open(folder);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<QDialog*>("readingQuestion"), kScenePatience);
  QTest::keyClick(f.window.findChild<QDialog*>("readingQuestion"), Qt::Key_Escape);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.findChild<QDialog*>("readingQuestion"), kPatience);

  QVERIFY(!f.window.bench().session.scene());
  QVERIFY(f.window.bench().opener.hasFailed());
  QVERIFY(remembered_conventions(folder).empty());
}

void ConventionsTest::folderThatFailed_mayBeReadOtherwise() {
  WindowFixture f;
  const QString folder = write_odd_grid(f.path("odd"));
  QVERIFY(QFile::copy(folder + "/take-1of1-final.png", folder + "/take-7of9-final.png"));
  f.window.bench().opener.open(folder);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().commands.find("file.conventions")->isEnabled(),
                           kPatience);
  QVERIFY(!f.window.bench().session.scene());
}

void ConventionsTest::rememberedChoiceThatNoLongerFits_isToldAndNotUsed() {
  WindowFixture f;
  const QString folder = write_odd_grid(f.path("odd"));
  remember_conventions(folder, {{"pattern", "gone-{row}-{col}.png"}});

  f.window.bench().opener.open(folder);

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().session.scene() != nullptr, kScenePatience);
  QVERIFY(f.window.bench().session.reading_options().empty());
  const auto& warnings = f.window.bench().session.scene()->convention.warnings;
  QVERIFY(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("not used") != std::string::npos;
  }));
}

void ConventionsTest::optionsInWarnings_areNamedAsInTheDialog() {
  Scene scene = scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress());
  auto samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone();
  for (int u = 0; u < samples.grid().u; ++u) {
    const auto view = samples.view({4, u});
    for (std::size_t i = 0; i < view.size(); ++i) {
      view.data[i] = static_cast<std::uint8_t>(view.data[i] * (0.6 + 0.05 * u));
    }
  }
  LightFieldInfo info;
  info.name = "uneven";
  scene.light_field = std::make_shared<const LightField>(std::move(samples), info);
  WindowFixture f;
  QDir().mkpath(f.path("uneven"));
  io::write_archive(f.path("uneven/lf.h5").toStdString(), scene, Progress());

  f.window.bench().opener.open(f.path("uneven/lf.h5"));

  const auto warning = [&f]() -> QString {
    const auto texts = find<InfoPanel>(f.window).findChildren<QLabel*>("info.warning.text");
    for (const auto* label : texts) {
      if (label->text().contains("brightness of the views differs")) return label->text();
    }
    return {};
  };
  QTRY_VERIFY_WITH_TIMEOUT(!warning().isEmpty(), kScenePatience);
  QVERIFY2(!warning().contains("--") && warning().contains("“Equalize”"), qPrintable(warning()));
  for (auto* button : find<InfoPanel>(f.window).findChildren<QToolButton*>("info.action")) {
    if (button->isVisible()) QTest::mouseClick(button, Qt::LeftButton);
  }
  QVERIFY(f.window.findChild<QDialog*>("conventions"));
}

void ConventionsTest::everyLabel_isSeenInFull() {
  WindowFixture f;
  f.openSmall();

  QDialog* dialog = open_dialog(f.window);

  QVERIFY(dialog);
  QVERIFY(QTest::qWaitForWindowExposed(dialog));
  for (const auto* label : dialog->findChildren<QLabel*>()) {
    const int wanted = label->wordWrap() ? label->heightForWidth(label->width()) : 0;
    QVERIFY2(label->height() >= wanted, qPrintable(label->text()));
  }
  dialog->reject();
}

}  // namespace episcope::in_conventions_test

EPISCOPE_WINDOW_TEST(conventions_test, ConventionsTest)
#include "conventions_test.moc"
