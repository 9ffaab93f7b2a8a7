// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/cuda/ray_labels.h"
#include "engine/labeling/forest_kernel.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Examples to learn from: rows of features with the index of their label.
struct ForestSamples {
  int feature_count = 0;
  int label_count = 0;
  std::vector<float> features;       ///< `[sample][feature]`
  std::vector<std::int32_t> labels;  ///< `[sample]` in [0, label_count).
  /// Features that every other block of trees ignores: they separate painted pixels so well that
  /// trees would use nothing else.
  std::vector<int> occasional{};

  [[nodiscard]] int count() const { return static_cast<int>(labels.size()); }
  friend bool operator==(const ForestSamples&, const ForestSamples&) = default;
};

struct ForestOptions {
  int trees = 96;               ///< Rounded up to whole blocks of kForestTreesPerBlock.
  int depth = 14;               ///< Largest depth of a tree.
  int min_samples = 12;         ///< A node of fewer is not split.
  int samples_per_label = 250;  ///< Drawn for each block of trees, with replacement.
  int seed = 1;

  friend bool operator==(const ForestOptions&, const ForestOptions&) = default;
};

inline constexpr int kForestRows = 8;

/// Trees that are trained one after the other on the same draw of samples.
inline constexpr int kForestTreesPerBlock = 4;

/// A random forest that votes for labels by the shares of labels in the leaves ("soft votes").
/// Trained by OpenCV's RTrees (Gini impurity, √F features tried at each split), in blocks of trees
/// that run in parallel, each on its own seeded draw with as many samples of each label; so the
/// result depends on the seed and not on the number of threads. The trees are then flattened, and
/// all samples are led down them: a leaf's vote for a label is the share of the label's samples
/// that arrive there, normalized over labels.
/// Source: Breiman 2001 [Bre01]; probabilities as in Wanner, Straehle, Goldluecke 2013 [WSG13].
class Forest {
 public:
  /// Throws InvalidInput unless there are two labels at least, each with a sample; Cancelled.
  [[nodiscard]] static Forest train(const ForestSamples& samples, const ForestOptions& options,
                                    const Progress& progress);

  /// Trains the trees that are missing to `options.trees`. With unchanged samples and other
  /// options, the result equals one call of `train`. Throws Cancelled, and leaves the forest
  /// unchanged.
  void grow(const ForestSamples& samples, const ForestOptions& options, const Progress& progress);

  [[nodiscard]] int label_count() const { return label_count_; }
  [[nodiscard]] int feature_count() const { return feature_count_; }
  [[nodiscard]] int tree_count() const { return static_cast<int>(roots_.size()); }

  /// Rows of an image that are predicted together, kForestRows at most: blocks of several are
  /// faster, because their pixels are more alike.
  struct Rows {
    int first = 0, count = 1;
  };
  /// Probabilities of the pixels of these rows of `features`, `[y][x][label]`, `pitch()` apart,
  /// into `out` of count·width·pitch() floats. The lanes beyond the labels become 0. Needs
  /// features.layers == feature_count(). The result does not depend on how rows are put together.
  void predict_rows(VolumeView<const float> features, Rows rows, float* out,
                    Isa isa = best_isa()) const;
  /// Floats of a pixel in `predict_rows`: labels rounded up to whole vectors.
  [[nodiscard]] int pitch() const { return pitch_; }

  /// All trees as kernels walk them; borrowed.
  [[nodiscard]] FlatForest flat() const;

  /// The leaf that a sample reaches in a tree, counted over all trees; for tests.
  [[nodiscard]] int leaf_of(const float* sample, int tree) const;

 private:
  class Trainer;
  void normalize(int leaf);

  int feature_count_ = 0;
  int label_count_ = 0;
  int pitch_ = 0;
  std::vector<ForestNode> nodes_;
  std::vector<int> roots_;
  std::vector<int> leaves_;   // Row of votes for each node; -1 for inner ones.
  std::vector<float> votes_;  // [leaf][label], pitch_ apart.
};

}  // namespace episcope

namespace cv::ml {
class RTrees;
}

namespace episcope {

/// A tree of OpenCV in the form that the kernel walks, numbered breadth first: the children of a
/// node are neighbors, so that one number leads to both.
struct FlatTree {
  std::vector<ForestNode> nodes;
  std::vector<int> leaves;   ///< Number of the leaf at each node, -1 for inner ones.
  std::vector<int> origins;  ///< OpenCV's number of each node.
  int leaf_count = 0;
};

/// The tree of ordered features that begins at node `root`. A tree of at most 65535 nodes.
[[nodiscard]] FlatTree flatten_tree(const cv::ml::RTrees& trees, int root);

/// A forest and its samples, kept while training would give the same forest.
class GrownForest {
 public:
  /// As reported by `progress` while trees are trained.
  static constexpr const char* kTrainingStep = "training the forest";

  /// The forest for these samples, trained only if it would differ from the last one: `enough`
  /// trees of it at least. Valid until the next call. Throws as Forest::train.
  const Forest& train(ForestSamples samples, const ForestOptions& options, int enough,
                      const Progress& progress);
  /// Trains the missing trees. Returns whether there were any. Throws Cancelled.
  bool complete(const Progress& progress);

 private:
  ForestSamples samples_;
  ForestOptions options_;
  Forest forest_;
};

/// The votes of a forest for all pixels of one view, counted here or on the GPU, with the same
/// bits. 4·pitch bytes per pixel.
class PixelVotes {
 public:
  /// `features` `[y][feature][x]` as the forest was trained on. Throws Cancelled.
  PixelVotes(const Forest& forest, VolumeView<const float> features, const Progress& progress);
  /// On the GPU. Throws DeviceFailure, Cancelled.
  PixelVotes(const Forest& forest, VolumeView<const float> features,
             const cuda::DeviceForest& device, const Progress& progress);

  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int label_count() const { return label_count_; }
  /// Floats of a pixel in a row.
  [[nodiscard]] int pitch() const { return pitch_; }
  /// Votes of row `y`, `[x][label]`, `pitch()` apart, as Forest::predict_rows.
  [[nodiscard]] const float* row(int y) const { return votes_.get() + y * row_size(); }
  [[nodiscard]] std::ptrdiff_t row_size() const {
    return static_cast<std::ptrdiff_t>(width_) * pitch_;
  }

 private:
  PixelVotes(const Forest& forest, VolumeView<const float> features);

  int height_, width_, label_count_, pitch_;
  LargeArray<float> votes_;
};

}  // namespace episcope
