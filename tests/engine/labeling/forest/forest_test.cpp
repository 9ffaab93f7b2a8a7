// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest.h"

#include "engine/core/error.h"
#include "tests/test_main.h"

#include <opencv2/ml.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_forest_test {

namespace {

constexpr int kFeatures = 5;
constexpr int kLabels = 3;

// Clouds about three corners; the last two features are noise.
ForestSamples clouds(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return static_cast<float>(random() % 1000) / 1000.0F - 0.5F; };
  ForestSamples samples;
  samples.feature_count = kFeatures;
  samples.label_count = kLabels;
  for (int i = 0; i < count; ++i) {
    const int label = i % kLabels;
    for (int f = 0; f < kFeatures; ++f) {
      samples.features.push_back((f == label ? 2.0F : 0.0F) + noise());
    }
    samples.labels.push_back(label);
  }
  return samples;
}

// The samples as rows of an image: [y][feature][x].
Volume<float> as_image(const ForestSamples& samples, int width) {
  const int height = samples.count() / width;
  Volume<float> image(height, kFeatures, width);
  for (int y = 0; y < height; ++y) {
    for (int f = 0; f < kFeatures; ++f) {
      for (int x = 0; x < width; ++x) {
        image.view().at(y, f, x) =
            samples.features[(static_cast<std::size_t>(y) * width + x) * kFeatures + f];
      }
    }
  }
  return image;
}

// Probabilities [sample][label].
std::vector<float> predicted(const Forest& forest, const ForestSamples& samples, int width,
                             Isa isa = best_isa()) {
  const Volume<float> image = as_image(samples, width);
  std::vector<float> row(static_cast<std::size_t>(width) * forest.pitch());
  std::vector<float> all;
  for (int y = 0; y < image.height(); ++y) {
    forest.predict_rows(image.view(), {y, 1}, row.data(), isa);
    for (int x = 0; x < width; ++x) {
      const float* pixel = row.data() + static_cast<std::ptrdiff_t>(x) * forest.pitch();
      all.insert(all.end(), pixel, pixel + kLabels);
    }
  }
  return all;
}

}  // namespace

class ForestTest : public QObject {
  Q_OBJECT

 private slots:
  void separableClouds_areToldApart();
  void probabilities_sumToOne();
  void result_dependsOnTheSeed_andNotOnThreads();
  void grownInSteps_isTheSame();
  void occasionalFeature_isUsedByHalfOfTheTrees();
  void manySamplesOfALabel_weighNoMore();
  void flattenedTrees_voteAsOpenCv();
  void instructionSets_agree();
  void rowsPutTogether_voteAsAlone();
  void samplesOfOneLabel_areRefused();
};

void ForestTest::separableClouds_areToldApart() {
  const Forest forest = Forest::train(clouds(300, 1), {}, Progress());
  const ForestSamples unseen = clouds(300, 2);

  const std::vector<float> p = predicted(forest, unseen, 100);

  for (int i = 0; i < unseen.count(); ++i) {
    const auto best = std::max_element(p.begin() + i * kLabels, p.begin() + (i + 1) * kLabels);
    QCOMPARE(static_cast<int>(best - p.begin()) - i * kLabels, unseen.labels[i]);
  }
}

void ForestTest::probabilities_sumToOne() {
  const Forest forest = Forest::train(clouds(90, 1), {}, Progress());

  // 77 is no multiple of a block of pixels.
  const std::vector<float> p = predicted(forest, clouds(77, 3), 77);

  for (std::size_t i = 0; i < p.size(); i += kLabels) {
    QVERIFY(std::abs(p[i] + p[i + 1] + p[i + 2] - 1) < 1e-4F);
  }
}

void ForestTest::result_dependsOnTheSeed_andNotOnThreads() {
  const ForestSamples samples = clouds(300, 1);
  const ForestSamples unseen = clouds(300, 2);
  ForestOptions other;
  other.seed = 2;

  const auto one = predicted(Forest::train(samples, {}, Progress(1)), unseen, 100);
  const auto four = predicted(Forest::train(samples, {}, Progress(4)), unseen, 100);
  const auto reseeded = predicted(Forest::train(samples, other, Progress(4)), unseen, 100);

  QVERIFY(one == four);
  QVERIFY(one != reseeded);
}

void ForestTest::grownInSteps_isTheSame() {
  const ForestSamples samples = clouds(300, 1);
  const ForestSamples unseen = clouds(300, 2);

  Forest forest = Forest::train(samples, {.trees = 20}, Progress());
  QCOMPARE(forest.tree_count(), 20);
  forest.grow(samples, {}, Progress());

  const Forest at_once = Forest::train(samples, {}, Progress());
  QCOMPARE(forest.tree_count(), at_once.tree_count());
  QVERIFY(predicted(forest, unseen, 100) == predicted(at_once, unseen, 100));
}

void ForestTest::occasionalFeature_isUsedByHalfOfTheTrees() {
  // What tells label 0 from the others is its first feature.
  ForestSamples samples = clouds(300, 1);
  const std::vector<float> all = predicted(Forest::train(samples, {}, Progress()), samples, 100);
  samples.occasional = {0, 1, 2};
  const std::vector<float> half = predicted(Forest::train(samples, {}, Progress()), samples, 100);

  QVERIFY(all[0] > 0.95F);
  QVERIFY(half[0] > 0.55F);
  QVERIFY(half[0] < 0.9F);
}

void ForestTest::manySamplesOfALabel_weighNoMore() {
  // Two labels that no feature distinguishes, one painted nine times as much.
  ForestSamples samples;
  samples.feature_count = kFeatures;
  samples.label_count = 2;
  for (int i = 0; i < 200; ++i) {
    samples.features.insert(samples.features.end(), kFeatures, 1.0F);
    samples.labels.push_back(i % 10 == 0 ? 1 : 0);
  }

  const Forest forest = Forest::train(samples, {}, Progress());
  const Volume<float> image = as_image(samples, 10);
  std::vector<float> row(static_cast<std::size_t>(10) * forest.pitch());
  forest.predict_rows(image.view(), {0, 1}, row.data());

  QVERIFY(std::abs(row[0] - 0.5F) < 0.01F);
}

void ForestTest::flattenedTrees_voteAsOpenCv() {
  const ForestSamples samples = clouds(300, 1);
  cv::Mat features(samples.count(), kFeatures, CV_32F, const_cast<float*>(samples.features.data()));
  cv::Mat labels(samples.count(), 1, CV_32S, const_cast<std::int32_t*>(samples.labels.data()));
  const auto trees = cv::ml::RTrees::create();
  trees->setMaxDepth(6);
  trees->setMinSampleCount(2);
  trees->setTermCriteria({cv::TermCriteria::MAX_ITER, 10, 0});
  trees->train(features, cv::ml::ROW_SAMPLE, labels);
  const ForestSamples unseen = clouds(60, 2);
  const cv::Mat asked(unseen.count(), kFeatures, CV_32F,
                      const_cast<float*>(unseen.features.data()));

  cv::Mat votes;  // A row of labels, then one of votes for each sample.
  trees->getVotes(asked, votes, 0);
  cv::Mat own = cv::Mat::zeros(unseen.count(), kLabels, CV_32S);
  for (const int root : trees->getRoots()) {
    const FlatTree flat = flatten_tree(*trees, root);
    for (int i = 0; i < unseen.count(); ++i) {
      int at = 0;
      while (flat.leaves[static_cast<std::size_t>(at)] < 0) {
        const ForestNode& node = flat.nodes[static_cast<std::size_t>(at)];
        at = node.next + (asked.at<float>(i, node.feature) > node.threshold ? 1 : 0);
      }
      const int origin = flat.origins[static_cast<std::size_t>(at)];
      ++own.at<int>(i, trees->getNodes()[static_cast<std::size_t>(origin)].classIdx);
    }
  }

  for (int i = 0; i < unseen.count(); ++i) {
    for (int l = 0; l < kLabels; ++l) QCOMPARE(own.at<int>(i, l), votes.at<int>(i + 1, l));
  }
}

void ForestTest::instructionSets_agree() {
  const Forest forest = Forest::train(clouds(300, 1), {}, Progress());
  const ForestSamples unseen = clouds(200, 2);

  const auto plain = predicted(forest, unseen, 100, Isa::Baseline);
  const auto best = predicted(forest, unseen, 100);

  QVERIFY(plain == best);  // Votes are added in the same order.
}

void ForestTest::rowsPutTogether_voteAsAlone() {
  const Forest forest = Forest::train(clouds(300, 1), {}, Progress());
  constexpr int kWidth = 37;  // No multiple of a block's columns.
  const ForestSamples unseen = clouds(kWidth * kForestRows, 2);
  const Volume<float> image = as_image(unseen, kWidth);
  const std::size_t row = static_cast<std::size_t>(kWidth) * forest.pitch();
  std::vector<float> alone(row * kForestRows);
  for (int y = 0; y < kForestRows; ++y) {
    forest.predict_rows(image.view(), {y, 1}, alone.data() + y * row);
  }

  for (int count = 2; count <= kForestRows; ++count) {
    std::vector<float> together(row * count);
    forest.predict_rows(image.view(), {kForestRows - count, count}, together.data());
    QVERIFY(std::equal(together.begin(), together.end(), alone.end() - row * count));
  }
}

void ForestTest::samplesOfOneLabel_areRefused() {
  ForestSamples samples = clouds(30, 1);
  std::ranges::fill(samples.labels, 0);

  QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)Forest::train(samples, {}, Progress()));
}

}  // namespace episcope::in_forest_test

EPISCOPE_TEST(forest_test, ForestTest)
#include "forest_test.moc"
