// SPDX-License-Identifier: BSD-3-Clause
// The live estimate, driven in the window that ships.
#include "app/gui/estimate/live_controller.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/metric_table.h"

#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>

#include <algorithm>

namespace episcope::in_live_window_test {

namespace {

using render::Quantity;

class Trying : public WindowFixture {
 public:
  Trying() { openSmall(); }

  Session& session() { return window.bench().session; }
  Overlay& overlay() { return window.bench().overlay; }
  [[nodiscard]] const LiveEstimator& live() const {
    return find<LiveController>(window).estimator();
  }
  [[nodiscard]] MethodPanel& method() const { return find<MethodPanel>(window); }
  [[nodiscard]] QPushButton& button() const {
    return *window.findChild<QPushButton*>("method.live");
  }
  [[nodiscard]] QString status() const {
    return window.findChild<ElidedLabel*>("method.liveStatus")->fullText();
  }
  void toggle() { click("method.live"); }
  void set(const std::string& key, double value) {
    RunRequest request = method().request();
    for (auto& [name, chosen] : request.values) {
      if (name == key) chosen = value;
    }
    method().setRequest(request);
  }

  /// Whether what is looked at is the full map of what was asked for last.
  [[nodiscard]] bool isThere() {
    const EstimateEntry* tried = session().live();
    return tried && live().stage() == LiveStage::Idle && live().map() && !live().map()->is_coarse &&
           tried->estimate == live().map()->estimate;
  }
  void wait() { QTRY_VERIFY_WITH_TIMEOUT(isThere(), kScenePatience); }
  [[nodiscard]] double value(const std::string& key) {
    for (const auto& [name, value] : session().live()->estimate->parameters) {
      if (name == key) return std::get<double>(value);
    }
    return 0;
  }
};

}  // namespace

class LiveWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void toggle_showsAMapThatIsNotKept();
  void running_isAJob();
  void cancelledJob_turnsItOff();
  void off_givesBackWhatWasShown();
  void list_marksItAsAAndHasItsError();
  void parameter_changesTheMap();
  void manyChanges_endWithTheLast();
  void method_changesTheMap();
  void view_changesTheMap();
  void errorsAndMetrics_follow();
  void run_keepsAResultBesideIt();
  void wrongUse_isSaid();
  void otherScene_whileRunning_isFollowed();
  void closedScene_whileRunning_leavesNothing();
  void key_toggles();
};

void LiveWindowTest::toggle_showsAMapThatIsNotKept() {
  Trying f;
  QVERIFY(f.overlay().quantity() == Quantity::View);
  f.toggle();
  QVERIFY(f.button().isChecked());
  f.wait();

  QVERIFY(f.overlay().quantity() == Quantity::Disparity);
  QTRY_VERIFY_WITH_TIMEOUT(f.overlay().isUpToDate() && f.overlay().map(), kPatience);
  QVERIFY(!f.overlay().picture().isNull());
  QVERIFY2(f.status().contains("coarse") && f.status().contains("full"), qPrintable(f.status()));
  QCOMPARE(*f.live().full_seconds(), f.live().map()->estimate->seconds);  // as in the list
  for (const OpenScene* each : f.session().scenes()) QVERIFY(each->estimates.empty());
  QCOMPARE(f.window.bench().jobs.count(), 0);
}

void LiveWindowTest::running_isAJob() {
  Trying f;
  f.toggle();

  QCOMPARE(f.window.bench().jobs.count(), 1);
  QVERIFY(f.window.bench().jobs.newest(f.session().generation())->title.startsWith("Live EPI_L"));
  const auto* status = f.window.findChild<QLabel*>("valueBar.status");
  QTRY_VERIFY_WITH_TIMEOUT(status->text().contains("1 job"), kPatience);
  f.wait();
  QCOMPARE(f.window.bench().jobs.count(), 0);
}

void LiveWindowTest::cancelledJob_turnsItOff() {
  Trying f;
  f.method().setCurrentMethod("st_av_g");
  f.toggle();

  f.window.bench().job_cancel.cancelNewest();

  QVERIFY(!f.button().isChecked());
  QCOMPARE(f.window.bench().jobs.count(), 0);
}

void LiveWindowTest::list_marksItAsAAndHasItsError() {
  Trying f;
  f.runAndWait();
  const auto* tree = f.window.findChild<QTreeWidget*>("results.tree");
  QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), 1, kPatience);
  f.set("inner_scale", 1.4);

  f.toggle();
  f.wait();

  QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), 2, kPatience);
  const QTreeWidgetItem* live = tree->topLevelItem(1);
  QCOMPARE(live->text(1), QString("Live EPI_L"));
  QTRY_VERIFY_WITH_TIMEOUT(live->text(2).contains('.'), kPatience);
  QVERIFY(live->font(1).bold() && !tree->topLevelItem(0)->font(1).bold());
  QCOMPARE(live->toolTip(0), QString("A: this result is shown"));
  QVERIFY(!(live->flags() & Qt::ItemIsEditable));
  f.toggle();
  QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), 1, kPatience);
  QVERIFY(tree->topLevelItem(0)->font(1).bold());
}

void LiveWindowTest::off_givesBackWhatWasShown() {
  Trying f;
  f.toggle();
  f.wait();

  f.toggle();

  QVERIFY(!f.session().live());
  QVERIFY(!f.button().isChecked());
  QVERIFY(f.status().isEmpty());
  QTRY_VERIFY_WITH_TIMEOUT(f.overlay().picture().isNull(), kPatience);
  QVERIFY(f.overlay().quantity() == Quantity::View);
}

void LiveWindowTest::parameter_changesTheMap() {
  Trying f;
  f.toggle();
  f.wait();
  const EstimatePtr first = f.session().live()->estimate;

  f.set("inner_scale", 1.4);
  f.wait();

  QCOMPARE(f.value("inner_scale"), 1.4);
  const auto before = first->field.view(f.view()).disparity;
  const auto after = f.session().live()->estimate->field.view(f.view()).disparity;
  QVERIFY(!std::equal(before.data, before.data + before.size(), after.data));
  f.click("method.reset");
  f.wait();
  QVERIFY(f.value("inner_scale") < 1);
}

void LiveWindowTest::manyChanges_endWithTheLast() {
  Trying f;
  f.toggle();
  for (const double value : {0.7, 0.9, 1.1, 1.3}) f.set("inner_scale", value);
  f.wait();
  QCOMPARE(f.value("inner_scale"), 1.3);
}

void LiveWindowTest::method_changesTheMap() {
  Trying f;
  f.toggle();
  f.method().setCurrentMethod("st_ch_l");
  f.wait();
  QCOMPARE(f.session().live()->estimate->method, std::string("st_ch_l"));
  QVERIFY(f.session().live()->name.find("ST_CH_L") != std::string::npos);
}

void LiveWindowTest::view_changesTheMap() {
  Trying f;
  f.method().setCurrentMethod("st_ch_l");
  f.toggle();
  f.wait();

  f.session().set_view({2, 6});
  QTRY_VERIFY_WITH_TIMEOUT(f.isThere() && f.session().live()->estimate->contains({2, 6}),
                           kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(f.overlay().isUpToDate() && f.overlay().map(), kPatience);
}

void LiveWindowTest::errorsAndMetrics_follow() {
  Trying f;
  f.toggle();
  f.wait();
  f.overlay().setQuantity(Quantity::AbsoluteError);
  QTRY_VERIFY_WITH_TIMEOUT(f.overlay().isUpToDate() && f.overlay().map(), kPatience);
  const QuantityMapPtr first = f.overlay().map();
  const auto& table = find<MetricTable>(f.window);
  QTRY_VERIFY_WITH_TIMEOUT(table.toCsv().contains("Live EPI_L"), kPatience);

  f.set("inner_scale", 1.4);
  f.wait();

  QVERIFY(f.overlay().quantity() == Quantity::AbsoluteError);
  QTRY_VERIFY_WITH_TIMEOUT(f.overlay().isUpToDate() && f.overlay().map() != first, kPatience);
  QTRY_VERIFY_WITH_TIMEOUT(
      f.session().evaluation({f.session().live()->id, f.view(), Protocol::Vmv2013}) != nullptr,
      kPatience);
  f.toggle();
  QTRY_VERIFY_WITH_TIMEOUT(!table.toCsv().contains("Live"), kPatience);
}

void LiveWindowTest::run_keepsAResultBesideIt() {
  Trying f;
  f.toggle();
  f.wait();
  f.runAndWait();
  QCOMPARE(f.session().side_b(), f.session().shown());
  QCOMPARE(f.session().side_a(), f.session().live());

  f.toggle();

  QCOMPARE(f.session().estimates().size(), 1U);
  QCOMPARE(f.session().side_a(), f.session().shown());
}

void LiveWindowTest::wrongUse_isSaid() {
  scenes::RenderOptions options = WindowFixture::smallOptions();
  options.grid = {2, 2};
  Trying f;
  f.openScene("slant", options);
  f.method().setCurrentMethod("epi_two_layer");
  f.toggle();
  QTRY_VERIFY_WITH_TIMEOUT(f.live().stage() == LiveStage::Failed, kPatience);
  QVERIFY2(f.status().startsWith("Live: ") && f.status().size() > 10, qPrintable(f.status()));
  QVERIFY(!f.session().live());
  f.method().setCurrentMethod("epi_l");
  f.wait();
}

void LiveWindowTest::otherScene_whileRunning_isFollowed() {
  Trying f;
  f.method().setCurrentMethod("st_av_g");
  f.toggle();
  f.openSmall("slant");
  f.wait();
  QVERIFY(f.session().live()->estimate->source == f.session().light_field()->info().source);
}

void LiveWindowTest::closedScene_whileRunning_leavesNothing() {
  Trying f;
  f.method().setCurrentMethod("st_av_g");
  f.toggle();
  f.session().close();
  QTRY_VERIFY_WITH_TIMEOUT(f.live().stage() == LiveStage::Idle && !f.live().map(), kPatience);
  QVERIFY(!f.session().live());
  QVERIFY(f.button().isChecked());
}

void LiveWindowTest::key_toggles() {
  Trying f;
  f.key(Qt::Key_L, Qt::ControlModifier);
  QVERIFY(f.button().isChecked());
  f.key(Qt::Key_L, Qt::ControlModifier);
  QVERIFY(!f.button().isChecked());
}

}  // namespace episcope::in_live_window_test

EPISCOPE_WINDOW_TEST(live_window_test, LiveWindowTest)
#include "live_window_test.moc"
