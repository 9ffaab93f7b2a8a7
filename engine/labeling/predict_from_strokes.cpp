// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"

#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/labeling/edge_probability.h"
#include "engine/labeling/feature_kernel.h"
#include "engine/labeling/forest_kernel.h"
#include "engine/labeling/pixel_features.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace episcope {
namespace {

constexpr int kSweeps = 3;
// Far beyond any way through an image, and finite, so that sums stay so.
constexpr float kFar = 1e9F;
constexpr float kColorsBesideDisparity = 0.5F;
constexpr float kJumpWeight = 5;
constexpr float kBehind = 1;

struct Way {
  int dx, dy;
};
constexpr Way kWays[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};

float step_length(Way way) {
  return StrokeDistances::kStep * std::sqrt(static_cast<float>(way.dx * way.dx + way.dy * way.dy));
}

std::int32_t index_of(const std::vector<std::int32_t>& ids, std::int32_t label) {
  if (label <= 0) return 0;
  return static_cast<std::int32_t>(std::ranges::lower_bound(ids, label) - ids.begin()) + 1;
}

/// What is known about the pixels of a view besides their features.
struct StrokeEvidence {
  const StrokeDistances& distances;
  double nearness = 0;
  const LabelSurfaces* surfaces = nullptr;  ///< Null = no disparity to compare.
  /// Painted on this view itself: labels there are certain. Empty = none.
  ImageView<const std::int32_t> painted{};
};

/// Rows of probabilities `[x][label]` into bytes `[label][x]`.
void store_row(const float* row, int pitch, VolumeView<std::uint8_t> map, int y) {
  for (int l = 0; l < map.layers; ++l) {
    std::uint8_t* out = map.row(y, l);
    for (int x = 0; x < map.width; ++x) {
      const float scaled = row[static_cast<std::ptrdiff_t>(x) * pitch + l] * 255.0F + 0.5F;
      out[x] = static_cast<std::uint8_t>(std::min(scaled, 255.0F));
    }
  }
}

/// Certainty on the painted pixels of a row.
void keep_strokes(const std::int32_t* strokes, int width, int pitch, float* row) {
  for (int x = 0; x < width; ++x) {
    if (strokes[x] == 0) continue;
    float* p = row + static_cast<std::ptrdiff_t>(x) * pitch;
    std::fill_n(p, pitch, 0.F);
    p[strokes[x] - 1] = 1;
  }
}

// The votes of the forest for each pixel of a view, weighted by what else is known. Throws
// Cancelled.
ProbabilityMap predict_view(const PixelVotes& votes, const StrokeEvidence& evidence,
                            const Progress& progress) {
  ProbabilityMap map(votes.height(), votes.label_count(), votes.width());
  const int pitch = votes.pitch();
  constexpr int kRows = 8;
  parallel_for_workers((votes.height() + kRows - 1) / kRows, progress, [&] {
    return [&, row = std::vector<float>(static_cast<std::size_t>(votes.row_size()))](
               int item) mutable {
      const int end = std::min(votes.height(), (item + 1) * kRows);
      for (int y = item * kRows; y < end; ++y) {
        std::copy_n(votes.row(y), row.size(), row.data());
        if (evidence.surfaces != nullptr) evidence.surfaces->weigh_row(y, row.data());
        evidence.distances.weigh_row(y, evidence.nearness, row.data());
        if (!evidence.painted.empty()) {
          keep_strokes(evidence.painted.row(y), votes.width(), pitch, row.data());
        }
        store_row(row.data(), pitch, map.view(), y);
      }
    };
  });
  return map;
}

/// Edges of color that a path along a surface should not cross.
std::vector<Image<float>> color_guides(VolumeView<const float> features) {
  std::vector<Image<float>> planes;
  for (int c = 0; c < 3; ++c) {
    Image<float>& plane = planes.emplace_back(features.height, features.width);
    for (int y = 0; y < features.height; ++y) {
      std::copy_n(features.row(y, kWiderSurfaceLayer + c), features.width, plane.row(y));
    }
  }
  return planes;
}

bool is_painted(const Scribbles& scribbles, ViewIndex view) {
  return std::ranges::find(scribbles.views, view, &ViewScribbles::view) != scribbles.views.end();
}

constexpr int kRowStep = 8;
constexpr float kSureShare = 0.7F;
constexpr double kPrior = 3;

struct Counts {
  double fitting = kPrior, all = kPrior;
};

// Adds the pixels of a row of which the forest is sure.
void count_row(const PixelVotes& pixel_votes, const LabelSurfaces& surfaces, int y,
               const float* trust, std::vector<Counts>& counts) {
  const auto labels = static_cast<std::ptrdiff_t>(counts.size());
  const float *votes = pixel_votes.row(y), *misfits = surfaces.misfits(y);
  for (int x = 0; x < pixel_votes.width();
       ++x, votes += pixel_votes.pitch(), misfits += surfaces.pitch()) {
    const auto label = std::max_element(votes, votes + labels) - votes;
    if (votes[label] < kSureShare) continue;
    const float least = *std::min_element(misfits, misfits + labels);
    const auto weight = static_cast<double>(trust[x]);
    Counts& count = counts[static_cast<std::size_t>(label)];
    count.fitting += weight * std::exp(static_cast<double>(least - misfits[label]));
    count.all += weight;
  }
}

}  // namespace

Image<std::int32_t> propagated_strokes(const Scribbles& scribbles,
                                       const std::vector<std::int32_t>& ids,
                                       const DisparityField* disparity, ViewIndex view, int height,
                                       int width) {
  Image<std::int32_t> strokes(height, width);
  std::vector<std::int32_t> targets(static_cast<std::size_t>(width));
  for (const ViewScribbles& painted : scribbles.views) {
    if (painted.view == view) continue;
    if (!disparity || !disparity->contains(view) || !disparity->contains(painted.view)) continue;
    const ViewIndex step{view.v - painted.view.v, view.u - painted.view.u};
    for (int y = 0; y < height; ++y) {
      const std::int32_t* labels = painted.labels.row(y);
      if (std::all_of(labels, labels + width, [](std::int32_t l) { return l <= 0; })) continue;
      find_ray_targets(disparity->view(painted.view), disparity->view(view), step, y,
                       targets.data());
      for (int x = 0; x < width; ++x) {
        if (labels[x] > 0 && targets[x] >= 0) strokes.data()[targets[x]] = index_of(ids, labels[x]);
      }
    }
  }
  // What is painted on the view itself is never hidden by what is carried there.
  const auto own = std::ranges::find(scribbles.views, view, &ViewScribbles::view);
  if (own == scribbles.views.end()) return strokes;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const std::int32_t label = own->labels.data()[i];
    if (label > 0) strokes.data()[i] = index_of(ids, label);
  }
  return strokes;
}

StrokeDistances::StrokeDistances(ImageView<const std::int32_t> strokes, int label_count,
                                 const StrokeGuides& guides, const Progress& progress, Isa isa)
    : height_(strokes.height),
      width_(strokes.width),
      label_count_(label_count),
      pitch_(round_up(label_count, kVectorLanes)),
      distances_(make_large<float>(strokes.size() * static_cast<std::size_t>(pitch_))) {
  std::fill_n(distances_.get(), strokes.size() * static_cast<std::size_t>(pitch_), kFar);
  std::vector<char> is_stroked(static_cast<std::size_t>(label_count));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const std::int32_t label = strokes.at(y, x) - 1;
      if (label < 0) continue;
      distances_[(static_cast<std::size_t>(y) * width_ + x) * pitch_ + label] = 0;
      is_stroked[static_cast<std::size_t>(label)] = 1;
    }
  }
  for (int l = 0; l < label_count; ++l) {
    if (is_stroked[static_cast<std::size_t>(l)] != 0) stroked_.push_back(l);
  }
  if (stroked_.size() < 2) return;  // Nothing to compare.
  find_ways(guides);
  if (!guides.disparity.empty()) add_jumps(guides);
  if (guides.surfaces != nullptr) begin_on(*guides.surfaces, progress);
  sweep(progress, isa);
}

void StrokeDistances::find_ways(const StrokeGuides& guides) {
  for (int way = 0; way < 4; ++way) {
    ways_[way].assign(static_cast<std::size_t>(height_) * width_, kFar);
    const auto [dx, dy] = kWays[way];
    const float step = step_length(kWays[way]);
    for (int y = 0; y + dy < height_; ++y) {
      float* lengths = ways_[way].data() + static_cast<std::size_t>(y) * width_;
      const int begin = std::max(0, -dx);
      const int end = width_ - std::max(0, dx);
      std::fill(lengths + begin, lengths + end, 0.F);
      for (const ImageView<const float>& guide : guides.colors) {
        const float* here = guide.row(y);
        const float* there = guide.row(y + dy) + dx;
        for (int x = begin; x < end; ++x) {
          lengths[x] += (there[x] - here[x]) * (there[x] - here[x]);
        }
      }
      for (int x = begin; x < end; ++x) lengths[x] = step + std::sqrt(lengths[x]);
    }
  }
}

void StrokeDistances::add_jumps(const StrokeGuides& guides) {
  const auto trust = [&](int y, int x) { return guides.trust.empty() ? 1 : guides.trust.at(y, x); };
  for (int way = 0; way < 4; ++way) {
    const auto [dx, dy] = kWays[way];
    const float step = step_length(kWays[way]);
    for (int y = 0; y + dy < height_; ++y) {
      float* lengths = ways_[way].data() + static_cast<std::size_t>(y) * width_;
      const float* here = guides.disparity.row(y);
      const float* there = guides.disparity.row(y + dy) + dx;
      for (int x = std::max(0, -dx); x < width_ - std::max(0, dx); ++x) {
        const float jump = std::max(std::abs(there[x] - here[x]) - kSlope_px, 0.F);
        const float t = std::min(trust(y, x), trust(y + dy, x + dx));
        const float color = lengths[x] - step;
        lengths[x] =
            step + std::lerp(1.0F, kColorsBesideDisparity, t) * color + t * kJumpWeight * jump;
      }
    }
  }
}

void StrokeDistances::begin_on(const LabelSurfaces& surfaces, const Progress& progress) {
  parallel_for(height_, progress, [&](int y) {
    const float* misfit = surfaces.misfits(y);
    float* distance = distances_.get() + static_cast<std::ptrdiff_t>(y) * width_ * pitch_;
    for (int x = 0; x < width_; ++x, misfit += surfaces.pitch(), distance += pitch_) {
      for (const int l : stroked_) distance[l] = std::min(distance[l], kBehind + misfit[l]);
    }
  });
}

void StrokeDistances::sweep(const Progress& progress, Isa isa) {
  const StrokeDistanceKernel& kernel = EPISCOPE_CHOOSE_KERNEL(isa, kStrokeDistanceKernel);
  DistanceGrid grid{height_, width_, pitch_, distances_.get(), {}};
  for (int way = 0; way < 4; ++way) grid.ways[way] = ways_[way].data();
  for (int i = 0; i < kSweeps; ++i) {
    progress.check();
    for (int y = 0; y < height_; ++y) kernel.sweep_down(grid, y);
    for (int y = height_; y-- > 0;) kernel.sweep_up(grid, y);
  }
}

float StrokeDistances::excess(int y, int x, int label) const {
  if (stroked_.size() < 2 || std::ranges::count(stroked_, label) == 0) return 0;
  const float* all = distances_.get() + (static_cast<std::size_t>(y) * width_ + x) * pitch_;
  // Lanes of labels without strokes are far.
  return std::min(all[label] - *std::min_element(all, all + label_count_), kMaxExcess);
}

void StrokeDistances::weigh_row(int y, double strength, float* probabilities) const {
  if (stroked_.size() < 2 || strength == 0) return;
  static const LabelWeightsKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kLabelWeightsKernel);
  const std::vector<float> strengths(static_cast<std::size_t>(width_),
                                     static_cast<float>(strength));
  std::vector<float> is_stroked(static_cast<std::size_t>(pitch_));
  const std::vector<float> floor(is_stroked.size());
  for (const int l : stroked_) is_stroked[static_cast<std::size_t>(l)] = 1;
  const float* const distances =
      distances_.get() + static_cast<std::ptrdiff_t>(y) * width_ * pitch_;
  kernel.weigh(
      {width_, pitch_, distances, strengths.data(), is_stroked.data(), floor.data(), kMaxExcess},
      probabilities);
}

ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                    VolumeView<const float> features, const PixelVotes& votes,
                                    const Progress& progress) {
  const int labels = votes.label_count();
  const Image<std::int32_t> strokes = propagated_strokes(
      known.scribbles, known.ids, known.disparity, view, features.height, features.width);
  const std::vector<Image<float>> colors = color_guides(features);
  StrokeGuides guides{{colors.begin(), colors.end()}};
  Image<float> filled, trust;
  std::optional<LabelSurfaces> surfaces;
  if (known.judges_disparity) {
    filled = filled_disparity(known.disparity->view(view));
    guides.disparity = filled.view();
    if (known.confidence != nullptr && known.confidence->contains(view)) {
      trust = disparity_trust(known.confidence->view(view));
    }
    guides.trust = trust.view();
    surfaces.emplace(strokes.view(), labels, filled.view(), guides.trust, progress);
    if (!trust.empty()) {
      surfaces->set_support(surface_support(votes, *surfaces, trust, progress), progress);
    }
    guides.surfaces = &*surfaces;
  }
  const StrokeDistances distances(strokes, labels, guides, progress);
  StrokeEvidence evidence{distances, known.nearness, guides.surfaces};
  if (is_painted(known.scribbles, view)) evidence.painted = strokes.view();
  return predict_view(votes, evidence, progress);
}

std::vector<float> surface_support(const PixelVotes& pixel_votes, const LabelSurfaces& surfaces,
                                   ImageView<const float> trust, const Progress& progress) {
  const auto labels = static_cast<std::size_t>(pixel_votes.label_count());
  const int rows = (pixel_votes.height() + kRowStep - 1) / kRowStep;
  // Of each row by itself, so that the sums do not depend on the threads.
  std::vector<std::vector<Counts>> of_rows(static_cast<std::size_t>(rows));
  parallel_for(rows, progress, [&](int row) {
    const int y = std::min(row * kRowStep + kRowStep / 2, pixel_votes.height() - 1);
    std::vector<Counts>& counts = of_rows[static_cast<std::size_t>(row)];
    counts.assign(labels, {0, 0});
    count_row(pixel_votes, surfaces, y, trust.row(y), counts);
  });
  std::vector<float> support;
  for (std::size_t l = 0; l < labels; ++l) {
    Counts sum;
    for (const std::vector<Counts>& counts : of_rows) {
      sum.fitting += counts[l].fitting;
      sum.all += counts[l].all;
    }
    support.push_back(static_cast<float>(sum.fitting / sum.all));
  }
  return support;
}

}  // namespace episcope
