// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/estimate/result_export.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/result_file.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/text.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/value_bar.h"

#include <QAbstractButton>
#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QPushButton>
#include <QRegularExpression>
#include <QTableWidget>
#include <QTreeWidget>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace episcope::in_results_test {

namespace {

constexpr ViewIndex kOuterView{0, 0};
constexpr int kCorner = 32;

/// A light field whose outermost view shows nothing in a corner, as behind a microlens array.
QString write_vignetted(const WindowFixture& f) {
  Scene scene = scenes::render_builtin("edge", WindowFixture::smallOptions(), Progress());
  auto samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples()).clone();
  const auto view = samples.view(kOuterView);
  for (int y = 0; y < kCorner; ++y) {
    std::fill_n(&view.at(y, 0), kCorner * samples.channels(), std::uint8_t{0});
  }
  LightFieldInfo info;
  info.name = "vignetted";
  scene.light_field = std::make_shared<const LightField>(std::move(samples), info);
  const QString file = f.path("vignetted/lf.h5");
  QDir().mkpath(QFileInfo(file).path());
  io::write_archive(file.toStdString(), scene, Progress());
  return file;
}

}  // namespace

class ResultsTest : public QObject {
  Q_OBJECT

 private slots:
  void commandsOfAResult_areOffWithoutOne();
  void resultsOfTheFormerLightField_areNotListedBesideAPreview();
  void run_listsItsResultWithItsError();
  void resultThatIsNotSeen_isTold_data();
  void resultThatIsNotSeen_isTold();
  void offerToShowAResult_endsOnceItIsSeen();
  void nothingRuns_whileAnotherLightFieldIsRead();
  void rangeSetByHand_staysForOtherMethods();
  void exportedResult_readsBack();
  void exportedMap_marksInvalidPixels();
  void submittedResult_isAccepted();
  void unknownSuffix_isNotWritten();
  void chosenForm_namesTheFile();
  void openedResult_isListed();
  void resultOfAnotherLightField_isRefused();
  void mapOfTheOtherSign_isOpenedWithAWarning_andNegatedWhenAsked();
  void resultOfOtherSamples_isOpenedWithAWarning();
  void lightField_isNoResult();
  void copiedCommand_opensTheSameFile();
  void foundRangeThatEndsAtItsLimit_isTold();
  void form_namesTheRangeThatARunFound();
  void cornerThatAViewDoesNotShow_hasNoDisparity();
};

// They crashed.
void ResultsTest::commandsOfAResult_areOffWithoutOne() {
  WindowFixture f;
  const auto are_on = [&f](bool wanted) {
    return std::ranges::all_of(
        std::array{"file.export", "file.export_submission", "estimate.note", "estimate.remove"},
        [&](const char* id) { return f.window.bench().commands.find(id)->isEnabled() == wanted; });
  };
  QVERIFY(are_on(false));
  f.openSmall();
  QVERIFY(are_on(false));
  f.key(Qt::Key_E, Qt::ControlModifier);
  f.runAndWait();
  QVERIFY(are_on(true));
}

void ResultsTest::resultsOfTheFormerLightField_areNotListedBesideAPreview() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_COMPARE(tree->topLevelItemCount(), 1);

  f.window.bench().viewer_area.showPreview(QImage(96, 96, QImage::Format_RGB32), "being read");

  QCOMPARE(tree->topLevelItemCount(), 0);
  QVERIFY(!f.window.bench().commands.find("file.export")->isEnabled());
  f.window.bench().viewer_area.endPreview();
  QCOMPARE(tree->topLevelItemCount(), 1);
}

void ResultsTest::run_listsItsResultWithItsError() {
  WindowFixture f;
  f.openSmall();

  f.runAndWait();

  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QCOMPARE(tree->topLevelItemCount(), 1);
  const auto row_text = [tree] {
    QString text;
    for (int i = 0; i < tree->columnCount(); ++i) text += tree->topLevelItem(0)->text(i) + '|';
    return text;
  };
  QTRY_VERIFY2_WITH_TIMEOUT(row_text().contains(QRegularExpression("\\d+\\.\\d\\d\\|.*s\\|")),
                            qPrintable(row_text()), kPatience);
  QCOMPARE(f.window.bench().overlay.quantity(), render::Quantity::Disparity);
}

void ResultsTest::resultThatIsNotSeen_isTold_data() {
  QTest::addColumn<bool>("is_row_clicked");
  QTest::newRow("in the message") << false;
  QTest::newRow("in the list") << true;
}

// Under another map, or in a view that the result lacks, a run once seemed to do nothing.
void ResultsTest::resultThatIsNotSeen_isTold() {
  QFETCH(bool, is_row_clicked);
  WindowFixture f;
  f.openSmall();
  Overlay& overlay = f.window.bench().overlay;
  overlay.setQuantity(render::Quantity::Truth);
  f.window.bench().session.set_view(kOuterView);
  QCoreApplication::processEvents();
  auto* bar = f.window.findChild<MessageBar*>("messageBar");

  find<EstimateController>(f.window).run({"st_ch_l", {}, {.views = ViewSelection::Center}});

  QTRY_VERIFY2_WITH_TIMEOUT(bar->text().startsWith("New result: ST_CH_L"), qPrintable(bar->text()),
                            kScenePatience);
  QCOMPARE(overlay.quantity(), render::Quantity::Truth);
  QCOMPARE(f.view(), kOuterView);
  auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_VERIFY(tree->topLevelItem(0) && tree->topLevelItem(0)->text(0) == "new");

  const QPoint row = tree->visualItemRect(tree->topLevelItem(0)).center();
  is_row_clicked
      ? QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, row)
      : QTest::mouseClick(bar->findChild<QPushButton*>("message.action"), Qt::LeftButton);

  QCOMPARE(overlay.quantity(), render::Quantity::Disparity);
  QCOMPARE(f.view(), (ViewIndex{4, 4}));
  QTRY_VERIFY(tree->topLevelItem(0)->text(0).isEmpty());
}

void ResultsTest::nothingRuns_whileAnotherLightFieldIsRead() {
  WindowFixture f;
  f.openSmall();
  ViewerArea& area = f.window.bench().viewer_area;
  const Commands& commands = f.window.bench().commands;
  f.trigger("tab.sweep");
  const auto can_run = [&] {
    std::vector<bool> answers;
    for (const char* button : {"method.run", "method.copyCommand", "method.live", "sweep.run"}) {
      answers.push_back(f.window.findChild<QAbstractButton*>(button)->isEnabled());
    }
    for (const char* id : {"estimate.run", "estimate.copy_command", "estimate.live"}) {
      answers.push_back(commands.find(id)->isEnabled());
    }
    return answers;
  };
  QTRY_VERIFY(can_run() == std::vector<bool>(7, true));

  area.showPreview(QImage(8, 8, QImage::Format_RGB32), "another");

  QVERIFY(can_run() == std::vector<bool>(7, false));
  QVERIFY(f.window.findChild<QAbstractButton*>("method.run")->toolTip().contains("loading"));

  area.endPreview();

  QVERIFY(can_run() == std::vector<bool>(7, true));
}

void ResultsTest::rangeSetByHand_staysForOtherMethods() {
  const WindowFixture f;
  auto& panel = find<MethodPanel>(f.window);
  const ParameterSet range{{"range", IntervalOrAuto(Interval{-1, 2})}};
  panel.form()->setValues(range);

  panel.setCurrentMethod("epi_s");

  QVERIFY(*find_value(panel.request().values, "range") == range[0].second);
}

void ResultsTest::exportedResult_readsBack() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const EstimateEntry& shown = *f.window.bench().session.shown();
  const QString path = f.path("résult 1.h5");

  export_result(f.window.bench(), shown, path);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<MessageBar*>("messageBar")->text().contains(path),
                           kPatience);

  const Estimate read = io::read_result(path.toStdString(), {9, 9});
  QCOMPARE(read.method, std::string("epi_l"));
  QCOMPARE(read.source_hash, f.window.bench().session.light_field()->sample_hash());
  const auto& written = shown.estimate->field.disparity;
  QCOMPARE(read.field.disparity.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const bool is_valid =
        shown.estimate->field.valid.empty() || shown.estimate->field.valid.data()[i] != 0;
    if (is_valid) QCOMPARE(read.field.disparity.data()[i], written.data()[i]);
  }
}

void ResultsTest::exportedMap_marksInvalidPixels() {
  WindowFixture f;
  f.openSmall();
  const Scene& scene = *f.window.bench().session.scene();
  auto estimate = std::make_shared<Estimate>();
  estimate->method = "theirs";
  estimate->field.disparity = scene.truth->field.disparity.clone();
  estimate->field.disparity.view({4, 4}).at(2, 3) = std::numeric_limits<float>::quiet_NaN();
  const int id = f.window.bench().session.add_estimate(estimate, {-1, 1},
                                                       f.window.bench().session.generation());

  export_result(f.window.bench(), *f.window.bench().session.find_estimate(id), f.path("map.pfm"));
  QTRY_VERIFY_WITH_TIMEOUT(
      f.window.findChild<MessageBar*>("messageBar")->text().contains("map.pfm"), kPatience);

  const Image<float> map = io::read_pfm(f.path("map.pfm").toStdString());
  QVERIFY(std::isnan(map.at(2, 3)));
  QCOMPARE(map.at(9, 9), scene.truth->field.view({4, 4}).disparity.at(9, 9));
}

void ResultsTest::submittedResult_isAccepted() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const LightField& light_field = *f.window.bench().session.light_field();
  const std::string scene = light_field.info().name;

  submit_result(f.window.bench(), *f.window.bench().session.shown(), f.path("ours"));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<MessageBar*>("messageBar")->text().contains(".pfm"),
                           kPatience);

  const auto problems = io::submission_problems(
      f.path("ours").toStdString(), {{scene, light_field.height(), light_field.width()}});
  QVERIFY2(problems.empty(), problems.empty() ? "" : problems[0].c_str());
}

void ResultsTest::unknownSuffix_isNotWritten() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();

  export_result(f.window.bench(), *f.window.bench().session.shown(), f.path("result.jpg"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QVERIFY2(messages->text().contains(".pfm"), qPrintable(messages->text()));
  QCOMPARE(messages->severity(), Severity::Warning);
  QCOMPARE(f.window.bench().jobs.count(), 0);
}

void ResultsTest::chosenForm_namesTheFile() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  f.window.bench().commands.trigger("file.export");
  auto* dialog = f.window.findChild<QFileDialog*>();
  const QStringList forms = dialog->nameFilters();

  emit dialog->filterSelected(forms[1]);

  QVERIFY2(forms[1].contains("*.pfm"), qPrintable(forms[1]));
  QCOMPARE(QFileInfo(dialog->selectedFiles().value(0)).suffix(), QString("pfm"));
  QCOMPARE(dialog->defaultSuffix(), QString("pfm"));
}

void ResultsTest::openedResult_isListed() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  const QString path = f.path("result.h5");
  export_result(f.window.bench(), *f.window.bench().session.shown(), path);
  QTRY_VERIFY_WITH_TIMEOUT(f.window.findChild<MessageBar*>("messageBar")->text().contains(path),
                           kPatience);

  f.window.bench().results.open(path);

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kPatience);
  QCOMPARE(f.window.bench().session.estimates()[1].name, std::string("EPI_L 2"));
}

void ResultsTest::resultOfAnotherLightField_isRefused() {
  WindowFixture f;
  f.openSmall();
  io::write_pfm(f.path("other.pfm").toStdString(), Image<float>(50, 40));

  f.window.bench().results.open(f.path("other.pfm"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("40×50"), qPrintable(messages->text()),
                            kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
}

void ResultsTest::mapOfTheOtherSign_isOpenedWithAWarning_andNegatedWhenAsked() {
  WindowFixture f;
  f.openSmall();
  const Session& session = f.window.bench().session;
  const auto truth = session.scene()->truth->field.view(session.light_field()->center()).disparity;
  Image<float> map(truth.height, truth.width);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) map.at(y, x) = -truth.at(y, x);
  }
  io::write_pfm(f.path("negated.pfm").toStdString(), map.view());

  f.window.bench().results.open(f.path("negated.pfm"));

  QTRY_COMPARE_WITH_TIMEOUT(session.estimates().size(), 1U, kPatience);
  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  for (const char* words :
       {"negated.pfm: the map fits the ground truth far better with values negated",
        "MSE×100 0 instead of "}) {
    QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains(words), qPrintable(messages->text()),
                              kPatience);
  }
  QCOMPARE(messages->severity(), Severity::Warning);
  const int misread = session.shown()->id;

  messages->findChild<QPushButton*>("message.action")->click();

  QTRY_VERIFY_WITH_TIMEOUT(session.shown() && session.shown()->id != misread, kPatience);
  QCOMPARE(session.estimates().size(), 1U);
  QCOMPARE(session.shown()->name, std::string("negated"));
  const ViewIndex center = session.light_field()->center();
  const auto applied = session.shown()->estimate->field.view(center).disparity;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) QCOMPARE(applied.at(y, x), truth.at(y, x));
  }
}

void ResultsTest::resultOfOtherSamples_isOpenedWithAWarning() {
  WindowFixture f;
  f.openSmall();
  f.runAndWait();
  Estimate foreign;
  foreign.field.disparity = f.window.bench().session.shown()->estimate->field.disparity.clone();
  foreign.method = "epi_l";
  foreign.source_hash = f.window.bench().session.light_field()->sample_hash() + 1;
  io::write_result(f.path("foreign.h5").toStdString(), foreign, Progress());

  f.window.bench().results.open(f.path("foreign.h5"));

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.estimates().size(), 2U, kPatience);
  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("different samples"),
                            qPrintable(messages->text()), kPatience);
  QCOMPARE(messages->severity(), Severity::Warning);
  QCOMPARE(f.window.bench().session.estimates()[1].foreign_file.filename().string(),
           std::string("foreign.h5"));
  f.trigger("tab.compare");
  const auto* table = f.window.findChild<QTableWidget*>("metrics.table");
  const auto* a = f.window.findChild<QComboBox*>("compare.a");
  QTRY_COMPARE_WITH_TIMEOUT(table->rowCount(), 2, kPatience);
  const QString name = QString::fromStdString(f.window.bench().session.estimates()[1].name);
  QTRY_COMPARE(table->item(1, 0)->text(), "⚠ " + name);
  QCOMPARE(a->currentText(), "⚠ " + name);
  for (const QString& tip : {table->item(1, 0)->toolTip(), a->toolTip()}) {
    QVERIFY2(tip.contains("Belongs to another light field"), qPrintable(tip));
  }

  f.openSmall("slant");

  QVERIFY(!messages->isVisible());
}

// Its true depth would be taken for disparity.
void ResultsTest::lightField_isNoResult() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().results.open(f.path("edge/lf.h5"));

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("no estimated disparity"),
                            qPrintable(messages->text()), kPatience);
  QVERIFY(f.window.bench().session.estimates().empty());
}

void ResultsTest::copiedCommand_opensTheSameFile() {
  WindowFixture f;
  f.openSmall();

  f.window.bench().commands.find("estimate.copy_command")->trigger();

  const QString text = QGuiApplication::clipboard()->text();
  QVERIFY2(text.startsWith("episcope-cli estimate epi_l "), qPrintable(text));
  QVERIFY2(text.contains(f.path("edge/lf.h5")), qPrintable(text));
}

// At 5.92 px, where views of 36 px are searched for ±6.
void ResultsTest::foundRangeThatEndsAtItsLimit_isTold() {
  WindowFixture f;
  scenes::RenderOptions options;
  options.height = options.width = 36;
  options.disparity_scale = 16;
  f.openScene("fronto", options);

  find<EstimateController>(f.window).run(
      {"st_ch_l", {{"range", IntervalOrAuto::found()}}, {.views = ViewSelection::Center}});

  const auto told = [&f] { return f.window.findChild<MessageBar*>("messageBar")->text(); };
  QTRY_VERIFY2_WITH_TIMEOUT(told().contains("may reach farther"), qPrintable(told()),
                            kScenePatience);
}

void ResultsTest::form_namesTheRangeThatARunFound() {
  WindowFixture f;
  f.openSmall();
  const auto* source = f.window.findChild<QComboBox*>("range.source");
  QCOMPARE(source->currentText(), QString("Found in the images"));

  f.runAndWait();

  const Interval range = f.window.bench().session.shown()->estimate->range;
  const QString found =
      "Found: " + number_text(range.min, 2) + " … " + number_text(range.max, 2) + " px";
  QTRY_COMPARE_WITH_TIMEOUT(source->currentText(), found, kPatience);
}

void ResultsTest::cornerThatAViewDoesNotShow_hasNoDisparity() {
  WindowFixture f;
  f.window.bench().opener.open(write_vignetted(f));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().document.document(), kScenePatience);
  f.runAndWait();
  Session& session = f.window.bench().session;
  const DisparityField& map = session.shown()->estimate->field;
  constexpr int near = kCorner / 4, far = 2 * kCorner;
  QVERIFY(!map.view(kOuterView).is_valid(near, near));
  QVERIFY(map.view(kOuterView).is_valid(far, far));
  QVERIFY(map.view(session.light_field()->center()).is_valid(near, near));

  session.set_view(kOuterView);
  session.set_cross_hair({near, near});

  const auto text = [&f] { return find<ValueBar>(f.window).text(); };
  QTRY_VERIFY2(text().contains("EPI_L invalid"), qPrintable(text()));
}

void ResultsTest::offerToShowAResult_endsOnceItIsSeen() {
  WindowFixture f;
  f.openSmall();
  f.window.bench().overlay.setQuantity(render::Quantity::Truth);
  QCoreApplication::processEvents();
  const auto* bar = f.window.findChild<MessageBar*>("messageBar");
  find<EstimateController>(f.window).run({"st_ch_l", {}, {.views = ViewSelection::Center}});
  QTRY_VERIFY_WITH_TIMEOUT(bar->isVisible() && bar->text().startsWith("New result: ST_CH_L"),
                           kScenePatience);

  f.window.bench().overlay.setQuantity(render::Quantity::Disparity);  // as the key M does

  QTRY_VERIFY_WITH_TIMEOUT(!bar->isVisible(), kPatience);
}

}  // namespace episcope::in_results_test

EPISCOPE_WINDOW_TEST(results_test, ResultsTest)
#include "results_test.moc"
