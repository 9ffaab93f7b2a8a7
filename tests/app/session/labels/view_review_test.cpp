// SPDX-License-Identifier: BSD-3-Clause
// What is told and written of labels, without a window.
#include "app/session/label_review.h"

#include "app/session/segmentation.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <QDir>
#include <QTemporaryDir>

#include <algorithm>
#include <limits>

namespace episcope::in_view_review_test {

namespace {

constexpr ViewIndex kView{1, 2};

// The true labels of a scene as a labeling that is sure of them.
struct Labeled {
  Scene scene;
  Labeling labeling;

  Labeled() {
    scenes::RenderOptions options;
    options.grid = {3, 5};
    options.height = options.width = 64;
    scene = scenes::render_builtin("objects", options, Progress());
    labeling.labels = scene.truth->labels.clone();
    labeling.probabilities.ids = {1, 2, 3};
    labeling.probabilities.grid = options.grid;
    for (int i = 0; i < options.grid.count(); ++i) {
      const auto labels = labeling.labels.view(options.grid.view_at(i));
      ProbabilityMap map(64, 3, 64);
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) map.view().at(y, labels.at(y, x) - 1, x) = 255;
      }
      labeling.probabilities.views.push_back(std::move(map));
    }
  }
};

}  // namespace

class ViewReviewTest : public QObject {
  Q_OBJECT

 private slots:
  void labels_areCountedAndMeasured();
  void amounts_leaveOutWhatHasNoDisparity();
  void strip_hasTheLabelsOfItsLines();
  void strip_ofALabelThatIsNotSeen_isEmpty();
  void masks_ofOneView_areWrittenWithANameForAnyFileSystem();
  void otherNumbers_areToldWithBothShares();
};

void ViewReviewTest::otherNumbers_areToldWithBothShares() {
  const Labeled f;
  const ViewStack<std::int32_t>& truth = f.scene.truth->labels;
  ViewStack<std::int32_t> turned = truth.clone();
  for (std::size_t i = 0; i < turned.size(); ++i) turned.data()[i] = turned.data()[i] % 3 + 1;
  const auto judged = [&](const ViewStack<std::int32_t>& labels) {
    return judge_labeling(labels, kView, truth, *f.scene.truth, nullptr, Progress());
  };

  const QString text = QString::fromStdString(other_numbers_text(judged(turned)));

  QVERIFY2(
      text.startsWith("0.00 % of the pixels have the number of their true label, but 100.00 %"),
      qPrintable(text));
  QVERIFY(other_numbers_text(judged(truth)).empty());
}

void ViewReviewTest::labels_areCountedAndMeasured() {
  const Labeled f;
  const ScribbleLayer painted({3, 5}, 64, 64);

  const ViewReview review =
      review_view(f.labeling, {}, kView, painted, &f.scene.truth->field, Progress());

  QCOMPARE(review.labels.size(), std::size_t{3});
  QVERIFY(review.doubts.empty());
  const auto labels = f.labeling.labels.view(kView);
  const auto disparity = f.scene.truth->field.disparity.view(kView);
  double sum = 0;
  std::int64_t count = 0;
  double least = 1e9;
  double most = -1e9;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (labels.at(y, x) != 2) continue;
      ++count;
      sum += disparity.at(y, x);
      least = std::min<double>(least, disparity.at(y, x));
      most = std::max<double>(most, disparity.at(y, x));
    }
  }
  const LabelSummary& of_two = review.labels[1];
  QCOMPARE(of_two.amount.pixels, count);
  QVERIFY(std::abs(of_two.amount.disparity->mean - sum / static_cast<double>(count)) < 1e-6);
  QVERIFY(of_two.amount.disparity->deviation > 0);
  QCOMPARE(of_two.amount.disparity->min, least);
  QCOMPARE(of_two.amount.disparity->max, most);
  QCOMPARE(review.labels[0].count(PieceKind::Main), 1);
  QVERIFY(review.labels[0].count(PieceKind::Hole) >= 1);
  QVERIFY(
      !review_view(f.labeling, {}, kView, painted, nullptr, Progress()).labels[1].amount.disparity);
}

void ViewReviewTest::amounts_leaveOutWhatHasNoDisparity() {
  Image<std::uint8_t> labels(2, 4);
  for (int x = 0; x < 4; ++x) labels.at(0, x) = x < 3 ? 7 : 2;
  Image<float> disparity(2, 4, 1, 1.5F);
  disparity.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  disparity.at(0, 2) = -0.5F;
  Image<std::uint8_t> valid(2, 4, 1, 1);
  valid.at(0, 3) = 0;

  const std::vector<LabelAmount> amounts =
      label_amounts(labels.view(), {disparity.view(), valid.view()});

  QCOMPARE(amounts.size(), std::size_t{2});
  QCOMPARE(amounts[0].id, 2);
  QVERIFY(!amounts[0].disparity);
  QCOMPARE(amounts[1].pixels, std::int64_t{3});
  QCOMPARE(amounts[1].disparity->mean, 0.5);
  QCOMPARE(amounts[1].disparity->deviation, 1.0);
  QCOMPARE(amounts[1].disparity->min, -0.5);
  QCOMPARE(amounts[1].disparity->max, 1.5);
}

void ViewReviewTest::strip_hasTheLabelsOfItsLines() {
  const Labeled f;
  for (const EpiDirection direction : {EpiDirection::Horizontal, EpiDirection::Vertical}) {
    const bool is_horizontal = direction == EpiDirection::Horizontal;

    const LabelStrip strip =
        label_strip(*f.scene.light_field, f.labeling, {},
                    {.label = 3, .view = kView, .direction = direction, .count = 4}, Progress());

    QCOMPARE(strip.epis.size(), std::size_t{4});
    for (const LabelEpi& epi : strip.epis) {
      QCOMPARE(epi.labels.height(), is_horizontal ? 5 : 3);
      QCOMPARE(epi.picture.width(), epi.labels.width());
      for (int view = 0; view < epi.labels.height(); ++view) {
        const auto labels = f.labeling.labels.view(is_horizontal ? ViewIndex{kView.v, view}
                                                                 : ViewIndex{view, kView.u});
        for (int i = 0; i < epi.labels.width(); ++i) {
          const int place = strip.first_place + i;
          QCOMPARE(epi.labels.at(view, i),
                   is_horizontal ? labels.at(epi.line, place) : labels.at(place, epi.line));
        }
      }
      QVERIFY(std::ranges::count(epi.labels.begin(), epi.labels.end(), 3) > 0);
    }
  }
}

void ViewReviewTest::strip_ofALabelThatIsNotSeen_isEmpty() {
  const Labeled f;
  QVERIFY(
      label_strip(*f.scene.light_field, f.labeling, {}, {.label = 77, .view = kView}, Progress())
          .epis.empty());
}

void ViewReviewTest::masks_ofOneView_areWrittenWithANameForAnyFileSystem() {
  const Labeled f;
  auto one = std::make_shared<Labeling>();
  one->labels = ViewStack<std::int32_t>({1, 1}, 64, 64, 1, kView);
  const auto labels = f.labeling.labels.view(kView);
  std::copy_n(labels.data, labels.size(), one->labels.data());
  one->probabilities.ids = {1, 2, 3};
  const QTemporaryDir folder;

  const int count = write_label_masks(folder.filePath("m").toStdString(),
                                      {one, {{2, "a/b: c", {}}}, {}, {}, {}}, Progress());

  QCOMPARE(count, 3);
  QCOMPARE(QDir(folder.filePath("m")).entryList(QDir::Dirs | QDir::NoDotAndDotDot),
           QStringList({"01_label 1", "02_a_b_ c", "03_label 3"}));
  QVERIFY(QFile::exists(folder.filePath("m/02_a_b_ c/mask_01_02.png")));
  QFile list(folder.filePath("m/labels.txt"));
  QVERIFY(list.open(QFile::ReadOnly));
  QCOMPARE(list.readAll(), QByteArray("1\tlabel 1\n2\ta/b: c\n3\tlabel 3\n"));
}

}  // namespace episcope::in_view_review_test

EPISCOPE_TEST(view_review_test, ViewReviewTest)
#include "view_review_test.moc"
