// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/regularizer.h"

#include "tests/engine/labeling/rays/noisy_case.h"
#include "tests/test_main.h"

#include <algorithm>
#include <random>

namespace episcope::in_ray_vote_test {

namespace {

constexpr int kLabels = 4;

// Right labels, but for a share of all rays.
ViewStack<std::int32_t> spoiled(const ViewStack<std::int32_t>& truth, double share) {
  ViewStack<std::int32_t> labels = truth.clone();
  std::mt19937 random(5);
  std::bernoulli_distribution is_wrong(share);
  std::uniform_int_distribution<std::int32_t> any(0, kLabels - 1);
  std::for_each(labels.data(), labels.data() + labels.size(), [&](std::int32_t& label) {
    label = is_wrong(random) ? any(random) : label % kLabels;
  });
  return labels;
}

int count_marks(const ViewStack<std::uint8_t>& marks) {
  return static_cast<int>(std::count(marks.data(), marks.data() + marks.size(), 1));
}

}  // namespace

class RayVoteTest : public QObject {
  Q_OBJECT

 private slots:
  void voteAgain_isTheSameAsAnotherVote_data() {
    QTest::addColumn<int>("size");
    QTest::addColumn<double>("share");
    QTest::newRow("few are wrong") << 96 << 0.02;
    QTest::newRow("many are wrong") << 83 << 0.4;
    QTest::newRow("narrow") << 13 << 0.3;
  }
  void voteAgain_isTheSameAsAnotherVote() {
    QFETCH(int, size);
    QFETCH(double, share);
    const Scene scene = test::render("demo", size);
    const RayColors colors(*scene.light_field, test::kGrid, {}, Progress());
    const RayVotes votes{kLabels, scene.truth->field, colors};
    const auto before = spoiled(scene.truth->labels, share);

    const auto once = vote_along_rays(before, votes, Progress());
    const auto twice = vote_along_rays(once, votes, Progress());
    const auto again = vote_again_along_rays(before, once, votes, Progress());

    QVERIFY(!test::same(once, twice));
    QVERIFY(test::same(again, twice));
  }

  void changedRays_areThoseOfThePoint() {
    DisparityField disparity;
    disparity.disparity = ViewStack<float>({1, 3}, 4, 40);
    std::fill_n(disparity.disparity.data(), disparity.disparity.size(), 2.0F);
    ViewStack<std::int32_t> before({1, 3}, 4, 40), after({1, 3}, 4, 40);
    std::fill_n(before.data(), before.size(), 0);
    std::fill_n(after.data(), after.size(), 0);
    after.view({0, 1}).at(2, 20) = 1;

    const auto marks = changed_rays(before, after, disparity, Progress());

    // The camera to the left sees the point 2 px further to the right, the other to the left.
    QCOMPARE(marks.view({0, 0}).at(2, 22), 1);
    QCOMPARE(marks.view({0, 1}).at(2, 20), 1);
    QCOMPARE(marks.view({0, 2}).at(2, 18), 1);
    QCOMPARE(count_marks(marks), 3);
  }

  void nothingChanged_marksNothing() {
    const Scene scene = test::render("demo", 32);
    const auto labels = spoiled(scene.truth->labels, 0.1);

    QCOMPARE(count_marks(changed_rays(labels, labels, scene.truth->field, Progress())), 0);
  }
};

}  // namespace episcope::in_ray_vote_test

EPISCOPE_TEST(ray_vote_test, RayVoteTest)
#include "ray_vote_test.moc"
