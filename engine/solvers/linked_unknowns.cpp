// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked_unknowns.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/pair_limits.h"
#include "engine/solvers/simplex_labeling.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

namespace {

// Images solved one after the other by one thread.
constexpr int kLongestChain = 9;
// The agreement of images changes more than what more iterations of one would.
constexpr int kMostIterations = 100;
constexpr double kLeastGap = 1e-2;

struct Chain {
  int begin = 0, end = 0;
};

std::vector<Chain> chains_of(const LinkedProblem& problem) {
  std::vector<Chain> chains;
  for (int i = 0; i < static_cast<int>(problem.images.size()); ++i) {
    const bool goes_on = !chains.empty() && problem.images[i - 1].links[0].to == i &&
                         i - chains.back().begin < kLongestChain;
    if (!goes_on) chains.push_back({i, i});
    chains.back().end = i + 1;
  }
  return chains;
}

// One thread's room to solve one image after the other.
class SingleImages {
 public:
  SingleImages(const LinkedProblem& problem, const LinkSources& sources,
               const LinkedOptions& options, LinkedUnknowns& unknowns)
      : problem_(problem),
        sources_(sources),
        options_(options),
        unknowns_(unknowns),
        kernel_(EPISCOPE_CHOOSE_KERNEL(options.isa, kLinkedKernel)),
        solver_(unknowns.height(), unknowns.row().layers, unknowns.row().width, options.isa),
        costs_(unknowns.height(), unknowns.row().layers, unknowns.row().width),
        labels_(unknowns.height(), unknowns.row().width) {}

  void solve(const Chain& chain, const Progress& progress) {
    for (int i = chain.begin; i < chain.end; ++i) {
      for (int y = 0; y < costs_.height(); ++y) {
        look_up_costs(problem_, kernel_, i, y, costs_.view().row(y, 0));
      }
      SimplexOptions options{kMostIterations, std::max(options_.gap, kLeastGap), 5, {}};
      if (i > chain.begin) options.from_last = sources_.pixels(i, 0);
      const SimplexProblem single{costs_.view(), problem_.images[i].g, problem_.smoothness};
      solver_.solve(single, options, progress, labels_.view());
      if (problem_.smoothness > 0) {
        take_unknowns(i);
      } else {
        take_labels(i);
      }
    }
  }

 private:
  void take_unknowns(int image) {
    LayeredSweep& solved = solver_.unknowns();
    const long size = unknowns_.row_size();
    for (int y = 0; y < unknowns_.height(); ++y) {
      kernel_.pack(solved.phi(y), size, LinkedUnknowns::kUnit, unknowns_.u(image, y));
      kernel_.pack(solved.duals(y).pair[0], kPairKinds * size, unknowns_.pair_unit(),
                   unknowns_.pairs(image, y));
    }
  }

  void take_labels(int image) {
    for (int y = 0; y < unknowns_.height(); ++y) {
      for (int x = 0; x < unknowns_.row().width; ++x) {
        unknowns_.u(image, y)[labels_.at(y, x) * unknowns_.row().pitch + x] =
            static_cast<std::int16_t>(1 / LinkedUnknowns::kUnit);
      }
    }
  }

  const LinkedProblem& problem_;
  const LinkSources& sources_;
  const LinkedOptions& options_;
  LinkedUnknowns& unknowns_;
  const LinkedKernel& kernel_;
  SimplexSolver solver_;
  Volume<float> costs_;
  Image<int> labels_;
};

}  // namespace

void look_up_costs(const LinkedProblem& problem, const LinkedKernel& kernel, int image, int y,
                   float* cost) {
  const auto& codes = problem.images[image].codes;
  kernel.look_up(codes.row(y, 0), problem.table.data(),
                 static_cast<long>(codes.layers) * codes.width, cost);
}

void start_from_single_images(const LinkedProblem& problem, const LinkSources& sources,
                              const LinkedOptions& options, const Progress& progress,
                              LinkedUnknowns& unknowns) {
  const std::vector<Chain> chains = chains_of(problem);
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(chains.size()), progress, [&] {
    return [&, images = SingleImages(problem, sources, options, unknowns)](int k) mutable {
      images.solve(chains[k], alone);
    };
  });
}

namespace {

constexpr float kUnlimited = 1e30F;

// How far duals move grows with their limits, but more slowly: where these are large, the costs
// bound them.
double dual_size(double limit) {
  return std::min(limit, std::sqrt(limit));
}

}  // namespace

LinkedRows::LinkedRows(const LinkedSetting& setting, LinkedUnknowns& unknowns)
    : setting_(setting),
      unknowns_(unknowns),
      kernel_(EPISCOPE_CHOOSE_KERNEL(setting.isa, kLinkedKernel)),
      simplex_(EPISCOPE_CHOOSE_KERNEL(setting.isa, kSimplexKernel)) {
  const LinkedRow& row = unknowns.row();
  shape_.steps = row.layers;
  shape_.width = row.width;
  shape_.pitch = row.pitch;
  // A pixel is in 8 pairs and 4 links, so that steps may have 2·(8·pair + 4·link)·primal = 1.
  const double size = dual_size(std::max(setting.problem.smoothness, setting.problem.coherence));
  shape_.primal_step = static_cast<float>(1 / (2 * size));
  shape_.dual_step = static_cast<float>(size / 12);
  shape_.relaxation = kOverRelaxation;
  link_step_ = shape_.dual_step;
  const std::size_t size_of_row = unknowns.row_size();
  for (auto& each : pairs_) each.assign(kPairKinds * size_of_row + 2 * kLayerRowUnit, 0.0F);
  for (auto* each : {&ahead_[0], &ahead_[1], &u_, &nothing_}) {
    each->assign(size_of_row + 2 * kLayerRowUnit, 0.0F);
  }
  cost_.resize(size_of_row);
  limit_.resize(row.pitch);
  places_.resize(row.pitch);
}

PairDuals LinkedRows::pairs(int image, int y) {
  PairDuals row;
  for (int k = 0; k < kPairKinds; ++k) {
    row.pair[k] =
        y < 0 ? nothing_.data() + kLayerRowUnit
              : pairs_[y & 1].data() + kLayerRowUnit + static_cast<long>(k) * unknowns_.row_size();
    row.limit[k] = y < 0 ? nothing_.data() + kLayerRowUnit : setting_.limits[image].row(y, k);
  }
  return row;
}

float* LinkedRows::ahead(int y) {
  return ahead_[y & 1].data() + kLayerRowUnit;
}

void LinkedRows::load_pairs(int image, int y) {
  kernel_.unpack({unknowns_.pairs(image, y), unknowns_.pair_unit()},
                 kPairKinds * unknowns_.row_size(), pairs(image, y).pair[0]);
}

// Limits of the links that leave row y, and where they end.
void LinkedRows::find_leaving(const ImageLinks& links, int y, bool is_limited) {
  const int width = shape_.width;
  const std::int32_t* const target = links.target.row(y);
  const float half = static_cast<float>(setting_.problem.coherence / 2);
  for (int x = 0; x < width; ++x) {
    const std::int32_t at = std::max(target[x], 0);
    places_[x] = at / width * unknowns_.stride() + at % width;
    limit_[x] = target[x] < 0 ? 0 : is_limited ? half * link_weight(links, y, x) : kUnlimited;
  }
}

// Likewise of the links that arrive, and where they come from.
void LinkedRows::find_arriving(int image, int kind, int y, bool is_limited) {
  const int width = shape_.width;
  const ImageLinks& links = setting_.problem.images[setting_.sources.from(image, kind)].links[kind];
  const std::int32_t* const source = setting_.sources.pixels(image, kind).row(y);
  const float half = static_cast<float>(setting_.problem.coherence / 2);
  for (int x = 0; x < width; ++x) {
    const std::int32_t at = std::max(source[x], 0);
    const int from_y = at / width, from_x = at % width;
    places_[x] = from_y * unknowns_.stride() + from_x;
    limit_[x] = source[x] < 0 ? 0
                : is_limited  ? half * link_weight(links, from_y, from_x)
                              : kUnlimited;
  }
}

// Costs less what flows along the links.
void LinkedRows::fill_costs(int image, int y, bool is_limited) {
  look_up_costs(setting_.problem, kernel_, image, y, cost_.data());
  if (setting_.problem.coherence == 0) return;
  const LinkedRow& row = unknowns_.row();
  for (int kind = 0; kind < kLinkKinds; ++kind) {
    const ImageLinks& links = setting_.problem.images[image].links[kind];
    if (links.to >= 0) {
      find_leaving(links, y, is_limited);
      kernel_.leave(row, {unknowns_.links(image, kind, y), unknowns_.link_unit()}, limit_.data(),
                    cost_.data());
    }
    const int from = setting_.sources.from(image, kind);
    if (from >= 0) {
      find_arriving(image, kind, y, is_limited);
      kernel_.arrive(row, {unknowns_.links(from, kind, 0), unknowns_.link_unit()}, places_.data(),
                     limit_.data(), cost_.data());
    }
  }
}

void LinkedRows::move_pairs(int image, int y, const float* ahead_below) {
  simplex_.move_dual(shape_, ahead(y), ahead_below, pairs(image, y));
  kernel_.pack(pairs(image, y).pair[0], kPairKinds * unknowns_.row_size(), unknowns_.pair_unit(),
               unknowns_.pairs(image, y));
}

// A row of u needs the old duals of its own and of the row above, a row of duals the new u of its
// own and of the row below.
void LinkedRows::sweep(int image) {
  const long size = unknowns_.row_size();
  float* const u = u_.data() + kLayerRowUnit;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    load_pairs(image, y);
    fill_costs(image, y, false);
    kernel_.unpack({unknowns_.u(image, y), LinkedUnknowns::kUnit}, size, u);
    simplex_.move_primal(shape_, cost_.data(), pairs(image, y), pairs(image, y - 1), u, ahead(y));
    kernel_.pack(u, size, LinkedUnknowns::kUnit, unknowns_.u(image, y));
    kernel_.pack(ahead(y), size, LinkedUnknowns::kUnit, unknowns_.ahead(image, y));
    if (y > 0) move_pairs(image, y - 1, ahead(y));
  }
  const int last = unknowns_.height() - 1;
  move_pairs(image, last, ahead(last));
}

void LinkedRows::move_links(int image) {
  if (setting_.problem.coherence == 0) return;
  for (int kind = 0; kind < kLinkKinds; ++kind) {
    const ImageLinks& links = setting_.problem.images[image].links[kind];
    if (links.to < 0) continue;
    for (int y = 0; y < unknowns_.height(); ++y) {
      setting_.progress.check();
      find_leaving(links, y, true);
      kernel_.move(unknowns_.row(), {unknowns_.ahead(image, y), LinkedUnknowns::kUnit},
                   {unknowns_.ahead(links.to, 0), LinkedUnknowns::kUnit}, places_.data(),
                   {link_step_, kOverRelaxation, limit_.data()}, unknowns_.link_unit(),
                   unknowns_.links(image, kind, y));
    }
  }
}

double LinkedRows::bound(int image) {
  double sum = 0;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    load_pairs(image, y);
    fill_costs(image, y, true);
    sum += simplex_.bound(shape_, cost_.data(), pairs(image, y), pairs(image, y - 1));
  }
  return sum;
}

void LinkedRows::round(int image, ImageView<int> labels) {
  float* const u = u_.data() + kLayerRowUnit;
  for (int y = 0; y < unknowns_.height(); ++y) {
    setting_.progress.check();
    kernel_.unpack({unknowns_.u(image, y), LinkedUnknowns::kUnit}, unknowns_.row_size(), u);
    simplex_.cut(shape_, u, labels.row(y));
  }
}

}  // namespace episcope
