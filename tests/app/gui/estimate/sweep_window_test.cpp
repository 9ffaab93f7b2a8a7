// SPDX-License-Identifier: BSD-3-Clause
// Sweeps, driven in the window that ships.
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/jobs.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/sweep_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>

#include <algorithm>
#include <cmath>

namespace episcope::in_sweep_window_test {

namespace {

class Sweeping : public WindowFixture {
 public:
  explicit Sweeping(const std::string& scene = "edge") {
    openSmall(scene);
    key(Qt::Key_F5, Qt::ControlModifier | Qt::ShiftModifier);
    QCoreApplication::processEvents();
  }

  [[nodiscard]] LinePlot& upper() const { return *window.findChild<LinePlot*>("sweep.upper"); }
  [[nodiscard]] LinePlot& lower() const { return *window.findChild<LinePlot*>("sweep.lower"); }
  [[nodiscard]] QString text(const char* label) const {
    return window.findChild<QLabel*>(label)->text();
  }
  [[nodiscard]] QPushButton& button(const char* name) const {
    return *window.findChild<QPushButton*>(name);
  }
  Session& session() { return window.bench().session; }

  /// As by hand: the parameter from its list, values typed.
  void vary(const char* row, const char* key, const char* values) {
    auto* combo = window.findChild<QComboBox*>(row);
    const int place = combo->findData(QString(key));
    QVERIFY2(place >= 0, key);
    combo->setCurrentIndex(place);
    emit combo->activated(place);
    auto* field = window.findChild<QLineEdit*>(QString(row) + ".values");
    field->selectAll();
    QTest::keyClicks(field, values);
  }

  void run() {
    click("sweep.run");
    QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience);
    QCoreApplication::processEvents();
  }

  void clickPoint(LinePlot& plot, PlotPlace place) {
    plot.grab();  // positions are those of the last picture
    QTest::mouseClick(&plot, Qt::LeftButton, {}, plot.positionOf(place).toPoint());
    QCoreApplication::processEvents();
  }
};

}  // namespace

class SweepWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void run_plotsEveryValue();
  void twoParameters_giveALineForEachValueOfTheSecond();
  void point_showsItsMap_andTheNextTakesItsPlace();
  void point_showsItsMap_inThePlaceOfWhatIsOfNoResult();
  void keptPoint_stays();
  void keys_chooseAPoint();
  void values_goBackToTheForm();
  void wrongValues_areSaidAndCannotBeRun();
  void cancelled_keepsThePointsThatAreThere();
  void withoutTruth_plotsChangeAndTime();
  void export_writesEveryPoint();
  void closedScene_takesItsSweepAway();
  void severalScenes_arePlottedWithTheirMean();
  void twoParametersOfSeveralScenes_arePlottedAsTheMean();
  void sweeps_areListed_andRemoved();
  void sweeps_comeBackWithTheProject();
  void sweep_isAskedForBeforeItIsLost();
  void sweepWithoutAPoint_isAskedForBeforeItIsLost();
  void shownPoint_isNotAskedForBesideItsSweep();
};

void SweepWindowTest::run_plotsEveryValue() {
  Sweeping f;
  QCOMPARE(f.window.bench().frame.shownTab(), QString("sweep"));
  f.vary("sweep.first", "inner_scale", "0.6, 0.9, 1.2");
  QVERIFY(f.text("sweep.plan").contains("4"));  // the present values, which are none of these

  f.run();

  const std::size_t results = f.session().estimates().size();
  QCOMPARE(f.upper().plot().series.size(), 1U);
  QCOMPARE(f.upper().plot().series[0].points.size(), 3U);
  QVERIFY(f.upper().plot().y.title.contains("MSE"));
  QVERIFY(f.lower().plot().y.title.contains("BadPix"));
  for (const QPointF& point : f.upper().plot().series[0].points) QVERIFY(point.y() > 0);
  QCOMPARE(f.session().estimates().size(), results);  // the list of results is as it was
}

void SweepWindowTest::twoParameters_giveALineForEachValueOfTheSecond() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6 0.9");
  f.vary("sweep.second", "outer_scale", "0.5, 1, 2");
  f.run();
  const auto& series = f.upper().plot().series;
  QCOMPARE(series.size(), 3U);
  QVERIFY(series[1].name.startsWith("Outer scale 1"));
  QCOMPARE(series[1].points.size(), 2U);
}

void SweepWindowTest::point_showsItsMap_andTheNextTakesItsPlace() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  const std::size_t before = f.session().estimates().size();

  f.clickPoint(f.upper(), {0, 1});
  QCOMPARE(f.session().estimates().size(), before + 1);
  QVERIFY(f.session().shown()->name.find("Inner scale 1.2") != std::string::npos);
  QVERIFY(f.text("sweep.chosen").contains("Inner scale 1.2 px"));
  QVERIFY(f.lower().mark() == (PlotPlace{0, 1}));

  f.clickPoint(f.lower(), {0, 0});
  QCOMPARE(f.session().estimates().size(), before + 1);
  QVERIFY(f.session().shown()->name.find("Inner scale 0.6") != std::string::npos);

  // What is shown is judged as what is plotted.
  const EvaluationKey key{f.session().shown()->id, judged_view(*f.session().scene()),
                          Protocol::Vmv2013};
  EvaluationPtr evaluation;
  QTRY_VERIFY_WITH_TIMEOUT((evaluation = f.session().evaluation(key)), kPatience);
  QCOMPARE(find_metric(evaluation->metrics, "mse_100").value(),
           f.upper().plot().series[0].points[0].y());
}

void SweepWindowTest::point_showsItsMap_inThePlaceOfWhatIsOfNoResult() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.trigger("overlay.truth");

  f.clickPoint(f.upper(), {0, 0});
  QCOMPARE(f.window.bench().overlay.quantity(), render::Quantity::Disparity);

  f.trigger("overlay.error");
  f.clickPoint(f.upper(), {0, 1});
  QCOMPARE(f.window.bench().overlay.quantity(), render::Quantity::SignedError);
}

void SweepWindowTest::keptPoint_stays() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  const std::size_t before = f.session().estimates().size();
  f.clickPoint(f.upper(), {0, 0});
  const int kept = f.session().shown()->id;

  f.click("sweep.keep");
  QVERIFY(!f.button("sweep.keep").isEnabled());
  f.clickPoint(f.upper(), {0, 1});

  QCOMPARE(f.session().estimates().size(), before + 2);
  QVERIFY(f.session().find_estimate(kept));
}

void SweepWindowTest::keys_chooseAPoint() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.upper().setFocus(Qt::TabFocusReason);
  QTest::keyClick(&f.upper(), Qt::Key_Right);
  QTest::keyClick(&f.upper(), Qt::Key_Return);
  QCoreApplication::processEvents();
  QVERIFY(f.session().shown()->name.find("Inner scale 1.2") != std::string::npos);
  QVERIFY((f.view() == ViewIndex{4, 4}));  // the arrow was not the viewer's
}

void SweepWindowTest::values_goBackToTheForm() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.clickPoint(f.upper(), {0, 1});
  f.click("sweep.use");
  const ParameterSet changed = find<MethodPanel>(f.window).form()->modifiedValues();
  QVERIFY(changed == (ParameterSet{{"inner_scale", 1.2}}));
}

void SweepWindowTest::wrongValues_areSaidAndCannotBeRun() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, x");
  QVERIFY(!f.button("sweep.run").isEnabled());
  QVERIFY(f.text("sweep.plan").contains("inner_scale"));
  f.vary("sweep.first", "inner_scale", "0.5:1.5:200");
  QVERIFY(!f.button("sweep.run").isEnabled());
  QVERIFY(f.text("sweep.plan").contains("200"));
  f.vary("sweep.first", "inner_scale", "0.5:1.5:3");
  QVERIFY(f.button("sweep.run").isEnabled());
}

void SweepWindowTest::cancelled_keepsThePointsThatAreThere() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.5:1.5:50");
  f.click("sweep.run");
  const auto count = [&] {
    const auto& series = f.upper().plot().series;
    return series.empty() ? std::size_t{0} : series[0].points.size();
  };
  QTRY_VERIFY_WITH_TIMEOUT(count() >= 2, kScenePatience);
  f.window.bench().job_cancel.setWorthAsking(0);  // as one that took long
  f.click("sweep.cancel");
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QVERIFY2(messages->text().startsWith("Sweep of"), qPrintable(messages->text()));
  f.click("sweep.cancel");
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
  QVERIFY(count() >= 2 && count() < 50);
  const QString title = f.window.findChild<QComboBox*>("sweep.list")->currentText();
  QVERIFY2(title.endsWith(QString("(%1 of 51 runs)").arg(count())) ||
               title.endsWith(QString("(%1 of 50 runs)").arg(count())),
           qPrintable(title));
  QVERIFY(f.button("sweep.run").isEnabled());
  f.clickPoint(f.upper(), {0, 1});
  QVERIFY(f.session().shown()->name.find("Inner scale") != std::string::npos);
}

void SweepWindowTest::withoutTruth_plotsChangeAndTime() {
  Sweeping f;
  const auto& scene = *f.session().scene();
  auto bare = std::make_shared<Scene>();
  bare->light_field = scene.light_field;
  bare->truth = std::make_shared<const GroundTruth>();
  f.session().open(bare, f.session().input());
  QCoreApplication::processEvents();
  const auto* measures = f.window.findChild<QComboBox*>("sweep.upper.measure");
  QVERIFY2(measures->itemText(0).contains("Change"), qPrintable(measures->itemText(0)));
  f.vary("sweep.first", "inner_scale", "0.8, 1.2");
  f.run();
  QVERIFY(f.upper().plot().y.title.contains("Change"));
  QVERIFY(f.lower().plot().y.title.contains("Time"));
  QVERIFY(f.upper().plot().series[0].points[1].y() > 0);
  QVERIFY(f.text("sweep.chosen").contains("No ground truth"));
}

void SweepWindowTest::export_writesEveryPoint() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.click("sweep.export");
  auto* dialog = f.window.findChild<QFileDialog*>("save_sweep");
  QVERIFY(dialog);
  const QString path = f.path("sweep.csv");
  emit dialog->fileSelected(path);
  dialog->close();
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), kPatience);
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QStringList lines = QString::fromUtf8(file.readAll()).trimmed().split('\n');
  QCOMPARE(lines.size(), 4);  // head, present values, two
  QVERIFY(lines[0].startsWith("scene,method,parameters,inner_scale,vmv2013.mse_100"));
  QVERIFY(lines[2].startsWith("edge,epi_l,,0.6,"));
}

void SweepWindowTest::closedScene_takesItsSweepAway() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.session().close();
  QCoreApplication::processEvents();
  QVERIFY(f.upper().plot().series.empty());
  QVERIFY(!f.button("sweep.run").isEnabled());
}

void SweepWindowTest::severalScenes_arePlottedWithTheirMean() {
  Sweeping f;
  QVERIFY(!f.window.findChild<QCheckBox*>("sweep.everywhere")->isVisible());
  const auto edge = f.session().generation();
  f.openSmall("slant");
  f.window.bench().scenes.setBudget(1);  // the other one is on disk only
  QTRY_VERIFY(!f.session().find_scene(edge)->scene);
  f.vary("sweep.first", "inner_scale", "0.6, 0.9");
  f.click("sweep.everywhere");
  QVERIFY(f.text("sweep.plan").contains("2 center views"));

  f.run();

  const auto& series = f.upper().plot().series;
  QCOMPARE(series.size(), 3U);
  QCOMPARE(series[0].name, QString("edge"));
  QCOMPARE(series[1].name, QString("slant"));
  QCOMPARE(series[2].name, QString("Mean"));
  for (int i = 0; i < 2; ++i) {
    QCOMPARE(series[2].points[i].y(), (series[0].points[i].y() + series[1].points[i].y()) / 2);
  }
  QVERIFY(f.lower().plot().y.title.contains("BadPix"));
  QCOMPARE(f.lower().plot().series.size(), 3U);
  f.clickPoint(f.upper(), {2, 1});  // of the mean: the light field that is shown
  QVERIFY(f.session().shown()->name.find("Inner scale 0.9") != std::string::npos);
  QCOMPARE(f.session().light_field()->info().name, std::string("slant"));
  f.clickPoint(f.upper(), {0, 1});
  QTRY_COMPARE_WITH_TIMEOUT(f.session().generation(), edge, kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(f.session().shown(), kScenePatience);
  QVERIFY(f.session().shown()->name.find("Inner scale 0.9") != std::string::npos);

  auto* of = f.window.findChild<QComboBox*>("sweep.scene");
  of->setCurrentIndex(2);
  emit of->activated(2);
  QCOMPARE(f.upper().plot().series.size(), 1U);
}

void SweepWindowTest::twoParametersOfSeveralScenes_arePlottedAsTheMean() {
  Sweeping f;
  f.openSmall("slant");
  f.vary("sweep.first", "inner_scale", "0.6, 0.9");
  f.vary("sweep.second", "outer_scale", "1, 2");
  f.click("sweep.everywhere");
  f.run();
  const auto& series = f.upper().plot().series;
  QCOMPARE(series.size(), 2U);
  QVERIFY(series[0].name.contains("Outer scale 1"));
  QVERIFY(series[0].points[1].y() > 0);
}

void SweepWindowTest::sweeps_areListed_andRemoved() {
  Sweeping f;
  for (const char* values : {"0.6, 0.9", "0.7, 0.8, 1"}) {
    f.vary("sweep.first", "inner_scale", values);
    f.run();
  }
  auto* list = f.window.findChild<QComboBox*>("sweep.list");
  QCOMPARE(list->count(), 2);
  QCOMPARE(f.upper().plot().series[0].points.size(), 3U);

  list->setCurrentIndex(0);
  emit list->activated(0);
  QCOMPARE(f.upper().plot().series[0].points.size(), 2U);
  f.click("sweep.remove");
  QCoreApplication::processEvents();
  QCOMPARE(list->count(), 1);
  QCOMPARE(f.upper().plot().series[0].points.size(), 3U);
}

void SweepWindowTest::sweeps_comeBackWithTheProject() {
  Sweeping f;
  f.openSmall("slant");
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.click("sweep.everywhere");
  f.run();
  const Plot before = f.upper().plot();
  const QString path = f.path("work.episcope");
  bool is_saved = false;
  find<ProjectController>(f.window).saveTo(path, [&is_saved] { is_saved = true; });
  QTRY_VERIFY_WITH_TIMEOUT(is_saved, kScenePatience);

  Sweeping other;
  other.window.bench().opener.open(path);
  QTRY_COMPARE_WITH_TIMEOUT(other.window.bench().scenes.sweeps().all().size(), 1U, kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(other.session().scenes().size() == 2 && other.session().scene(),
                           kScenePatience);
  QCoreApplication::processEvents();
  const auto& series = other.upper().plot().series;
  QCOMPARE(series.size(), before.series.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    QCOMPARE(series[i].name, before.series[i].name);
    QVERIFY(series[i].points == before.series[i].points);
  }
  // Maps are computed again when they are looked at.
  other.clickPoint(other.upper(), {1, 0});
  QTRY_VERIFY_WITH_TIMEOUT(other.session().shown(), kScenePatience);
  QVERIFY(other.session().shown()->name.find("Inner scale 0.6") != std::string::npos);
  const EvaluationKey key{other.session().shown()->id, judged_view(*other.session().scene()),
                          Protocol::Vmv2013};
  EvaluationPtr evaluation;
  QTRY_VERIFY_WITH_TIMEOUT((evaluation = other.session().evaluation(key)), kPatience);
  QCOMPARE(find_metric(evaluation->metrics, "mse_100").value(), series[1].points[0].y());
}

void SweepWindowTest::sweep_isAskedForBeforeItIsLost() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.window.close();
  auto* box = f.window.findChild<QMessageBox*>("unsaved_results");
  QVERIFY(box);
  QVERIFY2(box->text().contains("sweep of epi_l"), qPrintable(box->text()));
  QVERIFY(f.window.isVisible());
  box->button(QMessageBox::Discard)->click();
  QTRY_VERIFY(!f.window.isVisible());
}

void SweepWindowTest::sweepWithoutAPoint_isAskedForBeforeItIsLost() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.click("sweep.run");
  f.click("sweep.cancel");
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);

  f.window.close();

  auto* box = f.window.findChild<QMessageBox*>("unsaved_results");
  QVERIFY(box);
  QVERIFY2(box->text().contains("sweep of epi_l"), qPrintable(box->text()));
  box->button(QMessageBox::Discard)->click();
}

void SweepWindowTest::shownPoint_isNotAskedForBesideItsSweep() {
  Sweeping f;
  f.vary("sweep.first", "inner_scale", "0.6, 1.2");
  f.run();
  f.clickPoint(f.upper(), {0, 1});

  f.window.close();

  auto* box = f.window.findChild<QMessageBox*>("unsaved_results");
  QVERIFY(box);
  QCOMPARE(box->text(), QString("Not saved: sweep of epi_l."));
  box->button(QMessageBox::Cancel)->click();
  QTRY_VERIFY(!f.window.findChild<QMessageBox*>("unsaved_results"));

  f.click("sweep.keep");
  f.window.close();

  box = f.window.findChild<QMessageBox*>("unsaved_results");
  QVERIFY(box);
  QVERIFY2(box->text().contains("Inner scale 1.2"), qPrintable(box->text()));
  box->button(QMessageBox::Discard)->click();
}

}  // namespace episcope::in_sweep_window_test

EPISCOPE_WINDOW_TEST(sweep_window_test, SweepWindowTest)
#include "sweep_window_test.moc"
