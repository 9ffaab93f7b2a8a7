// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_exchange.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/commands.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/scribble_file.h"
#include "tests/app/gui/annotating.h"
#include "tests/app/gui/held_lane.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/segment_panel.h"

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QSignalSpy>

#include <cmath>

// Segments in the window that ships, from what is painted with the mouse.

namespace episcope::in_segment_test {

namespace {

using render::Quantity;

class Segmenting : public Annotating {
 public:
  explicit Segmenting(const std::string& id = "objects") : Annotating(id) {}

  SegmentPanel& panel() { return *window.findChild<SegmentPanel*>(); }
};

}  // namespace

class SegmentTest : public QObject {
  Q_OBJECT

 private slots:
  void settings_areNamedInWords();
  void live_labelsTheViewAndShowsIt();
  void stroke_andUndo_giveNewLabels();
  void view_thatIsGoneTo_isLabeledToo();
  void overlay_thatIsOn_staysOnInOtherViews();
  void withoutLive_aStrokeOutdatesTheLabels();
  void labelsOfStrokesThatAreUndone_areOutOfDate_data();
  void labelsOfStrokesThatAreUndone_areOutOfDate();
  void oneLabel_isAHintAndNoError();
  void overlays_areDrawn();
  void recolouredLabel_isSeenAtOnce();
  void wrongPixels_areTintedAlone();
  void labels_areComparedWithThoseOfAnotherFile();
  void foreignNumbers_areMatchedByNameOrOverlap();
  void allViews_areExportedAndReadAgain();
  void allViews_goOnWhileAnotherSceneIsShown();
  void allViewsOfAClosedScene_end();
  void otherScene_dropsEverything();
  void escape_endsALabeling();
  void mapOfLabels_isNotShownOverAnotherLightField();
  void labelsOfAProject_haveNoProbabilities();
};

void SegmentTest::settings_areNamedInWords() {
  Segmenting f;

  QStringList names;
  for (const auto* choice : f.panel().findChildren<QComboBox*>()) {
    for (int i = 0; i < choice->count(); ++i) names << choice->itemText(i);
  }

  QVERIFY2(names.contains("image and estimate"), qPrintable(names.join(", ")));
  QVERIFY2(names.filter("+").isEmpty(), qPrintable(names.join(", ")));
}

void SegmentTest::live_labelsTheViewAndShowsIt() {
  Segmenting f;

  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Segmentation);
  QTRY_VERIFY(!f.window.bench().overlay.picture().isNull());
  QVERIFY2(f.accuracy() > 0.75, qPrintable(QString::number(f.accuracy())));
  QVERIFY(f.segment().labeler().input()->disparity);
  QVERIFY2(f.panel().state().startsWith("idle"), qPrintable(f.panel().state()));
  QTRY_VERIFY(f.panel().note().startsWith("correct:"));
}

void SegmentTest::stroke_andUndo_giveNewLabels() {
  Segmenting f;
  f.trigger("segment.live");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const LabelingPtr first = f.segment().labeler().labeling(f.view());

  f.drag({5, 5}, {5, 60});
  QVERIFY(f.segment().labeler().is_running());
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const LabelingPtr second = f.segment().labeler().labeling(f.view());
  QVERIFY(second != first);

  f.key(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(!f.segment().labeler().is_up_to_date(f.view()));
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  const auto again = f.segment().labeler().labeling(f.view())->labels.view(f.view());
  const auto before = first->labels.view(f.view());
  QVERIFY(std::equal(again.data, again.data + again.size(), before.data));
}

void SegmentTest::view_thatIsGoneTo_isLabeledToo() {
  Segmenting f;
  f.trigger("segment.live");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  f.window.bench().session.set_view({0, 2});
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  QVERIFY2(f.accuracy() > 0.75, qPrintable(QString::number(f.accuracy())));
}

void SegmentTest::overlay_thatIsOn_staysOnInOtherViews() {
  Segmenting f;
  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Segmentation);

  f.key(Qt::Key_Left);
  QCoreApplication::processEvents();
  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Segmentation);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Segmentation);
  QTRY_VERIFY(!f.window.bench().overlay.picture().isNull());
}

void SegmentTest::withoutLive_aStrokeOutdatesTheLabels() {
  Segmenting f;
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  f.drag({5, 5}, {5, 60});

  QCOMPARE(f.panel().state(), QString("out of date"));
  QVERIFY(!f.segment().labeler().is_running());
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
}

void SegmentTest::labelsOfStrokesThatAreUndone_areOutOfDate_data() {
  QTest::addColumn<QString>("command");
  QTest::newRow("live") << "segment.live";
  QTest::newRow("once") << "segment.update";
}

// They once stood there as if they were of now, and were exported so.
void SegmentTest::labelsOfStrokesThatAreUndone_areOutOfDate() {
  QFETCH(QString, command);
  Segmenting f("edge");
  for (const int y : {20, 70}) {
    f.trigger("annotate.add_label");
    f.drag({y, 20}, {y, 60});
  }
  f.trigger(command.toUtf8());
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QTRY_VERIFY(!f.canvas()->caption().contains("out of date"));

  while (f.window.bench().commands.find("annotate.undo")->isEnabled()) f.trigger("annotate.undo");

  QVERIFY(f.document().labels().labels().empty());
  QTRY_COMPARE_WITH_TIMEOUT(f.panel().state(), QString("out of date"), kPatience);
  QVERIFY2(f.canvas()->caption().contains("segmentation, out of date"),
           qPrintable(f.canvas()->caption()));
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QDir().mkpath(f.path("masks"));
  export_masks(f.window.bench(), f.segment(), f.path("masks"));
  QTRY_VERIFY2_WITH_TIMEOUT(messages->text().contains("masks holds labels that were out of date"),
                            qPrintable(messages->text()), kPatience);
}

void SegmentTest::oneLabel_isAHintAndNoError() {
  Segmenting f("edge");
  QSignalSpy failed(&f.window.bench().jobs, &Jobs::failed);
  f.trigger("annotate.add_label");
  f.drag({40, 20}, {40, 60});

  f.trigger("segment.live");
  QTRY_COMPARE_WITH_TIMEOUT(f.segment().labeler().state(), LiveState::Hint, kPatience);

  QVERIFY(!f.panel().note().isEmpty());
  f.trigger("annotate.add_label");
  f.drag({80, 20}, {80, 60});
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QCOMPARE(failed.size(), 0);
}

void SegmentTest::overlays_areDrawn() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  QImage last;
  for (const char* id : {"segment.probability", "segment.uncertainty", "segment.edges",
                         "segment.wrong", "segment.show"}) {
    f.trigger(id);
    QTRY_VERIFY2(f.window.bench().overlay.isUpToDate() &&
                     !f.window.bench().overlay.picture().isNull() &&
                     f.window.bench().overlay.picture() != last,
                 id);
    last = f.window.bench().overlay.picture();
  }
  f.key(Qt::Key_S);
  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::View);
  f.key(Qt::Key_P);
  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Probability);
  const QString label = QString::fromStdString(f.window.bench().labels.info()->name);
  const Overlay& overlay = f.window.bench().overlay;
  QVERIFY2(overlay.describe(overlay.choice()).contains(label), qPrintable(label));
}

void SegmentTest::recolouredLabel_isSeenAtOnce() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const auto labels = f.segment().labeler().labeling(f.view())->labels.view(f.view());
  const int id = labels.at(0, 0);

  f.window.bench().document.edit([id](AnnotationDocument& document) {
    document.recolor_label(id, {1, 2, 3});
  });

  QTRY_COMPARE(f.window.bench().overlay.picture().pixelColor(0, 0), QColor(1, 2, 3));
  QVERIFY(f.segment().labeler().is_up_to_date(f.view()));
}

void SegmentTest::wrongPixels_areTintedAlone() {
  Segmenting f;
  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  f.trigger("segment.wrong");
  const Overlay& overlay = f.window.bench().overlay;
  QTRY_COMPARE(overlay.quantity(), Quantity::WrongLabels);
  const auto tinted = [&overlay] {
    const QImage picture = overlay.picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) count += picture.pixelColor(x, y).alpha() > 0;
    }
    return count;
  };

  const auto wrong = static_cast<int>(std::lround((1 - f.accuracy()) * 96 * 96));
  QVERIFY(wrong > 0);
  QTRY_COMPARE_WITH_TIMEOUT(tinted(), wrong, kPatience);
  f.trigger("tab.compare");
  const auto* title = f.window.findChild<ElidedLabel*>("statistics.title");
  const QString share = QString::number(100 * (1 - f.accuracy()), 'f', 2);
  QTRY_COMPARE_WITH_TIMEOUT(
      title->fullText(), QString("Wrong labels: %1 % of the visible part").arg(share), kPatience);
}

void SegmentTest::labels_areComparedWithThoseOfAnotherFile() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QTRY_VERIFY(f.panel().note().startsWith("correct:"));
  const QString before = f.panel().note();
  // All that is there is the thing in the middle.
  Scene other = *f.window.bench().session.scene();
  auto truth = std::make_shared<GroundTruth>();
  truth->labels = other.truth->labels.clone();
  const ViewIndex view = f.view();
  const int middle = truth->labels.view(view).at(40, 40);
  std::fill_n(truth->labels.data(), truth->labels.size(), middle);
  other.truth = truth;
  QDir().mkpath(f.path("other"));
  io::write_archive(f.path("other/lf.h5").toStdString(), other, Progress(1));
  const auto labels = f.segment().labeler().labeling(view)->labels.view(view);
  const auto right = std::count(labels.data, labels.data + labels.size(), middle);

  QSignalSpy failed(&f.window.bench().jobs, &Jobs::failed);
  find<AnnotationFiles>(f.window).compareWith(f.path("other/lf.h5"));
  QTRY_COMPARE(failed.size(), 1);
  QCOMPARE(f.panel().note(), before);

  find<AnnotationFiles>(f.window).compareWith(f.path("other/labels.h5"));
  QTRY_VERIFY(f.panel().note() != before);

  const QString share = QString::number(
      100.0 * static_cast<double>(right) / static_cast<double>(labels.size()), 'f', 1);
  QVERIFY2(f.panel().note().contains(share), qPrintable(f.panel().note() + " " + share));
  QVERIFY(f.window.bench().overlay.isAvailable(Quantity::TrueLabels));
  QVERIFY(f.window.bench().overlay.isAvailable(Quantity::WrongLabels));
}

void SegmentTest::foreignNumbers_areMatchedByNameOrOverlap() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QTRY_VERIFY(f.panel().note().startsWith("correct:"));
  const QString before = f.panel().note();
  Scene other = *f.window.bench().session.scene();
  auto truth = std::make_shared<GroundTruth>();
  truth->labels = other.truth->labels.clone();
  for (std::size_t i = 0; i < truth->labels.size(); ++i) truth->labels.data()[i] += 40;
  other.truth = truth;
  other.scribbles.views.clear();
  const auto write = [&](const QString& folder) {
    QDir().mkpath(f.path(folder));
    io::write_archive(f.path(folder + "/lf.h5").toStdString(), other, Progress(1));
    return f.path(folder + "/labels.h5");
  };
  other.scribbles.labels = f.document().labels().labels();
  for (LabelInfo& label : other.scribbles.labels) label.id += 40;
  const QString named = write("named");
  other.scribbles.labels.clear();
  const QString unnamed = write("unnamed");

  find<AnnotationFiles>(f.window).compareWith(unnamed);
  QTRY_COMPARE(f.panel().note(), before + ", labels matched by overlap");
  find<AnnotationFiles>(f.window).compareWith(named);
  QTRY_COMPARE(f.panel().note(), before);
}

void SegmentTest::allViews_areExportedAndReadAgain() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  f.trigger("segment.all");
  QCOMPARE(f.window.bench().jobs.count(Lane::Label), 1);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);
  const LabelingPtr all = f.segment().labeler().labeling({0, 0});
  QVERIFY(all && all->labels.grid().count() == 81);
  QTRY_VERIFY(f.panel().note().contains("consistent"));
  using Kind = LabelTarget::Kind;
  export_labels(f.window.bench(), f.segment(), f.path("out.h5"), {Kind::Hdf5WithProbabilities});
  export_labels(f.window.bench(), f.segment(), f.path("out.png"), {Kind::Picture});
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path("out.png")), kPatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kPatience);

  const io::SegmentationFile file(f.path("out.h5").toStdString());
  QVERIFY(file.grid() == (GridShape{9, 9}));
  QVERIFY(file.has_probabilities());
  const Image<std::int32_t> read = file.labels({8, 1});
  QVERIFY(std::equal(read.begin(), read.end(), all->labels.view({8, 1}).data));
  QCOMPARE(QImage(f.path("out.png")).size(), QSize(96, 96));
}

void SegmentTest::allViews_goOnWhileAnotherSceneIsShown() {
  Segmenting f;
  Session& session = f.window.bench().session;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const std::uint64_t scene = session.generation();
  HeldLane held(f.window.bench().jobs, Lane::Label);
  f.trigger("segment.all");

  f.openSmall("edge");
  QVERIFY(!f.segment().isSegmentingAll());
  held.release();

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(Lane::Label), 0, kPatience);
  QVERIFY(session.labels().empty());
  QVERIFY(session.find_scene(scene)->labels.covers_many());
  session.choose(scene);
  QTRY_VERIFY_WITH_TIMEOUT(f.segment().labeler().labeling({0, 0}), kPatience);
  QVERIFY(f.segment().labeler().is_up_to_date({0, 0}));
}

void SegmentTest::allViewsOfAClosedScene_end() {
  Segmenting f;
  f.trigger("segment.update");
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  const std::uint64_t scene = f.window.bench().session.generation();
  HeldLane held(f.window.bench().jobs, Lane::Label);
  f.trigger("segment.all");
  f.openSmall("edge");
  QSignalSpy cancelling(&f.window.bench().jobs, &Jobs::cancelling);

  f.window.bench().session.remove(scene);

  QTRY_COMPARE(cancelling.size(), 1);
}

void SegmentTest::otherScene_dropsEverything() {
  Segmenting f;
  f.trigger("segment.live");
  QTRY_VERIFY_WITH_TIMEOUT(f.segment().labeler().labeling(f.view()), kPatience);

  f.openSmall("edge");

  QTRY_VERIFY_WITH_TIMEOUT(!f.segment().labeler().labeling({4, 4}), kPatience);
  QVERIFY(!f.segment().segmentation());
  f.window.bench().document.discardAll();
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
  f.window.bench().opener.close();  // the first one is shown again
  QTRY_COMPARE(f.window.bench().session.scenes().size(), 1U);
  QTRY_VERIFY(f.window.bench().document.document());
  f.window.bench().opener.close();
  QTRY_VERIFY(!f.segment().labeler().has_input());
  QVERIFY(!f.window.bench().commands.find("segment.update")->isEnabled());
}

void SegmentTest::escape_endsALabeling() {
  Segmenting f;
  f.trigger("segment.update");
  QVERIFY(f.segment().labeler().is_running());

  f.window.bench().cancels.cancel();

  QVERIFY(!f.segment().labeler().is_running());
}

void SegmentTest::mapOfLabels_isNotShownOverAnotherLightField() {
  Segmenting f;
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  f.key(Qt::Key_P);
  QCOMPARE(f.window.bench().overlay.quantity(), Quantity::Probability);

  f.openSmall("edge");

  QTRY_COMPARE(f.window.bench().overlay.quantity(), Quantity::View);
  QVERIFY(f.window.bench().viewer_area.colorBar()->isHidden());
}

void SegmentTest::labelsOfAProject_haveNoProbabilities() {
  Segmenting f;
  const Workbench& bench = f.window.bench();
  f.key(Qt::Key_U);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  f.key(Qt::Key_P);
  f.openSmall("edge");
  auto& project = find<ProjectController>(f.window);
  bool is_saved = false;
  project.saveTo(f.path("work.episcope"), [&is_saved] { is_saved = true; });
  QTRY_VERIFY_WITH_TIMEOUT(is_saved, kScenePatience);
  const auto before = bench.session.generation();
  bench.opener.open(f.path("work.episcope"));
  QTRY_VERIFY_WITH_TIMEOUT(bench.session.scene() && bench.session.generation() > before,
                           kScenePatience);

  f.key(Qt::Key_PageUp, Qt::ControlModifier | Qt::AltModifier);
  QTRY_VERIFY_WITH_TIMEOUT(f.segment().labeler().labeling(f.view()), kScenePatience);

  QTRY_VERIFY(bench.commands.find("segment.show")->isEnabled());
  QVERIFY(!bench.commands.find("segment.probability")->isEnabled());
  QVERIFY(!bench.commands.find("segment.uncertainty")->isEnabled());
  QCOMPARE(bench.overlay.quantity(), Quantity::View);
  QVERIFY(!project.hasChanged());
  QVERIFY(!f.window.isWindowModified());
}

}  // namespace episcope::in_segment_test

EPISCOPE_WINDOW_TEST(segment_test, SegmentTest)
#include "segment_test.moc"
