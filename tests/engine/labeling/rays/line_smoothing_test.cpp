// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/regularizer.h"

#include "engine/labeling/label_review.h"
#include "tests/engine/labeling/rays/noisy_case.h"
#include "tests/test_main.h"

#include <cmath>
#include <set>

namespace episcope::in_line_smoothing_test {

using namespace episcope::test;

namespace {

RayLines lines_of(const Scene& scene, ViewIndex view, ViewIndex next) {
  return find_ray_lines({scene.truth->field, RayColors(), kGrid.center()}, view, next, Progress());
}

}  // namespace

class LineSmoothingTest : public QObject {
  Q_OBJECT

 private slots:
  void lines_doNotDriftFromTheSlope();
  void lines_endWhereThePointIsHidden();
  void lines_endInDifferentPixels();
  void smoothing_beatsViews_data();
  void smoothing_beatsViews();
  void coherence_makesRaysAgree();
  void smoothing_leavesCertainLabelsAlone();
  void smoothing_isTheSameForAnyThreads();
  void smoothing_endsEarlyWhenAsked();
  void view_isNearlyThatOfAllViews();
};

// A plane of 0.37 px: from view to view alone, every ray would stay in its column.
void LineSmoothingTest::lines_doNotDriftFromTheSlope() {
  const Scene scene = render("fronto", 48);
  for (const bool down : {false, true}) {
    int at = 24;
    for (int k = 0; k + 1 < 5; ++k) {
      const ViewIndex view = down ? ViewIndex{k, 2} : ViewIndex{2, k};
      const ViewIndex next = down ? ViewIndex{k + 1, 2} : ViewIndex{2, k + 1};
      const RayLines lines = lines_of(scene, view, next);
      const std::int32_t end = down ? lines.target.at(at, 20) : lines.target.at(20, at);
      QVERIFY(end >= 0);
      at = down ? end / 48 : end % 48;
      QCOMPARE(down ? end % 48 : end / 48, 20);
      const double exact = 24 - 0.37 * (k + 1);
      QVERIFY2(std::fabs(at - exact) <= 1, qPrintable(QString("%1 %2").arg(at).arg(exact)));
    }
    QCOMPARE(at, 22);  // 23 in the third view, where the line runs through a pixel center
  }
}

void LineSmoothingTest::lines_endWhereThePointIsHidden() {
  const Scene scene = render("edge", 64);
  const DisparityField& field = scene.truth->field;
  const RayLines lines = lines_of(scene, {2, 1}, {2, 2});

  int ended = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 4; x < 60; ++x) {
      const std::int32_t at = lines.target.at(y, x);
      if (at < 0) {
        ++ended;
        continue;
      }
      const float there = field.view({2, 2}).disparity.at(at / 64, at % 64);
      QVERIFY(std::fabs(there - field.view({2, 1}).disparity.at(y, x)) <= 0.25F);
    }
  }
  QVERIFY2(ended > 32 && ended < 64 * 8, qPrintable(QString::number(ended)));
}

void LineSmoothingTest::lines_endInDifferentPixels() {
  const Scene scene = render("slant", 48);
  for (const ViewIndex next : {ViewIndex{1, 2}, ViewIndex{2, 1}}) {
    const RayLines lines = lines_of(scene, {1, 1}, next);
    std::set<std::int32_t> ends;
    int count = 0;
    for (const std::int32_t at : lines.target) {
      if (at < 0) continue;
      ends.insert(at);
      ++count;
    }
    QVERIFY(count > 48 * 40);
    QCOMPARE(static_cast<int>(ends.size()), count);
  }
}

void LineSmoothingTest::smoothing_beatsViews_data() {
  QTest::addColumn<QString>("scene");
  QTest::newRow("edge") << "edge";
  QTest::newRow("objects") << "objects";
  QTest::newRow("bars") << "bars";
}

// 40 % of all rays are mistaken at random: λ of the order of log(0.6/0.4).
void LineSmoothingTest::smoothing_beatsViews() {
  QFETCH(QString, scene);
  const Case noisy(scene.toStdString());
  RayLabelingParameters parameters;
  parameters.smoothness = 1;

  const double views = noisy.right(noisy.label(Regularizer::View, parameters));
  const double rays = noisy.right(noisy.label(Regularizer::Wsg13, parameters));

  const QByteArray told = QString("%1 %2").arg(views).arg(rays).toUtf8();
  QVERIFY2(rays > views + 0.01, told);
  QVERIFY2(rays > (scene == "bars" ? 0.97 : 0.985), told);
}

void LineSmoothingTest::coherence_makesRaysAgree() {
  const Case noisy("objects");
  RayLabelingParameters parameters;
  parameters.smoothness = 1;
  double before = 0;
  for (const double coherence : {0.0, 0.3, 3.0}) {
    parameters.coherence = coherence;
    const RayLabeling labeling = noisy.label(Regularizer::Wsg13, parameters);
    const double share =
        label_consistency(labeling.labels, noisy.scene.truth->field, Progress()).share();
    QVERIFY2(share > before, qPrintable(QString("%1 %2").arg(before).arg(share)));
    before = share;
  }
  QVERIFY2(before > 0.99, qPrintable(QString::number(before)));
}

void LineSmoothingTest::smoothing_leavesCertainLabelsAlone() {
  const Case certain("objects", 0.02, 64);
  RayLabelingParameters parameters;
  parameters.smoothness = 0.2;
  parameters.floor = 0.001;

  QVERIFY(certain.right(certain.label(Regularizer::Wsg13, parameters)) > 0.99);
}

void LineSmoothingTest::smoothing_isTheSameForAnyThreads() {
  const Case noisy("objects", 0.4, 48);

  const RayLabeling one = noisy.label(Regularizer::Wsg13, {}, 1);
  const RayLabeling three = noisy.label(Regularizer::Wsg13, {}, 3);

  QVERIFY(same(one.labels, three.labels));
  QCOMPARE(three.energy, one.energy);
}

void LineSmoothingTest::smoothing_endsEarlyWhenAsked() {
  const Case noisy("objects", 0.4, 48);
  std::stop_source finish;
  finish.request_stop();

  const RayLabeling labeling =
      label_rays(noisy.input(), Regularizer::Wsg13, {}, Progress({}, finish.get_token(), {}));

  QCOMPARE(labeling.iterations, 1);
  QVERIFY(noisy.right(labeling) > 0.6);
}

void LineSmoothingTest::view_isNearlyThatOfAllViews() {
  const Case noisy("objects", 0.4, 48);
  const ViewIndex center = kGrid.center();

  const RayLabeling all = noisy.label(Regularizer::Wsg13);
  const RayLabeling one = label_view(noisy.input(), center, Regularizer::Wsg13, {}, Progress());

  QCOMPARE(one.labels.grid(), (GridShape{1, 1}));
  const auto expected = all.labels.view(center), found = one.labels.view(center);
  int equal = 0;
  for (std::size_t i = 0; i < found.size(); ++i) equal += found.data[i] == expected.data[i] ? 1 : 0;
  QVERIFY2(equal > 0.98 * 48 * 48, qPrintable(QString::number(equal)));
}

}  // namespace episcope::in_line_smoothing_test

EPISCOPE_TEST(line_smoothing_test, LineSmoothingTest)
#include "line_smoothing_test.moc"
