// SPDX-License-Identifier: BSD-3-Clause
// Votes of a random forest for the pixels of a view, against OpenCV's own prediction with as many
// trees of the same depth in the same run; and the share of it that reading the features would take
// at the speed of a copy.
#include "engine/labeling/forest.h"

#include <opencv2/ml.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <random>

namespace {

using namespace episcope;

constexpr int kFeatures = 26;
constexpr int kLabels = 13;
constexpr int kSamples = 11000;
constexpr int kWidth = 512;
constexpr int kRows = 64;

ForestSamples make_samples() {
  std::mt19937 random(1);
  ForestSamples samples;
  samples.feature_count = kFeatures;
  samples.label_count = kLabels;
  for (int i = 0; i < kSamples; ++i) {
    const int label = i % kLabels;
    for (int f = 0; f < kFeatures; ++f) {
      const float center = static_cast<float>((label * (f + 3)) % 11) * 0.3F;
      samples.features.push_back(center + static_cast<float>(random() % 1000) * 0.001F);
    }
    samples.labels.push_back(label);
  }
  return samples;
}

Volume<float> make_image(const ForestSamples& samples) {
  Volume<float> image(kRows, kFeatures, kWidth);
  std::mt19937 random(2);
  for (int y = 0; y < kRows; ++y) {
    int sample = 0;
    for (int x = 0; x < kWidth; ++x) {
      if (x % 16 == 0) sample = static_cast<int>(random() % kSamples);  // Images are coherent.
      for (int f = 0; f < kFeatures; ++f) {
        image.view().at(y, f, x) =
            samples.features[static_cast<std::size_t>(sample) * kFeatures + f] +
            static_cast<float>(random() % 100) * 0.001F;
      }
    }
  }
  return image;
}

template <class Work>
double best_seconds(const Work& work) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

// Of one thread, as predict_rows.
double opencv_seconds(const ForestSamples& samples, const Volume<float>& image, int trees) {
  cv::Mat features(samples.count(), kFeatures, CV_32F, const_cast<float*>(samples.features.data()));
  cv::Mat labels(samples.count(), 1, CV_32S, const_cast<std::int32_t*>(samples.labels.data()));
  const auto forest = cv::ml::RTrees::create();
  const ForestOptions options;
  forest->setMaxDepth(options.depth);
  forest->setMinSampleCount(options.min_samples);
  forest->setTermCriteria({cv::TermCriteria::MAX_ITER, trees, 0});
  forest->train(features, cv::ml::ROW_SAMPLE, labels);
  cv::Mat pixels(kRows * kWidth, kFeatures, CV_32F);
  for (int i = 0; i < pixels.rows; ++i) {
    for (int f = 0; f < kFeatures; ++f) {
      pixels.at<float>(i, f) = image.view().at(i / kWidth, f, i % kWidth);
    }
  }
  cv::setNumThreads(1);
  cv::Mat votes;
  return best_seconds([&] { forest->getVotes(pixels, votes, 0); });
}

void vote_view(benchmark::State& state) {
  const ForestSamples samples = make_samples();
  const Volume<float> image = make_image(samples);
  const Forest forest = Forest::train(samples, {}, Progress());
  std::vector<float> rows(static_cast<std::size_t>(kForestRows) * kWidth * forest.pitch());
  const auto predict = [&] {
    for (int y = 0; y < kRows; y += kForestRows) {
      forest.predict_rows(image.view(), {y, kForestRows}, rows.data());
    }
    benchmark::DoNotOptimize(rows.data());
  };
  for (auto _ : state) predict();
  const double own = best_seconds(predict);
  const std::size_t bytes = image.view().size() * sizeof(float);
  std::vector<char> copy(bytes);
  const double copied = best_seconds([&] { std::memcpy(copy.data(), image.view().data, bytes); });
  state.counters["times_faster_than_opencv"] =
      opencv_seconds(samples, image, forest.tree_count()) / own;
  state.counters["ns_per_pixel_and_tree"] = own * 1e9 / (kRows * kWidth) / forest.tree_count();
  state.counters["share_of_copy_bandwidth"] = copied / own;
}

void train_forest(benchmark::State& state) {
  const ForestSamples samples = make_samples();
  for (auto _ : state) benchmark::DoNotOptimize(Forest::train(samples, {}, Progress()));
}

BENCHMARK(vote_view)->Unit(benchmark::kMillisecond);
BENCHMARK(train_forest)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
