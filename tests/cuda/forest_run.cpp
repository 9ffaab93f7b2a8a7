// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/labeling/solve_views.h"
#include "tests/cuda/label_runs.h"

#include <cstring>
#include <limits>
#include <memory>
#include <random>

namespace episcope::cuda_tests {
namespace {

constexpr int kTrees = 96, kDepth = 14, kFeatures = 24, kLabels = 13, kPitch = 16;
constexpr double kSplits = 0.78;  // Of the nodes: some hundred leaves a tree.

// What FlatForest borrows.
struct Trees {
  std::vector<ForestNode> nodes;
  std::vector<int> roots, leaves;
  std::vector<float> votes;
  int leaf_count = 0;

  [[nodiscard]] FlatForest flat() const {
    return {nodes.data(), roots.data(), leaves.data(),
            votes.data(), kTrees,       static_cast<int>(nodes.size()),
            leaf_count,   kPitch};
  }
};

// Numbered breadth first, as flatten_tree does.
void grow_tree(std::mt19937& random, Trees& trees) {
  std::uniform_real_distribution<float> uniform;
  trees.roots.push_back(static_cast<int>(trees.nodes.size()));
  std::vector<int> depths{0};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const bool is_inner = depths[i] < 4 || (depths[i] < kDepth && uniform(random) < kSplits);
    if (is_inner) {
      trees.nodes.push_back({uniform(random), static_cast<unsigned short>(random() % kFeatures),
                             static_cast<unsigned short>(depths.size())});
      trees.leaves.push_back(-1);
      depths.insert(depths.end(), 2, depths[i] + 1);
      continue;
    }
    trees.nodes.push_back(
        {std::numeric_limits<float>::infinity(), 0, static_cast<unsigned short>(i)});
    trees.leaves.push_back(trees.leaf_count++);
    float sum = 0;
    float votes[kPitch] = {};
    for (int l = 0; l < kLabels; ++l) sum += votes[l] = uniform(random);
    for (const float vote : votes) trees.votes.push_back(vote / sum);
  }
}

Volume<float> random_features(int size) {
  Volume<float> features(size, kFeatures, size);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  const VolumeView<float> all = features.view();
  std::generate(all.data, all.data + all.size(), [&] { return uniform(random); });
  return features;
}

void vote_on_cpu(const FlatForest& forest, VolumeView<const float> features, float* votes) {
  const ForestKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kForestKernel);
  std::vector<float> block(kFeatures * kForestBlock);
  for (int y = 0; y < features.height; ++y) {
    for (int x = 0; x < features.width; x += kForestBlock) {
      const int count = std::min(kForestBlock, features.width - x);
      for (int f = 0; f < kFeatures; ++f) {
        std::copy_n(features.row(y, f) + x, count, block.data() + f * kForestBlock);
      }
      float* const sums = votes + (static_cast<std::ptrdiff_t>(y) * features.width + x) * kPitch;
      kernel.vote(forest, block.data(), kForestBlock, count, sums);
      std::transform(sums, sums + count * kPitch, sums,
                     [](float sum) { return sum * (1.0F / kTrees); });
    }
  }
}

}  // namespace

LabelRun forest_run(int size, int views) {
  const auto trees = std::make_shared<Trees>();
  std::mt19937 random(1);
  for (int tree = 0; tree < kTrees; ++tree) grow_tree(random, *trees);
  const auto features = std::make_shared<const Volume<float>>(random_features(size));
  LabelRun forest;
  forest.title = "labels forest, 13 labels";
  forest.run = [trees, features, size, views](Device device) {
    const auto on_device =
        device == Device::Cuda ? copy_to_device(trees->flat(), Progress()) : nullptr;
    std::vector<std::uint8_t> bytes;
    // As in the labeler, a view each thread.
    parallel_for(views, Progress(), [&](int view) {
      std::vector<float> votes(static_cast<std::size_t>(size) * size * kPitch);
      if (on_device) {
        on_device->vote(features->view(), Progress(1), votes.data());
      } else {
        vote_on_cpu(trees->flat(), features->view(), votes.data());
      }
      if (view > 0) return;
      bytes.resize(votes.size() * sizeof(float));
      std::memcpy(bytes.data(), votes.data(), bytes.size());
    });
    return bytes;
  };
  return forest;
}

}  // namespace episcope::cuda_tests
