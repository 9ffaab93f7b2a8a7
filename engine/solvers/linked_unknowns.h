// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/solvers/layered_kernel.h"
#include "engine/solvers/linked_kernel.h"
#include "engine/solvers/linked_labeling.h"
#include "engine/solvers/pair_limits.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// The links of a problem the other way round: which pixel of which image each one comes from.
class LinkSources {
 public:
  /// Throws InvalidInput if links do not fit the images, or two of one kind end in one pixel.
  LinkSources(const LinkedProblem& problem, const Progress& progress);

  /// The image from which links of this kind arrive in `image`; −1 = none.
  [[nodiscard]] int from(int image, int kind) const { return of(image, kind).from; }
  /// `[y][x]`: the pixel there, −1 = none. Precondition: from(image, kind) ≥ 0.
  [[nodiscard]] ImageView<const std::int32_t> pixels(int image, int kind) const {
    return of(image, kind).pixels;
  }

 private:
  struct Arriving {
    int from = -1;
    Image<std::int32_t> pixels;
  };
  void turn(const LinkedProblem& problem, int image, int kind);
  [[nodiscard]] const Arriving& of(int image, int kind) const {
    return arriving_[static_cast<std::size_t>(image)][static_cast<std::size_t>(kind)];
  }

  std::vector<std::array<Arriving, kLinkKinds>> arriving_;
};

/// u, 2u' − u, and the duals of pairs and links of all images, in 16 bits. Rows are `[label][x]`,
/// `pitch` apart; beyond the width everything stays 0.
class LinkedUnknowns {
 public:
  /// Everything 0. In the units of the problem: u in ±4, duals up to twice their limits. Throws
  /// Cancelled.
  LinkedUnknowns(const LinkedProblem& problem, const Progress& progress);

  [[nodiscard]] const LinkedRow& row() const { return row_; }
  [[nodiscard]] long row_size() const { return row_.layers * row_.pitch; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] std::int16_t* u(int image, int y) { return at(image, y); }
  [[nodiscard]] std::int16_t* ahead(int image, int y) { return at(image, y) + row_size(); }
  /// Duals of the pairs that begin in row y, `[pair][label][x]`.
  [[nodiscard]] std::int16_t* pairs(int image, int y) { return at(image, y) + 2 * row_size(); }
  /// Duals of the links of one kind that begin in row y.
  [[nodiscard]] std::int16_t* links(int image, int kind, int y) {
    return at(image, y) + (2 + kPairKinds + kind) * row_size();
  }
  /// From a row of one image to the same unknowns of the next row.
  [[nodiscard]] long stride() const { return (2 + kPairKinds + kLinkKinds) * row_size(); }

  static constexpr float kUnit = 1.0F / 8192;  ///< Of u and 2u' − u.
  [[nodiscard]] float pair_unit() const { return pair_unit_; }
  [[nodiscard]] float link_unit() const { return link_unit_; }

 private:
  [[nodiscard]] std::int16_t* at(int image, int y) {
    return memory_[static_cast<std::size_t>(image)].get() + y * stride();
  }

  LinkedRow row_;
  int height_ = 0;
  float pair_unit_ = 1, link_unit_ = 1;
  std::vector<LargeArray<std::int16_t>> memory_;
};

/// Initializes u and the duals of pairs with the solutions of the images alone, to a gap of 1 %
/// or to the gap of the options if that is wider. Images that are linked one to the next are solved
/// in this order, each beginning where the last one ended. Without smoothness u chooses the
/// cheapest labels. Throws Cancelled.
void start_from_single_images(const LinkedProblem& problem, const LinkSources& sources,
                              const LinkedOptions& options, const Progress& progress,
                              LinkedUnknowns& unknowns);

/// Row y of the costs of an image, `[label][x]`.
void look_up_costs(const LinkedProblem& problem, const LinkedKernel& kernel, int image, int y,
                   float* cost);

/// Weight of a link in [0, 1].
[[nodiscard]] inline float link_weight(const ImageLinks& links, int y, int x) {
  return links.weight.empty() ? 1.0F : static_cast<float>(links.weight.at(y, x)) / 255;
}

/// Constants while a problem is solved; borrowed.
struct LinkedSetting {
  const LinkedProblem& problem;
  const LinkSources& sources;
  const std::vector<PairLimits>& limits;  ///< Of each image.
  Isa isa;
  const Progress& progress;
};

/// One thread's work on the rows of an image: unknowns are unpacked into its own memory, moved, and
/// packed again. All throw Cancelled.
class LinkedRows {
 public:
  LinkedRows(const LinkedSetting& setting, LinkedUnknowns& unknowns);

  /// Moves u and the duals of pairs of an image by one iteration.
  void sweep(int image);
  /// Moves the duals of the links that leave an image, after all images were swept.
  void move_links(int image);
  /// The part of the lower bound that belongs to an image.
  [[nodiscard]] double bound(int image);
  /// The largest u of each pixel; of equals the lowest label.
  void round(int image, ImageView<int> labels);

 private:
  [[nodiscard]] PairDuals pairs(int image, int y);
  [[nodiscard]] float* ahead(int y);
  void load_pairs(int image, int y);
  void fill_costs(int image, int y, bool is_limited);
  void find_leaving(const ImageLinks& links, int y, bool is_limited);
  void find_arriving(int image, int kind, int y, bool is_limited);
  void move_pairs(int image, int y, const float* ahead_below);

  LinkedSetting setting_;
  LinkedUnknowns& unknowns_;
  const LinkedKernel& kernel_;
  const SimplexKernel& simplex_;
  LayeredShape shape_;
  float link_step_ = 1;
  std::vector<float> pairs_[2], ahead_[2];  // of the last two rows
  std::vector<float> nothing_, u_, cost_, limit_;
  std::vector<long> places_;
};

}  // namespace episcope
