// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/solvers/linked/linked_labeling.h"

#include <array>
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

}  // namespace episcope
