// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked/linked_unknowns.h"

#include "engine/core/parallel/parallel.h"
#include "engine/solvers/simplex/pair_limits.h"

#include <algorithm>

namespace episcope {
namespace {

constexpr float kSteps = 32767;

float largest_weight(const LinkedProblem& problem) {
  float largest = 0;
  for (const LinkedImage& image : problem.images) {
    if (image.g.empty()) largest = std::max(largest, 1.0F);
    for (int y = 0; y < image.g.height; ++y) {
      largest =
          std::max(largest, *std::max_element(image.g.row(y), image.g.row(y) + image.g.width));
    }
  }
  return largest;
}

float unit_of(double twice_the_limit) {
  return twice_the_limit > 0 ? static_cast<float>(twice_the_limit) / kSteps : 1;
}

}  // namespace

LinkedUnknowns::LinkedUnknowns(const LinkedProblem& problem, const Progress& progress) {
  const auto& codes = problem.images[0].codes;
  row_ = {codes.layers, codes.width, layer_pitch(codes.width)};
  height_ = codes.height;
  pair_unit_ = unit_of(problem.smoothness * static_cast<double>(largest_weight(problem)));
  link_unit_ = unit_of(problem.coherence);
  const std::size_t size = static_cast<std::size_t>(height_) * stride() + kLayerRowUnit;
  memory_.resize(problem.images.size());
  parallel_for(static_cast<int>(problem.images.size()), progress, [&](int i) {
    memory_[i] = make_large<std::int16_t>(size);
    std::fill_n(memory_[i].get(), size, std::int16_t{0});
  });
}

}  // namespace episcope
