// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/label_exchange.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "engine/io/formats/write_scene.h"
#include "tests/app/gui/annotating.h"
#include "tests/app/gui/held_lane.h"
#include "tests/window_test_main.h"
#include "widgets/panels/segment_panel.h"
#include "widgets/panels/value_bar.h"

#include <QAbstractButton>
#include <QDir>
#include <QInputDialog>
#include <QMessageBox>

#include <variant>

// Labels of all views, which take long: they stay, are corrected, kept and asked for.

namespace episcope::in_all_views_test {

namespace {

bool is_equal(const Labeling& a, const Labeling& b, ViewIndex view) {
  const auto left = a.labels.view(view), right = b.labels.view(view);
  return std::equal(left.data, left.data + left.size(), right.data);
}

class AllViews : public Annotating {
 public:
  static constexpr int kCorner = 12;

  AllViews() : Annotating("objects") {}

  void segmentAll() {
    trigger("segment.all");
    QTRY_VERIFY_WITH_TIMEOUT(window.bench().jobs.count() == 0 && all() != nullptr, kScenePatience);
  }
  /// Labels of all views; null if there are none.
  LabelingPtr all() {
    const LabelingPtr labeling = segment().labeler().widest(view());
    return labeling && labeling->labels.grid().count() > 1 ? labeling : nullptr;
  }
  LabelingPtr labels(ViewIndex view) { return segment().labeler().labeling(view); }
  Session& session() { return window.bench().session; }
  SegmentPanel& panel() { return *window.findChild<SegmentPanel*>(); }
  QMessageBox* question() {
    auto* box = window.findChild<QMessageBox*>("unsaved_results");
    return box && box->isVisible() ? box : nullptr;
  }

  /// The light field and its strokes, but no truth.
  QString writeWithoutTruth() {
    Scene scene = *session().scene();
    scene.truth = std::make_shared<GroundTruth>();
    QDir().mkpath(path("plain"));
    io::write_archive(path("plain/lf.h5").toStdString(), scene, Progress(1));
    return path("plain/lf.h5");
  }
  /// Opens a file in place of what is open.
  void open(const QString& file) {
    const auto generation = session().generation();
    window.bench().opener.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(session().generation() > generation && session().scene(),
                             kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(window.bench().document.document(), kScenePatience);
  }

  /// The light field in which the corners of all views hold nothing.
  QString writeWithDarkCorners() {
    Scene scene = *session().scene();
    const LightField& whole = *scene.light_field;
    ViewStack<std::uint8_t> valid(whole.grid(), whole.height(), whole.width(), 1);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    for (int i = 0; i < whole.grid().count(); ++i) {
      for (int y = 0; y < kCorner; ++y)
        std::fill_n(valid.view(valid.view_at(i)).row(y), kCorner, 0);
    }
    scene.light_field = std::visit(
        [&](const auto& samples) {
          return std::make_shared<const LightField>(samples.clone(), whole.info(),
                                                    std::move(valid));
        },
        whole.samples());
    QDir().mkpath(path("dark"));
    io::write_archive(path("dark/lf.h5").toStdString(), scene, Progress(1));
    return path("dark/lf.h5");
  }
};

}  // namespace

class AllViewsTest : public QObject {
  Q_OBJECT

 private slots:
  void stroke_correctsAllViews_andIsUndoneAndRedone();
  void stroke_leavesTheOtherViews_andUndoBringsAllBack();
  void allViewsOfAFreshFile_waitForTheDisparity();
  void cancelledDisparity_endsTheWish();
  void quit_asksForLabelsOfAllViews();
  void quit_asksWhileAllViewsAreSegmented();
  void exportedLabels_areNotAskedFor();
  void labelsOfAProject_areThereAgain();
  void pixelsWithoutContent_haveNoLabel();
  void otherNumbersAndMerges_reachTheLabelsShown();
  void disparityOfLabels_alsoCarriesStrokes();
};

// As the menu asks for them.
void AllViewsTest::otherNumbersAndMerges_reachTheLabelsShown() {
  AllViews f;
  f.segmentAll();
  const LabelingPtr before = f.all();
  const auto count = [&](int id) {
    const auto labels = f.labels({0, 0})->labels.view({0, 0});
    return std::count(labels.data, labels.data + labels.size(), id);
  };
  const auto first = count(1), second = count(2);
  QVERIFY(first > 0 && second > 0);
  f.window.bench().labels.choose(1);

  f.trigger("annotate.renumber_label");
  auto* number = f.window.findChild<QInputDialog*>("renumber_label");
  number->setIntValue(40);
  number->accept();
  QCOMPARE(count(40), first);
  QVERIFY(f.segment().isSegmentationUpToDate());
  QVERIFY(f.session().labels().labeling == f.all());
  f.key(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(f.all() == before);

  f.window.bench().labels.choose(1);
  f.trigger("annotate.merge_label");
  auto* merge = f.window.findChild<QInputDialog*>("merge_labels");
  QVERIFY(merge->comboBoxItems().front().startsWith("2"));
  merge->accept();
  QCOMPARE(count(2), first + second);
  QCOMPARE(count(1), 0);
  QVERIFY(f.segment().isSegmentationUpToDate());
}

// A stroke of a new label over a thing, far from what the others say.
void AllViewsTest::stroke_correctsAllViews_andIsUndoneAndRedone() {
  AllViews f;
  f.segmentAll();
  const LabelingPtr before = f.all();
  QVERIFY(f.panel().keepsAllViews());
  f.trigger("annotate.add_label");
  const int id = f.window.bench().labels.current();

  f.drag({5, 5}, {5, 60});
  QVERIFY(f.segment().labeler().is_running());
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented() && f.segment().isSegmentationUpToDate(), kScenePatience);

  const LabelingPtr corrected = f.all();
  QVERIFY(corrected != before);
  QVERIFY(!corrected->probabilities.views.empty());
  for (const ViewIndex view : {AllViews::kCenter, ViewIndex{0, 0}, ViewIndex{8, 5}}) {
    const auto labels = corrected->labels.view(view);
    QVERIFY(std::count(labels.data, labels.data + labels.size(), id) > 60);
    const auto former = before->labels.view(view);
    std::int64_t same = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) same += labels.data[i] == former.data[i];
    QVERIFY2(same > static_cast<std::int64_t>(labels.size()) * 7 / 10,
             qPrintable(QString::number(same)));
  }
  QVERIFY(f.session().labels().labeling == corrected);
  // The cursor, which has not moved since, is over the new labels.
  const QString values = find<ValueBar>(f.window).text();
  QVERIFY2(values.contains(QString("segment label %1").arg(id)), qPrintable(values));

  f.key(Qt::Key_Z, Qt::ControlModifier);
  QTRY_COMPARE(f.all(), before);
  QVERIFY(f.segment().isSegmentationUpToDate());
  QVERIFY(f.session().labels().labeling == before);
  f.trigger("annotate.redo");
  QTRY_COMPARE(f.all(), corrected);
  QVERIFY(f.segment().isSegmentationUpToDate());
}

void AllViewsTest::stroke_leavesTheOtherViews_andUndoBringsAllBack() {
  AllViews f;
  f.segmentAll();
  const LabelingPtr before = f.all();
  f.panel().setKeepsAllViews(false);
  f.trigger("segment.live");

  f.drag({5, 5}, {5, 60});
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kScenePatience);

  QVERIFY(f.labels(AllViews::kCenter) != before);
  QVERIFY2(f.panel().note().contains("Other views: before the last stroke"),
           qPrintable(f.panel().note()));
  QCOMPARE(f.labels({0, 0}), before);
  f.session().set_view({0, 0});
  QTRY_COMPARE(f.panel().state(), QString("before the last stroke"));
  QVERIFY(!f.segment().labeler().is_running());
  QCOMPARE(f.labels({0, 0}), before);
  const auto written = f.segment().segmentation();
  QCOMPARE(written->labeling->labels.grid().count(), 81);
  QVERIFY(is_equal(*written->labeling, *before, {0, 0}));
  QVERIFY(is_equal(*written->labeling, *f.labels(AllViews::kCenter), AllViews::kCenter));
  QVERIFY(!f.segment().isSegmentationUpToDate());

  f.key(Qt::Key_Z, Qt::ControlModifier);
  QTRY_COMPARE(f.labels(AllViews::kCenter), before);
  QVERIFY(f.segment().isSegmentationUpToDate());
  QVERIFY(f.segment().labeler().is_up_to_date(AllViews::kCenter));
}

void AllViewsTest::allViewsOfAFreshFile_waitForTheDisparity() {
  AllViews f;

  f.trigger("segment.all");

  QVERIFY(!f.segment().isSegmentingAll());
  QVERIFY2(f.panel().state().startsWith("waiting for the disparity"),
           qPrintable(f.panel().state()));
  QTRY_VERIFY_WITH_TIMEOUT(f.segment().isSegmentingAll(), kScenePatience);
  QTRY_VERIFY2(f.panel().state().startsWith("labeling"), qPrintable(f.panel().state()));
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().jobs.count() == 0 && f.all(), kScenePatience);
  QVERIFY(f.segment().labeler().input()->disparity);
  QVERIFY(f.segment().isSegmentationUpToDate());
  QVERIFY2(f.panel().state().startsWith("idle"), qPrintable(f.panel().state()));
}

void AllViewsTest::cancelledDisparity_endsTheWish() {
  AllViews f;
  f.trigger("segment.all");

  f.window.bench().cancels.cancel();

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  QVERIFY(!f.all());
  QVERIFY2(f.panel().state() == "idle", qPrintable(f.panel().state()));
}

void AllViewsTest::quit_asksForLabelsOfAllViews() {
  AllViews f;
  f.segmentAll();

  f.window.close();

  QTRY_VERIFY(f.question());
  QVERIFY2(f.question()->text().contains("labels of all views"), qPrintable(f.question()->text()));
  QTest::mouseClick(f.question()->button(QMessageBox::Cancel), Qt::LeftButton);
  QVERIFY(f.window.isVisible());
}

void AllViewsTest::quit_asksWhileAllViewsAreSegmented() {
  AllViews f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kScenePatience);
  HeldLane held(f.window.bench().jobs, Lane::Label);
  f.trigger("segment.all");

  f.window.close();

  QTRY_VERIFY(f.question());
  QCOMPARE(f.question()->windowTitle(), QString("Work is running"));
  QVERIFY2(f.question()->text().contains("Segment all views"), qPrintable(f.question()->text()));
  QTest::mouseClick(f.question()->button(QMessageBox::Cancel), Qt::LeftButton);
}

void AllViewsTest::exportedLabels_areNotAskedFor() {
  AllViews f;
  f.segmentAll();
  QVERIFY(!f.window.bench().guards.may_leave(Leaving::Session));

  export_labels(f.window.bench(), f.segment(), f.path("out.h5"), {});

  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().guards.may_leave(Leaving::Session), kScenePatience);
}

void AllViewsTest::labelsOfAProject_areThereAgain() {
  AllViews f;
  f.segmentAll();
  const LabelingPtr before = f.all();
  bool is_saved = false;
  find<ProjectController>(f.window).saveTo(f.path("work.episcope"), [&] { is_saved = true; });
  QTRY_VERIFY_WITH_TIMEOUT(is_saved, kScenePatience);
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Session));
  const auto generation = f.session().generation();

  f.window.bench().opener.open(f.path("work.episcope"));

  QTRY_VERIFY_WITH_TIMEOUT(f.session().scene() && f.session().generation() > generation,
                           kScenePatience);
  QTRY_VERIFY_WITH_TIMEOUT(f.all(), kScenePatience);
  QVERIFY(is_equal(*f.all(), *before, {0, 7}));
  QVERIFY(f.window.bench().guards.may_leave(Leaving::Session));
}

void AllViewsTest::pixelsWithoutContent_haveNoLabel() {
  AllViews f;
  f.open(f.writeWithDarkCorners());
  QVERIFY(!f.session().light_field()->valid().empty());

  f.segmentAll();
  f.segment().smoothBoundaries(2);

  const auto written = f.segment().segmentation();
  const ViewStack<std::int32_t> labels =
      finished_labels(*written->labeling, written->finish, Progress());
  for (const ViewIndex view : {ViewIndex{0, 0}, AllViews::kCenter, ViewIndex{8, 3}}) {
    const auto of_view = labels.view(view);
    for (int y = 0; y < AllViews::kCorner; ++y) {
      QVERIFY(std::all_of(of_view.row(y), of_view.row(y) + AllViews::kCorner,
                          [](int id) { return id == 0; }));
    }
    QVERIFY(std::all_of(of_view.row(AllViews::kCorner), of_view.data + of_view.size(),
                        [](int id) { return id > 0; }));
  }
}

void AllViewsTest::disparityOfLabels_alsoCarriesStrokes() {
  AllViews f;
  f.open(f.writeWithoutTruth());
  QVERIFY(!f.session().known_disparity(f.view()));

  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kScenePatience);

  QVERIFY(f.session().known_disparity(f.view()));
  f.trigger("annotate.carry");
  QTRY_VERIFY_WITH_TIMEOUT(find<ScribbleController>(f.window).carried(), kScenePatience);
}

}  // namespace episcope::in_all_views_test

EPISCOPE_WINDOW_TEST(all_views_test, AllViewsTest)
#include "all_views_test.moc"
