// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked_labeling.h"

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/solvers/layered_kernel.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/simplex_labeling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace episcope {

namespace {

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

/// Row y of the costs of an image, `[label][x]`.
void look_up_costs(const LinkedProblem& problem, const LinkedKernel& kernel, int image, int y,
                   float* cost) {
  const auto& codes = problem.images[image].codes;
  kernel.look_up(codes.row(y, 0), problem.table.data(),
                 static_cast<long>(codes.layers) * codes.width, cost);
}

/// Initializes u and the duals of pairs with the solutions of the images alone, to a gap of 1 %
/// or to the gap of the options if that is wider. Images that are linked one to the next are solved
/// in this order, each beginning where the last one ended. Without smoothness u chooses the
/// cheapest labels. Throws Cancelled.
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

constexpr float kUnlimited = 1e30F;

// How far duals move grows with their limits, but more slowly: where these are large, the costs
// bound them.
double dual_size(double limit) {
  return std::min(limit, std::sqrt(limit));
}

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

// The share of the work that solving the images alone takes.
constexpr double kStartShare = 0.3;

void check_problem(const LinkedProblem& problem) {
  if (problem.images.empty() || problem.images[0].codes.empty()) {
    throw InvalidInput("a labeling of several images needs costs of at least one");
  }
  const auto& first = problem.images[0].codes;
  for (const LinkedImage& image : problem.images) {
    const auto& codes = image.codes;
    if (codes.height != first.height || codes.width != first.width ||
        codes.layers != first.layers) {
      throw InvalidInput("images that are labeled together must have the same size and labels");
    }
    check_boundaries(image.g, problem.smoothness, codes.height, codes.width);
  }
  if (!(problem.coherence >= 0)) {
    throw InvalidInput("the coherence of a labeling must not be negative");
  }
}

template <class Labels>
void check_labels(const LinkedProblem& problem, const Labels& labels) {
  const auto& codes = problem.images[0].codes;
  const bool fit =
      labels.size() == problem.images.size() && std::ranges::all_of(labels, [&](const auto& each) {
        return each.height == codes.height && each.width == codes.width;
      });
  if (!fit)
    throw InvalidInput("there must be a label image of the size of the costs for each image");
}

std::vector<PairLimits> limits_of(const LinkedProblem& problem, const Progress& progress) {
  std::vector<PairLimits> limits;
  for (const LinkedImage& image : problem.images) {
    progress.check();
    limits.emplace_back(image.codes.height, image.codes.width, problem.smoothness / 2, image.g);
  }
  return limits;
}

// Of the costs and boundaries of one image and the links that leave it.
double image_energy(const LinkedProblem& problem, const PairLimits& limits,
                    const std::vector<ImageView<const int>>& labels, int i) {
  const LinkedImage& image = problem.images[i];
  const ImageView<const int> here = labels[i];
  double sum = 0;
  for (int y = 0; y < here.height; ++y) {
    sum += boundary_row_energy(limits, here, y, potts_jump);
    for (int x = 0; x < here.width; ++x) {
      sum += static_cast<double>(problem.table[image.codes.at(y, here.at(y, x), x)]);
    }
    for (const ImageLinks& links : image.links) {
      if (links.to < 0) continue;
      const ImageView<const int> there = labels[links.to];
      for (int x = 0; x < here.width; ++x) {
        const std::int32_t at = links.target.at(y, x);
        if (at < 0 || there.at(at / here.width, at % here.width) == here.at(y, x)) continue;
        sum += problem.coherence * link_weight(links, y, x);
      }
    }
  }
  return sum;
}

std::vector<ImageView<const int>> views_of(const std::vector<Image<int>>& images) {
  return {images.begin(), images.end()};
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// All images together.
class LinkedSolver {
 public:
  LinkedSolver(const LinkedProblem& problem, const LinkedOptions& options, const Progress& progress)
      : problem_(problem),
        options_(options),
        sources_(problem, progress.part(0, 0)),
        limits_(limits_of(problem, progress)),
        unknowns_(problem, progress.part(0, 0)),
        bounds_(problem.images.size()),
        energies_(problem.images.size()) {
    for (std::size_t i = 0; i < problem.images.size(); ++i) {
      rounded_.emplace_back(unknowns_.height(), unknowns_.row().width);
    }
  }

  void start(const Progress& progress) {
    start_from_single_images(problem_, sources_, options_, progress, unknowns_);
  }

  void iterate(const Progress& progress) {
    for_images(progress, [](LinkedRows& rows, int i) { rows.sweep(i); });
    for_images(progress, [](LinkedRows& rows, int i) { rows.move_links(i); });
  }

  // The labels of a look are kept if they are the best so far.
  void measure(const Progress& progress, LinkedResult& result,
               const std::vector<ImageView<int>>& labels) {
    for_images(progress, [this](LinkedRows& rows, int i) {
      bounds_[i] = rows.bound(i);
      rows.round(i, rounded_[i].view());
    });
    const auto rounded = views_of(rounded_);
    parallel_for(images(), progress,
                 [&](int i) { energies_[i] = image_energy(problem_, limits_[i], rounded, i); });
    result.bound = std::max(result.bound, sum_of(bounds_));
    const double energy = sum_of(energies_);
    if (energy >= result.energy) return;
    result.energy = energy;
    for (int i = 0; i < images(); ++i) {
      for (int y = 0; y < unknowns_.height(); ++y) {
        std::copy_n(rounded_[i].row(y), unknowns_.row().width, labels[i].row(y));
      }
    }
  }

 private:
  [[nodiscard]] int images() const { return static_cast<int>(problem_.images.size()); }

  template <class Work>
  void for_images(const Progress& progress, const Work& work) {
    parallel_for_workers(images(), progress, [&] {
      return [&, rows = LinkedRows({problem_, sources_, limits_, options_.isa, progress},
                                   unknowns_)](int i) mutable {
        const FlushDenormals flush;
        work(rows, i);
      };
    });
  }

  const LinkedProblem& problem_;
  const LinkedOptions& options_;
  LinkSources sources_;
  std::vector<PairLimits> limits_;
  LinkedUnknowns unknowns_;
  std::vector<Image<int>> rounded_;
  std::vector<double> bounds_, energies_;  // of each image
};

}  // namespace

double LinkedResult::relative_gap() const {
  return labeling_gap(energy, bound);
}

LinkedResult solve_linked_labeling(const LinkedProblem& problem, const LinkedOptions& options,
                                   const Progress& progress,
                                   const std::vector<ImageView<int>>& labels) {
  check_problem(problem);
  check_labels(problem, labels);
  LinkedSolver solver(problem, options, progress);
  solver.start(progress.part(0, kStartShare));
  LinkedResult result;
  result.energy = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  const int check_every = std::max(1, options.check_every);
  double done = kStartShare;
  for (bool last = false; !last;) {
    const Progress quiet = progress.part(done, done);
    solver.iterate(quiet);
    ++result.iterations;
    done = std::max(done, 1 - (1 - kStartShare) * std::exp2(-result.iterations / 40.0));
    progress.report(done);
    last = result.iterations >= options.max_iterations || progress.finish_requested();
    if (!last && result.iterations % check_every != 0) continue;
    solver.measure(quiet, result, labels);
    result.converged = result.relative_gap() <= options.gap;
    last = last || result.converged;
    progress.step(labeling_gap_text(result.relative_gap()));
  }
  progress.report(1);
  return result;
}

double linked_energy(const LinkedProblem& problem,
                     const std::vector<ImageView<const int>>& labels) {
  check_problem(problem);
  check_labels(problem, labels);
  const std::vector<PairLimits> limits = limits_of(problem, Progress());
  double sum = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    sum += image_energy(problem, limits[i], labels, static_cast<int>(i));
  }
  return sum;
}

}  // namespace episcope
