// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked/link_sources.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope {
namespace {

void check_links(const ImageLinks& links, int image, int images, int height, int width) {
  const auto has_size = [&](const auto& map) {
    return map.height == height && map.width == width && map.channels == 1;
  };
  if (links.to >= 0 && links.to < images && links.to != image && has_size(links.target) &&
      (links.weight.empty() || has_size(links.weight))) {
    return;
  }
  throw InvalidInput("links between images must lead to another image and have its size");
}

}  // namespace

LinkSources::LinkSources(const LinkedProblem& problem, const Progress& progress) {
  const int images = static_cast<int>(problem.images.size());
  const auto& codes = problem.images[0].codes;
  arriving_.resize(problem.images.size());
  for (int i = 0; i < images; ++i) {
    for (int kind = 0; kind < kLinkKinds; ++kind) {
      const ImageLinks& links = problem.images[i].links[kind];
      if (links.to < 0) continue;
      check_links(links, i, images, codes.height, codes.width);
      Arriving& there = arriving_[links.to][kind];
      if (there.from >= 0) {
        throw InvalidInput("links of one kind from two images must not lead to the same image");
      }
      there.from = i;
    }
  }
  parallel_for(images, progress, [&](int i) {
    for (int kind = 0; kind < kLinkKinds; ++kind) turn(problem, i, kind);
  });
}

void LinkSources::turn(const LinkedProblem& problem, int image, int kind) {
  Arriving& here = arriving_[image][kind];
  if (here.from < 0) return;
  const ImageView<const std::int32_t> target = problem.images[here.from].links[kind].target;
  here.pixels = Image<std::int32_t>(target.height, target.width);
  std::fill(here.pixels.begin(), here.pixels.end(), -1);
  const int count = target.height * target.width;
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; ++x) {
      const std::int32_t at = target.at(y, x);
      if (at < 0) continue;
      if (at >= count || here.pixels.data()[at] >= 0) {
        throw InvalidInput("links of one kind must end in different pixels of the other image");
      }
      here.pixels.data()[at] = y * target.width + x;
    }
  }
}

}  // namespace episcope
