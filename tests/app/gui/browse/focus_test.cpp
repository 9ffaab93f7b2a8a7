// SPDX-License-Identifier: BSD-3-Clause

#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/overlay_bar.h"

#include <QAction>
#include <QClipboard>
#include <QTimer>
#include <QToolButton>

#include <cmath>

namespace episcope::in_focus_test {

namespace {

constexpr double kFocus = 0.5;
constexpr ViewIndex kView = {3, 5};
constexpr PixelIndex kPixel = {20, 33};

// A scene with a result, looked at somewhere, in focus at a plane.
class Focused : public WindowFixture {
 public:
  Focused() {
    openSmall();
    runAndWait();
    session().set_view(kView);
    session().set_cross_hair(kPixel);
    session().set_focus(kFocus);
  }

  Session& session() { return window.bench().session; }
  double baked() { return session().scene()->convention.focus_px; }
  double truth() { return session().scene()->truth->field.view({4, 4}).disparity.at(20, 33); }
  double found() {
    return session().estimates().front().estimate->field.view({4, 4}).disparity.at(20, 33);
  }
  QAction* action(const char* id) { return window.bench().commands.find(id); }
  void waitFor(double baked_px) {
    QTRY_COMPARE_WITH_TIMEOUT(baked(), baked_px, kPatience);
    QTRY_COMPARE_WITH_TIMEOUT(session().estimates().size(), 1U, kPatience);
  }
  void clickApply() {
    auto* button = window.findChild<QToolButton*>("button.view.focus_apply");
    QTRY_VERIFY_WITH_TIMEOUT(button->isEnabled(), kPatience);
    QTest::mouseClick(button, Qt::LeftButton);
  }
};

}  // namespace

class FocusTest : public QObject {
  Q_OBJECT

 private slots:
  void withoutFocus_nothingCanBeApplied();
  void appliedFocus_movesTruthAndResults();
  void appliedFocus_keepsThePlace();
  void appliedFocus_keepsNames();
  void appliedFocus_keepsResults_whateverIsOpened();
  void appliedFocus_keepsWhatWasDoneOnTheScene();
  void appliedFocus_keepsPairs();
  void appliedFocus_keepsTheComparison();
  void appliedFocus_keepsTheDifference();
  void undo_bringsTheFileBack();
  void whileAMethodRuns_itIsRefused();
  void whatIsPainted_isNotLost();
  void whatIsPaintedAtAPlane_isSavedWhereItBelongs();
};

void FocusTest::withoutFocus_nothingCanBeApplied() {
  WindowFixture f;
  f.openSmall();

  QVERIFY(!f.window.bench().commands.find("view.focus_apply")->isEnabled());
  QVERIFY(!f.window.bench().commands.find("view.focus_undo")->isEnabled());
}

void FocusTest::appliedFocus_movesTruthAndResults() {
  Focused f;
  const double truth = f.truth();
  const double found = f.found();

  f.clickApply();
  f.waitFor(kFocus);

  QVERIFY(std::abs(f.truth() - (truth - kFocus)) < 1e-6);
  QVERIFY(std::abs(f.found() - (found - kFocus)) < 1e-6);
  QCOMPARE(f.session().shown()->estimate->source_hash, f.session().light_field()->sample_hash());
  // A run finds the same anew.
  f.runAndWait();
  const auto map = f.session().shown()->estimate->field.view({4, 4});
  QVERIFY(std::abs(map.disparity.at(20, 33) - (found - kFocus)) < 0.05);
  f.action("estimate.copy_command")->trigger();
  QVERIFY2(QGuiApplication::clipboard()->text().endsWith(" --focus=0.5"),
           qPrintable(QGuiApplication::clipboard()->text()));
}

void FocusTest::appliedFocus_keepsThePlace() {
  Focused f;

  f.clickApply();
  f.waitFor(kFocus);

  QVERIFY(f.session().view() == kView);
  QVERIFY(f.session().cross_hair() == kPixel);
  QCOMPARE(f.session().focus_px(), 0.0);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().viewer_area.overlayBar()->focus(), 0.0, kPatience);
  QTRY_VERIFY_WITH_TIMEOUT(!f.action("view.focus_apply")->isEnabled(), kPatience);
}

void FocusTest::appliedFocus_keepsNames() {
  Focused f;
  f.session().rename_estimate(f.session().estimates().front().id, "the first");

  f.clickApply();
  f.waitFor(kFocus);

  QCOMPARE(f.session().estimates().front().name, std::string("the first"));
}

// While they are moved: to cancel, or to go to another light field, loses nothing.
void FocusTest::appliedFocus_keepsResults_whateverIsOpened() {
  Focused f;
  f.session().rename_estimate(f.session().estimates().front().id, "mine");
  f.session().on_changed([&f, done = false](Parts parts) mutable {
    if (done || !parts.has(Part::Scene) || !f.session().scene() || f.baked() != kFocus) return;
    done = true;
    QTimer::singleShot(0, &f.window, [&f] {
      f.window.bench().jobs.cancelLane(Lane::Load);
      f.session().add(f.session().scene(), "another");
    });
  });

  f.clickApply();

  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes().size(), 2U, kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.session().scenes()[0]->estimates.size(), 1U, kPatience);
  QCOMPARE(f.session().scenes()[0]->estimates.front().name, std::string("mine"));
}

void FocusTest::appliedFocus_keepsWhatWasDoneOnTheScene() {
  Focused f;
  f.session().set_note(f.session().estimates().front().id, "remember this");
  f.session().set_tone({.exposure = 1.5});
  f.session().set_measurements({{{.name = "edge", .disparity_px = 0.8}}, 0});
  f.session().set_judged(f.session().generation(),
                         {.pixels = JudgedPixels::Rectangle, .rectangle = {10, 10, 40, 40}});
  f.trigger("overlay.truth");

  f.clickApply();
  f.waitFor(kFocus);

  QCOMPARE(f.session().estimates().front().note, std::string("remember this"));
  QCOMPARE(f.session().place().tone, (render::Tone{.exposure = 1.5}));
  QCOMPARE(f.session().place().measured.list.size(), 1U);
  QVERIFY(std::abs(f.session().place().measured.list[0].disparity_px - (0.8 - kFocus)) < 1e-9);
  QCOMPARE(f.session().place().judged.pixels, JudgedPixels::Rectangle);
  QTRY_COMPARE(f.window.bench().overlay.quantity(), render::Quantity::Truth);
}

void FocusTest::appliedFocus_keepsPairs() {
  Focused f;
  CaptureWork work;
  const capture::PointPair corner{.name = "corner", .x_px = 20, .y_px = 30, .point = {}};
  work.objects.push_back({.name = "box", .pairs = {corner}});
  f.session().set_capture(work);
  f.trigger("tab.capture");

  f.clickApply();
  f.waitFor(kFocus);

  QTRY_COMPARE(f.session().place().capture.objects.size(), 1U);
  QCOMPARE(f.session().place().capture.objects[0].pairs.size(), 1U);
}

void FocusTest::appliedFocus_keepsTheComparison() {
  Focused f;
  f.trigger("compare.wipe");
  emit f.canvas()->wipeMoved(0.25);

  f.clickApply();
  f.waitFor(kFocus);

  QTRY_COMPARE(f.session().place().comparison.mode, CompareMode::Wipe);
  QCOMPARE(f.session().place().comparison.wipe_position, 0.25);
  QTRY_VERIFY(f.action("compare.wipe")->isChecked());
}

void FocusTest::appliedFocus_keepsTheDifference() {
  Focused f;
  f.runAndWait();
  f.trigger("compare.difference");
  QVERIFY(f.window.bench().overlay.showsDifference());

  f.clickApply();
  QTRY_COMPARE_WITH_TIMEOUT(f.baked(), kFocus, kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.session().estimates().size(), 2U, kPatience);

  QTRY_VERIFY(f.window.bench().overlay.showsDifference());
}

void FocusTest::undo_bringsTheFileBack() {
  Focused f;
  const auto hash = f.session().light_field()->sample_hash();
  f.clickApply();
  f.waitFor(kFocus);
  QVERIFY(f.session().light_field()->sample_hash() != hash);
  // Once more: planes add up.
  f.session().set_focus(0.25);
  f.clickApply();
  f.waitFor(0.75);

  QTRY_VERIFY_WITH_TIMEOUT(f.action("view.focus_undo")->isEnabled(), kPatience);
  f.action("view.focus_undo")->trigger();
  f.waitFor(0);

  QCOMPARE(f.session().light_field()->sample_hash(), hash);
  QVERIFY(!f.action("view.focus_undo")->isEnabled());
}

void FocusTest::whileAMethodRuns_itIsRefused() {
  Focused f;
  f.window.bench().jobs.start<int>(
      Lane::Estimate, "endless",
      [](const Progress& progress) -> int {
        while (true) progress.check();
      },
      [](int) {});

  f.clickApply();

  QTRY_VERIFY2_WITH_TIMEOUT(
      f.window.findChild<MessageBar*>("messageBar")->text().contains("running"),
      qPrintable(f.window.findChild<MessageBar*>("messageBar")->text()), kPatience);
  QCOMPARE(f.baked(), 0.0);
  QCOMPARE(f.window.bench().jobs.count(), 1);
  f.window.bench().jobs.cancelLane(Lane::Estimate);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
}

void FocusTest::whatIsPainted_isNotLost() {
  Focused f;
  f.window.bench().document.edit([](AnnotationDocument& document) { document.add_label(); });
  QVERIFY(f.window.bench().document.hasUnsavedChanges());

  f.clickApply();

  const MessageBar* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("unsaved scribbles"),
                            qPrintable(messages->text()), kPatience);
  QCOMPARE(f.baked(), 0.0);
  QVERIFY(f.window.bench().document.hasUnsavedChanges());
}

void FocusTest::whatIsPaintedAtAPlane_isSavedWhereItBelongs() {
  Focused f;
  f.clickApply();
  f.waitFor(kFocus);
  constexpr ViewIndex corner{0, 0};  // four views from the center: moved by 2 px
  f.session().set_view(corner);
  f.trigger("annotate.mode");
  f.drag({40, 20}, {40, 60});
  QCOMPARE(f.document().scribbles().label_at(corner, {40, 20}), 1);

  f.key(Qt::Key_S, Qt::ControlModifier);
  QTRY_VERIFY_WITH_TIMEOUT(!f.window.isWindowModified(), kPatience);
  const ScribbleLayer painted = f.document().scribbles();
  f.trigger("view.focus_undo");
  f.waitFor(0);

  int differing = 0;
  for (int y = 0; y < 94; ++y) {
    for (int x = 0; x < 94; ++x) {
      differing += f.document().scribbles().label_at(corner, {y + 2, x + 2}) !=
                   painted.label_at(corner, {y, x});
    }
  }
  QCOMPARE(differing, 0);
  QVERIFY(!f.document().scribbles().painted_views().empty());
}

}  // namespace episcope::in_focus_test

EPISCOPE_WINDOW_TEST(focus_test, FocusTest)
#include "focus_test.moc"
