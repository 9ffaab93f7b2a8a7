// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>
#include <opencv2/ml.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

namespace episcope {
namespace {

// The widest vector of floats.

std::vector<std::vector<int>> samples_by_label(const ForestSamples& samples) {
  std::vector<std::vector<int>> of_label(static_cast<std::size_t>(samples.label_count));
  for (int i = 0; i < samples.count(); ++i) of_label[samples.labels[i]].push_back(i);
  return of_label;
}

/// As many samples of each label, drawn with replacement. `is_without`: the occasional features are
/// constant, so that no split uses them.
cv::Ptr<cv::ml::TrainData> draw(const ForestSamples& samples,
                                const std::vector<std::vector<int>>& of_label, int count,
                                bool is_without, std::mt19937& random) {
  const int rows = count * samples.label_count;
  cv::Mat features(rows, samples.feature_count, CV_32F);
  cv::Mat labels(rows, 1, CV_32S);
  int row = 0;
  for (const std::vector<int>& candidates : of_label) {
    for (int i = 0; i < count; ++i, ++row) {
      // The distributions of the standard library differ between implementations.
      const int sample = candidates[random() % candidates.size()];
      std::copy_n(
          samples.features.data() + static_cast<std::ptrdiff_t>(sample) * samples.feature_count,
          samples.feature_count, features.ptr<float>(row));
      if (is_without) {
        for (const int feature : samples.occasional) features.at<float>(row, feature) = 0;
      }
      labels.at<int>(row) = samples.labels[sample];
    }
  }
  return cv::ml::TrainData::create(features, cv::ml::ROW_SAMPLE, labels);
}

cv::Ptr<cv::ml::RTrees> grow_trees(const cv::Ptr<cv::ml::TrainData>& data,
                                   const ForestOptions& options, std::uint64_t seed) {
  const auto trees = cv::ml::RTrees::create();
  trees->setMaxDepth(options.depth);
  trees->setMinSampleCount(options.min_samples);
  trees->setCalculateVarImportance(false);
  trees->setTermCriteria({cv::TermCriteria::MAX_ITER, kForestTreesPerBlock, 0});
  // OpenCV draws from the generator of the calling thread.
  cv::theRNG().state = seed;
  trees->train(data);
  return trees;
}

void check(const ForestSamples& samples) {
  std::vector<int> counts(static_cast<std::size_t>(std::max(samples.label_count, 0)));
  for (const std::int32_t label : samples.labels) ++counts.at(static_cast<std::size_t>(label));
  if (samples.label_count < 2 || std::ranges::count(counts, 0) > 0 ||
      samples.features.size() !=
          static_cast<std::size_t>(samples.count()) * samples.feature_count) {
    throw InvalidInput(fmt::format(
        "a forest needs samples of at least two labels, but got {} samples of {} labels",
        samples.count(), samples.label_count));
  }
}

}  // namespace

class Forest::Trainer {
 public:
  /// Of the blocks from `first` on.
  Trainer(const ForestSamples& samples, const ForestOptions& options, int first)
      : samples_(samples), options_(options), first_(first), of_label_(samples_by_label(samples)) {
    const int blocks = (options.trees + kForestTreesPerBlock - 1) / kForestTreesPerBlock;
    trees_.resize(static_cast<std::size_t>(std::max(blocks - first, 0)) * kForestTreesPerBlock);
  }

  void grow_block(int item) {
    const int block = first_ + item;
    std::mt19937 random(static_cast<unsigned>(options_.seed) * 7919U +
                        static_cast<unsigned>(block));
    const auto data = draw(samples_, of_label_, options_.samples_per_label, block % 2 == 0, random);
    const auto trees =
        grow_trees(data, options_, (static_cast<std::uint64_t>(random()) << 32) | 1U);
    const std::vector<int>& roots = trees->getRoots();
    for (int i = 0; i < kForestTreesPerBlock; ++i) {
      trees_[static_cast<std::size_t>(item) * kForestTreesPerBlock + i] =
          flatten_tree(*trees, roots[static_cast<std::size_t>(i)]);
    }
  }

  [[nodiscard]] int blocks() const {
    return static_cast<int>(trees_.size()) / kForestTreesPerBlock;
  }

  void join(Forest& forest) const {
    int leaf_count = static_cast<int>(forest.votes_.size()) / forest.pitch_;
    for (const FlatTree& tree : trees_) {
      forest.roots_.push_back(static_cast<int>(forest.nodes_.size()));
      forest.nodes_.insert(forest.nodes_.end(), tree.nodes.begin(), tree.nodes.end());
      for (const int leaf : tree.leaves)
        forest.leaves_.push_back(leaf < 0 ? -1 : leaf + leaf_count);
      leaf_count += tree.leaf_count;
    }
    forest.votes_.resize(static_cast<std::size_t>(leaf_count) * forest.pitch_, 0.F);
  }

  /// Passes all samples down a tree.
  void count_votes(Forest& forest, int tree) const {
    const int end = tree + 1 < forest.tree_count()
                        ? forest.roots_[static_cast<std::size_t>(tree) + 1]
                        : static_cast<int>(forest.nodes_.size());
    for (int i = 0; i < samples_.count(); ++i) {
      const float* sample =
          samples_.features.data() + static_cast<std::ptrdiff_t>(i) * samples_.feature_count;
      const std::int32_t label = samples_.labels[static_cast<std::size_t>(i)];
      forest
          .votes_[static_cast<std::size_t>(forest.leaf_of(sample, tree)) * forest.pitch_ + label] +=
          1.0F / static_cast<float>(of_label_[static_cast<std::size_t>(label)].size());
    }
    for (int node = forest.roots_[static_cast<std::size_t>(tree)]; node < end; ++node) {
      const int leaf = forest.leaves_[static_cast<std::size_t>(node)];
      if (leaf >= 0) forest.normalize(leaf);
    }
  }

 private:
  const ForestSamples& samples_;
  const ForestOptions& options_;
  int first_;
  std::vector<std::vector<int>> of_label_;
  std::vector<FlatTree> trees_;
};

Forest Forest::train(const ForestSamples& samples, const ForestOptions& options,
                     const Progress& progress) {
  check(samples);
  Forest forest;
  forest.feature_count_ = samples.feature_count;
  forest.label_count_ = samples.label_count;
  forest.pitch_ = round_up(samples.label_count, kVectorLanes);
  forest.grow(samples, options, progress);
  return forest;
}

void Forest::grow(const ForestSamples& samples, const ForestOptions& options,
                  const Progress& progress) {
  const int before = tree_count();
  Trainer trainer(samples, options, before / kForestTreesPerBlock);
  parallel_for(trainer.blocks(), progress.part(0, 0.9),
               [&](int block) { trainer.grow_block(block); });
  Forest grown = *this;
  trainer.join(grown);
  parallel_for(grown.tree_count() - before, progress.part(0.9, 1),
               [&](int tree) { trainer.count_votes(grown, before + tree); });
  *this = std::move(grown);
}

void Forest::normalize(int leaf) {
  float* votes = votes_.data() + static_cast<std::ptrdiff_t>(leaf) * pitch_;
  float sum = 0;
  for (int l = 0; l < label_count_; ++l) sum += votes[l];
  // A leaf that no sample reaches knows nothing.
  const float even = 1.0F / static_cast<float>(label_count_);
  for (int l = 0; l < label_count_; ++l) votes[l] = sum > 0 ? votes[l] / sum : even;
}

int Forest::leaf_of(const float* sample, int tree) const {
  const ForestNode* nodes = nodes_.data() + roots_[static_cast<std::size_t>(tree)];
  int at = 0;
  for (;;) {
    const ForestNode& node = nodes[at];
    const int next = node.next + (sample[node.feature] > node.threshold ? 1 : 0);
    if (next == at)
      return leaves_[static_cast<std::size_t>(roots_[static_cast<std::size_t>(tree)] + at)];
    at = next;
  }
}

FlatForest Forest::flat() const {
  FlatForest flat;
  flat.nodes = nodes_.data();
  flat.roots = roots_.data();
  flat.votes_of = leaves_.data();
  flat.votes = votes_.data();
  flat.tree_count = tree_count();
  flat.node_count = static_cast<int>(nodes_.size());
  flat.leaf_count = static_cast<int>(votes_.size()) / pitch_;
  flat.pitch = pitch_;
  return flat;
}

void Forest::predict_rows(VolumeView<const float> features, Rows rows, float* out, Isa isa) const {
  const ForestKernel& kernel = EPISCOPE_CHOOSE_KERNEL(isa, kForestKernel);
  const FlatForest trees = flat();
  // A block's features together fit the first-level cache.
  std::vector<float> block(static_cast<std::size_t>(feature_count_) * kForestBlock);
  std::vector<float> sums(static_cast<std::size_t>(pitch_) * kForestBlock);
  const float scale = 1.0F / static_cast<float>(tree_count());
  for (int x = 0; x < features.width;) {
    const int columns = std::min(kForestBlock / rows.count, features.width - x);
    for (int f = 0; f < feature_count_; ++f) {
      for (int y = 0; y < rows.count; ++y) {
        std::copy_n(features.row(rows.first + y, f) + x, columns,
                    block.data() + f * kForestBlock + y * columns);
      }
    }
    kernel.vote(trees, block.data(), kForestBlock, columns * rows.count, sums.data());
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(columns) * pitch_;
    for (int y = 0; y < rows.count; ++y) {
      const float* const sum = sums.data() + y * size;
      std::transform(sum, sum + size,
                     out + (static_cast<std::ptrdiff_t>(y) * features.width + x) * pitch_,
                     [scale](float votes) { return votes * scale; });
    }
    x += columns;
  }
}

FlatTree flatten_tree(const cv::ml::RTrees& trees, int root) {
  const auto& nodes = trees.getNodes();
  const auto& splits = trees.getSplits();
  FlatTree flat;
  flat.origins.push_back(root);
  for (std::size_t i = 0; i < flat.origins.size(); ++i) {
    const auto& node = nodes[static_cast<std::size_t>(flat.origins[i])];
    if (node.split < 0) {
      flat.nodes.push_back(
          {std::numeric_limits<float>::infinity(), 0, static_cast<unsigned short>(i)});
      flat.leaves.push_back(flat.leaf_count++);
      continue;
    }
    const auto& split = splits[static_cast<std::size_t>(node.split)];
    flat.nodes.push_back({split.c, static_cast<unsigned short>(split.varIdx),
                          static_cast<unsigned short>(flat.origins.size())});
    flat.leaves.push_back(-1);
    flat.origins.push_back(node.left);
    flat.origins.push_back(node.right);
  }
  return flat;
}

const Forest& GrownForest::train(ForestSamples samples, const ForestOptions& options, int enough,
                                 const Progress& progress) {
  if (samples != samples_ || options != options_) {
    progress.step(kTrainingStep);
    ForestOptions first = options;
    first.trees = std::min(enough, options.trees);
    forest_ = Forest::train(samples, first, progress);
    samples_ = std::move(samples);
    options_ = options;
  }
  return forest_;
}

bool GrownForest::complete(const Progress& progress) {
  if (forest_.tree_count() >= options_.trees) return false;
  progress.step(kTrainingStep);
  forest_.grow(samples_, options_, progress);
  return true;
}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features)
    : height_(features.height),
      width_(features.width),
      label_count_(forest.label_count()),
      pitch_(forest.pitch()),
      votes_(make_large<float>(static_cast<std::size_t>(height_ * row_size()))) {}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features,
                       const Progress& progress)
    : PixelVotes(forest, features) {
  parallel_for((height_ + kForestRows - 1) / kForestRows, progress, [&](int band) {
    const int first = band * kForestRows;
    forest.predict_rows(features, {first, std::min(kForestRows, height_ - first)},
                        votes_.get() + first * row_size());
  });
}

PixelVotes::PixelVotes(const Forest& forest, VolumeView<const float> features,
                       const cuda::DeviceForest& device, const Progress& progress)
    : PixelVotes(forest, features) {
  device.vote(features, progress, votes_.get());
}

}  // namespace episcope
