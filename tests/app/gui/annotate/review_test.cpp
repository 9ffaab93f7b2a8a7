// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_review.h"
#include "app/session/segmentation.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/number_spin.h"
#include "widgets/panels/label_review_panel.h"

#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QTreeWidget>

#include <algorithm>

// Checks labels in the window that ships, by mouse and keys: regions in doubt, islands and holes,
// labels over the views, smooth boundaries, masks.

namespace episcope::in_review_test {

namespace {

class Reviewing : public Annotating {
 public:
  Reviewing() : Annotating("objects") { window.resize(1280, 760); }

  void segmentLive() {
    key(Qt::Key_L);
    QTRY_VERIFY_WITH_TIMEOUT(isSegmented(), kPatience);
    QTRY_VERIFY_WITH_TIMEOUT(review().review(), kPatience);
  }
  bool isSegmentedSince(const std::shared_ptr<const ViewReview>& before) {
    return isSegmented() && review().review() && review().review() != before;
  }
  LabelReviewController& review() { return find<LabelReviewController>(window); }
  const LabelingPtr labeling() {
    return find<SegmentController>(window).labeler().labeling(view());
  }
  Image<std::int32_t> labels() {
    const Segmentation now = *find<SegmentController>(window).segmentation();
    return finished_labels(*now.labeling, now.finish, view());
  }
  PixelIndex crossHair() { return window.bench().session.cross_hair(); }
  QString message() { return window.findChild<MessageBar*>("messageBar")->text(); }
  QTreeWidget* list(const char* name) { return window.findChild<QTreeWidget*>(name); }
  void clickRow(QTreeWidget* list, int row) {
    QTreeWidgetItem* item = list->topLevelItem(row);
    QVERIFY(item);
    list->scrollToItem(item);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(item).center());
  }
  void segmentAll() {
    key(Qt::Key_U, Qt::ShiftModifier);
    QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience);
    QCOMPARE(labeling()->labels.grid().count(), 81);
  }
};

// A scene with regions that strokes do not decide.
class Doubting : public Reviewing {
 public:
  Doubting() {
    window.bench().opener.open("demo:random?seed=1&kind=room&size=128");
    [&] {
      QTRY_COMPARE_WITH_TIMEOUT(canvas()->picture().size(), QSize(128, 128), kScenePatience);
      QTRY_VERIFY_WITH_TIMEOUT(window.bench().document.document(), kScenePatience);
      QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience);
    }();
  }
};

int count_of(const Image<std::int32_t>& labels, int id) {
  return static_cast<int>(std::count(labels.begin(), labels.end(), id));
}

}  // namespace

class ReviewTest : public QObject {
  Q_OBJECT

 private slots:
  void nextDoubt_isGoneTo_shown_andSaid();
  void strokeInADoubt_settlesIt();
  void return_keepsTheLabelOfADoubt();
  void digit_givesADoubtAnotherLabel();
  void withoutLabels_theKeySaysWhatToDo();
  void islandsAndHoles_areListed_andAClickGoesThere();
  void strokesOnOtherViews_count();
  void smootherBoundaries_areShown_andUndone();
  void labelOverTheViews_isShown_andAClickGoesThere();
  void masks_areThoseOfTheLabels();
};

void ReviewTest::nextDoubt_isGoneTo_shown_andSaid() {
  Doubting f;
  f.segmentLive();
  const auto review = f.review().review();
  QVERIFY2(review->doubts.size() >= 2, qPrintable(QString::number(review->doubts.size())));
  f.trigger("tab.check");
  QCOMPARE(f.list("check.doubts")->topLevelItemCount(), static_cast<int>(review->doubts.size()));

  f.key(Qt::Key_J);

  QVERIFY(f.crossHair() == review->doubts[0].blob.inside);
  QVERIFY(!f.canvas()->outline().empty());
  QVERIFY2(f.message().startsWith("1 of"), qPrintable(f.message()));
  QCOMPARE(f.list("check.doubts")->currentIndex().row(), 0);
  f.key(Qt::Key_J);
  QVERIFY(f.crossHair() == review->doubts[1].blob.inside);
  f.key(Qt::Key_J, Qt::ShiftModifier);
  QVERIFY(f.crossHair() == review->doubts[0].blob.inside);

  f.key(Qt::Key_Escape);
  QVERIFY(f.canvas()->outline().empty());
  f.clickRow(f.list("check.doubts"), 1);
  QVERIFY(f.crossHair() == review->doubts[1].blob.inside);
  f.key(Qt::Key_Left);
  QTRY_VERIFY(f.canvas()->outline().empty());
}

void ReviewTest::strokeInADoubt_settlesIt() {
  Doubting f;
  f.segmentLive();
  const auto before = f.review().review();
  f.key(Qt::Key_J);
  const LabelDoubt& doubt = before->doubts[0];
  f.window.bench().labels.choose(doubt.rival);

  f.drag(doubt.blob.inside, doubt.blob.inside);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmentedSince(before), kPatience);

  QCOMPARE(f.labels().at(doubt.blob.inside.y, doubt.blob.inside.x), doubt.rival);
  for (const LabelDoubt& each : f.review().review()->doubts) {
    QVERIFY(!each.blob.contains(doubt.blob.inside));
  }
  QVERIFY(f.canvas()->outline().empty());
}

void ReviewTest::return_keepsTheLabelOfADoubt() {
  Doubting f;
  f.segmentLive();
  const auto before = f.review().review();
  f.key(Qt::Key_J);
  const LabelDoubt& doubt = before->doubts[0];

  f.key(Qt::Key_Return);

  QCOMPARE(f.labelAt(doubt.blob.inside, f.view()), doubt.label);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmentedSince(before), kPatience);
  QCOMPARE(f.labels().at(doubt.blob.inside.y, doubt.blob.inside.x), doubt.label);
  for (const LabelDoubt& each : f.review().review()->doubts) {
    QVERIFY(!each.blob.contains(doubt.blob.inside));
  }
}

void ReviewTest::digit_givesADoubtAnotherLabel() {
  Doubting f;
  f.segmentLive();
  const auto before = f.review().review();
  f.key(Qt::Key_J);
  const LabelDoubt& doubt = before->doubts[0];
  const int current = f.window.bench().labels.current();
  const auto& labels = f.document().labels().labels();
  const auto place = std::ranges::find(labels, doubt.rival, &LabelInfo::id) - labels.begin();
  QVERIFY(place < 9);

  f.key(static_cast<Qt::Key>(Qt::Key_1 + place));

  QCOMPARE(f.labelAt(doubt.blob.inside, f.view()), doubt.rival);
  QCOMPARE(f.window.bench().labels.current(), current);
  f.key(static_cast<Qt::Key>(Qt::Key_1 + place));
  QCOMPARE(f.window.bench().labels.current(), doubt.rival);
}

void ReviewTest::withoutLabels_theKeySaysWhatToDo() {
  Reviewing f;
  f.key(Qt::Key_J);
  QVERIFY2(f.message().contains("segmented"), qPrintable(f.message()));
  f.trigger("tab.check");
  QVERIFY(!find<LabelReviewPanel>(f.window).note().isEmpty());
}

void ReviewTest::islandsAndHoles_areListed_andAClickGoesThere() {
  Reviewing f;
  f.segmentLive();
  f.trigger("tab.check");
  QTreeWidget* rows = f.list("check.labels");
  QCOMPARE(rows->topLevelItemCount(), 3);

  // The background, before which two things stand.
  f.clickRow(rows, 0);

  QCOMPARE(f.window.bench().labels.current(), 1);
  const auto pieces = pieces_of(f.labels(), 1);
  QTreeWidget* list = f.list("check.pieces");
  QCOMPARE(list->topLevelItemCount(), static_cast<int>(pieces.size()) - 1);
  const auto hole = std::ranges::find(pieces, PieceKind::Hole, &LabelPiece::kind);
  QVERIFY(hole != pieces.end());
  f.clickRow(list, static_cast<int>(hole - pieces.begin()) - 1);
  QVERIFY(f.crossHair() == hole->blob.inside);
  QCOMPARE(f.labels().at(f.crossHair().y, f.crossHair().x), hole->label);
  QVERIFY(f.canvas()->outline() ==
          outline_of(hole->blob.mask.view(), {hole->blob.bounds.x0, hole->blob.bounds.y0}));

  // What is found is painted over at once, without another tab.
  f.drag(hole->blob.inside, hole->blob.inside);
  QCOMPARE(f.labelAt(hole->blob.inside), 1);
}

void ReviewTest::strokesOnOtherViews_count() {
  Annotating f("edge");
  f.window.bench().session.set_view({2, 3});
  QCoreApplication::processEvents();
  f.trigger("annotate.add_label");
  const int left = f.window.bench().labels.current();
  f.drag({20, 10}, {80, 10});
  f.trigger("annotate.add_label");
  const int right = f.window.bench().labels.current();
  f.drag({20, 86}, {80, 86});
  f.key(Qt::Key_Home);
  QVERIFY(f.view() == Annotating::kCenter);

  f.key(Qt::Key_L);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);

  const auto labels = [&f] {
    const LabelingPtr labeling = f.segment().labeler().labeling(Annotating::kCenter);
    return finished_labels(*labeling, {}, Annotating::kCenter);
  };
  QCOMPARE(labels().at(50, 6), left);
  QCOMPARE(labels().at(50, 90), right);

  // A correction on another view changes what is seen from here.
  f.window.bench().session.set_view({6, 5});
  QCoreApplication::processEvents();
  f.trigger("annotate.add_label");
  const int corrected = f.window.bench().labels.current();
  f.drag({10, 30}, {30, 30});
  f.key(Qt::Key_Home);
  QTRY_VERIFY_WITH_TIMEOUT(f.isSegmented(), kPatience);
  QVERIFY(count_of(labels(), corrected) > 50);
}

void ReviewTest::smootherBoundaries_areShown_andUndone() {
  Reviewing f;
  f.segmentLive();
  QTRY_VERIFY(!f.window.bench().overlay.picture().isNull());
  const QImage rough = f.window.bench().overlay.picture();
  const auto before = f.labels();

  for (int i = 0; i < 6; ++i) f.key(Qt::Key_S, Qt::ShiftModifier);

  QCOMPARE(f.document().boundary_smoothing_px(), 3.0);
  QTRY_VERIFY_WITH_TIMEOUT(
      f.window.bench().overlay.isUpToDate() && f.window.bench().overlay.picture() != rough,
      kPatience);
  QCOMPARE(f.window.findChild<NumberSpin*>("segment.smoothing")->value(), 3.0);
  QVERIFY(f.segment().labeler().is_up_to_date(f.view()));  // nothing is learnt anew
  const auto smooth = f.labels();
  QVERIFY(boundaries_of(smooth.view(), 0, Boundaries::Others).size() <
          boundaries_of(before.view(), 0, Boundaries::Others).size());
  const auto painted = f.document().scribbles().view(f.view());
  for (int y = 0; y < smooth.height(); ++y) {
    for (int x = 0; x < smooth.width(); ++x) {
      if (painted.at(y, x) != 0) QCOMPARE(smooth.at(y, x), before.at(y, x));
    }
  }
  for (int i = 0; i < 6; ++i) f.key(Qt::Key_Z, Qt::ControlModifier);
  QTRY_VERIFY_WITH_TIMEOUT(
      f.window.bench().overlay.isUpToDate() && f.window.bench().overlay.picture() == rough,
      kPatience);
}

void ReviewTest::labelOverTheViews_isShown_andAClickGoesThere() {
  Reviewing f;
  f.segmentLive();
  f.key(Qt::Key_L, Qt::ShiftModifier);
  auto* dialog = f.window.findChild<QDialog*>("strip");
  QVERIFY(dialog->isVisible());
  auto* strip = dialog->findChild<EpiStripView*>();
  QCOMPARE(strip->count(), 0);  // labels of one view

  f.segmentAll();
  QTRY_VERIFY_WITH_TIMEOUT(strip->count() > 3, kPatience);
  const auto& epi = strip->epis()[1];
  QCOMPARE(epi.picture.height(), 9);
  QVERIFY(std::ranges::any_of(strip->epis(),
                              [](const auto& each) { return !each.boundaries.empty(); }));

  // The uppermost row of an EPI is the leftmost view.
  const QRectF area = strip->areaOf(1);
  QTest::mouseClick(strip, Qt::LeftButton, {},
                    QPoint(static_cast<int>(area.center().x()), static_cast<int>(area.top()) + 2));
  QVERIFY((f.view() == ViewIndex{4, 0}));
  QVERIFY2(epi.caption.endsWith(QString::number(f.crossHair().y)), qPrintable(epi.caption));
  const QString rows = epi.caption;

  auto* direction = dialog->findChild<QComboBox*>("strip.direction");
  direction->setCurrentIndex(1);
  emit direction->activated(1);
  QTRY_VERIFY_WITH_TIMEOUT(strip->count() > 0 && strip->epis()[0].caption.startsWith("column"),
                           kPatience);
}

void ReviewTest::masks_areThoseOfTheLabels() {
  Reviewing f;
  f.segmentLive();
  f.segmentAll();
  f.key(Qt::Key_S, Qt::ShiftModifier);  // what is shown is written
  const QString folder = f.path("masks");

  export_masks(f.window.bench(), find<SegmentController>(f.window), folder);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);

  const Segmentation now = *find<SegmentController>(f.window).segmentation();
  const auto labels = finished_labels(*now.labeling, now.finish, {7, 2});
  int pixels = 0;
  for (const LabelInfo& info : now.labels) {
    const QStringList folders =
        QDir(folder).entryList({QString("%1_*").arg(info.id, 2, 10, QChar('0'))});
    QCOMPARE(folders.size(), 1);
    QCOMPARE(QDir(folder + '/' + folders[0]).entryList({"mask_*.png"}).size(), 81);
    const QImage mask(folder + '/' + folders[0] + "/mask_07_02.png");
    QCOMPARE(mask.size(), QSize(96, 96));
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        const bool is_in = qGray(mask.pixel(x, y)) == 255;
        pixels += is_in ? 1 : 0;
        QCOMPARE(is_in, labels.at(y, x) == info.id);
      }
    }
  }
  QCOMPARE(pixels, 96 * 96);
}

}  // namespace episcope::in_review_test

EPISCOPE_WINDOW_TEST(review_test, ReviewTest)
#include "review_test.moc"
