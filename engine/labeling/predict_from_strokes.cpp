// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"

#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/labeling/feature_kernel.h"
#include "engine/labeling/forest_kernel.h"
#include "engine/labeling/pixel_features.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace episcope {
namespace {

constexpr std::size_t kFewestSamples = 8;
constexpr int kRounds = 12;
constexpr double kShortStroke = 1.0 / 80;  // Of the larger side: half of its slope is believed.
constexpr double kOutlier = 3;             // Of the Cauchy weights, in robust standard deviations.
constexpr double kLeastScale = 1e-3;       // So that exact planes have one.
constexpr double kLeverage = 0.08;         // What leverage adds to the variance.
constexpr float kWeight = 1.5F;
constexpr float kLeastProbability = 0.02F;

// Far from everything: beyond the labels there is no surface.
constexpr float kNowhere = 1e6F;

enum Term { kIsKnown, kMiddle, kAt, kAcross, kVariance, kFlat, kSlope, kBend, kTerms };

// What SurfaceRow points to.
struct RowTerms {
  explicit RowTerms(int labels) : pitch(labels), values(static_cast<std::size_t>(kTerms) * labels) {
    for (const auto& [term, value] :
         {std::pair{kIsKnown, 1.0F}, std::pair{kAt, kNowhere}, std::pair{kVariance, 1.0F}}) {
      std::fill_n(values.begin() + term * pitch, pitch, value);
    }
  }
  [[nodiscard]] SurfaceRow row() const {
    const auto term = [this](Term of) { return values.data() + of * pitch; };
    SurfaceRow row;
    row.pitch = pitch;
    row.is_known = term(kIsKnown);
    row.middle = term(kMiddle);
    row.at = term(kAt);
    row.across = term(kAcross);
    row.variance = term(kVariance);
    row.flat = term(kFlat);
    row.slope = term(kSlope);
    row.bend = term(kBend);
    return row;
  }

  int pitch;
  std::vector<float> values;  // [term][label]
};

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

LabelSurfaces::LabelSurfaces(ImageView<const std::int32_t> strokes, int label_count,
                             ImageView<const float> disparity, ImageView<const float> trust,
                             const Progress& progress)
    : disparity_(disparity),
      trust_(trust),
      pitch_(round_up(label_count, kVectorLanes)),
      misfits_(make_large<float>(static_cast<std::size_t>(disparity.height * row_size()))) {
  std::vector<std::vector<Sample>> samples(static_cast<std::size_t>(label_count));
  for (int y = 0; y < strokes.height; ++y) {
    for (int x = 0; x < strokes.width; ++x) {
      const std::int32_t label = strokes.at(y, x) - 1;
      if (label < 0) continue;
      samples[static_cast<std::size_t>(label)].push_back({static_cast<double>(x),
                                                          static_cast<double>(y),
                                                          static_cast<double>(disparity.at(y, x))});
    }
  }
  const double ridge = kShortStroke * std::max(strokes.height, strokes.width);
  for (const auto& of_label : samples) surfaces_.push_back(fit(of_label, ridge * ridge));
  parallel_for(disparity.height, progress, [this](int y) { find_misfits(y); });
}

LabelSurfaces::Surface LabelSurfaces::fit(const std::vector<Sample>& samples, double ridge_px2) {
  Surface surface;
  if (samples.size() < kFewestSamples) return surface;
  surface.is_known = true;
  for (const Sample& sample : samples) {
    surface.x += sample.x / static_cast<double>(samples.size());
    surface.y += sample.y / static_cast<double>(samples.size());
  }
  std::vector<double> weights(samples.size(), 1.0);
  std::vector<double> misses(samples.size());
  for (int round = 0; round < kRounds; ++round) {
    solve(samples, weights, ridge_px2, surface);
    std::ranges::transform(samples, misses.begin(), [&](const Sample& s) {
      const auto& [at, across, down] = surface.plane;
      return std::abs(s.d - at - across * (s.x - surface.x) - down * (s.y - surface.y));
    });
    // 1.4826: from the median to the standard deviation of a Gaussian.
    const double scale = kOutlier * (1.4826 * median(misses) + kLeastScale);
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      weights[i] = 1 / (1 + misses[i] * misses[i] / (scale * scale));
      sum += weights[i] * misses[i] * misses[i];
      all += weights[i];
    }
    surface.variance = sum / all;
  }
  return surface;
}

// Normal equations of (1, x, y), divided by the sum of the weights.
void LabelSurfaces::solve(const std::vector<Sample>& samples, const std::vector<double>& weights,
                          double ridge_px2, Surface& surface) {
  double one = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, d = 0, dx = 0, dy = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double w = weights[i];
    const double at_x = samples[i].x - surface.x, at_y = samples[i].y - surface.y;
    one += w;
    x += w * at_x;
    y += w * at_y;
    xx += w * at_x * at_x;
    xy += w * at_x * at_y;
    yy += w * at_y * at_y;
    d += w * samples[i].d;
    dx += w * at_x * samples[i].d;
    dy += w * at_y * samples[i].d;
  }
  for (double* sum : {&x, &y, &xx, &xy, &yy, &d, &dx, &dy}) *sum /= one;
  xx += ridge_px2;
  yy += ridge_px2;
  // Cofactors of the first row.
  const double c0 = xx * yy - xy * xy, c1 = y * xy - x * yy, c2 = x * xy - xx * y;
  const double determinant = c0 + x * c1 + y * c2;
  auto& m = surface.inverse;
  m = {c0, c1, c2, yy - y * y, x * y - xy, xx - x * x};
  for (double& entry : m) entry /= determinant;
  surface.plane = {m[0] * d + m[1] * dx + m[2] * dy, m[1] * d + m[3] * dx + m[4] * dy,
                   m[2] * d + m[4] * dx + m[5] * dy};
}

void LabelSurfaces::find_misfits(int y) {
  static const LabelWeightsKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kLabelWeightsKernel);
  RowTerms terms(pitch_);
  float* const arrays = terms.values.data();
  for (std::size_t l = 0; l < surfaces_.size(); ++l) {
    const Surface& surface = surfaces_[l];
    const auto& m = surface.inverse;
    const double dy = y - surface.y;
    const auto set = [&](int term, double value) {
      arrays[term * pitch_ + static_cast<std::ptrdiff_t>(l)] = static_cast<float>(value);
    };
    set(kIsKnown, surface.is_known ? 1 : 0);
    set(kMiddle, surface.x);
    set(kAt, surface.plane[0] + surface.plane[2] * dy);
    set(kAcross, surface.plane[1]);
    set(kVariance, kNoise_px * kNoise_px + surface.variance);
    set(kFlat, kLeverage * (m[0] + (2 * m[2] + m[5] * dy) * dy));
    set(kSlope, kLeverage * 2 * (m[1] + m[4] * dy));
    set(kBend, kLeverage * m[3]);
  }
  SurfaceRow row = terms.row();
  row.width = disparity_.width;
  row.disparity = disparity_.row(y);
  row.noise = static_cast<float>(kNoise_px * kNoise_px);
  row.most = kMostMisfit;
  kernel.misfits(row, misfits_.get() + y * row_size());
}

void LabelSurfaces::set_support(const std::vector<float>& support, const Progress& progress) {
  parallel_for(disparity_.height, progress, [&](int y) {
    float* misfit = misfits_.get() + y * row_size();
    for (int x = 0; x < disparity_.width; ++x, misfit += pitch_) {
      const float least = *std::min_element(misfit, misfit + support.size());
      for (std::size_t l = 0; l < support.size(); ++l) {
        misfit[l] = std::lerp(least, misfit[l], support[l]);
      }
    }
  });
}

void LabelSurfaces::weigh_row(int y, float* probabilities) const {
  static const LabelWeightsKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kLabelWeightsKernel);
  std::vector<float> strength(static_cast<std::size_t>(disparity_.width), kWeight);
  if (!trust_.empty()) {
    std::transform(trust_.row(y), trust_.row(y) + disparity_.width, strength.begin(),
                   [](float trust) { return kWeight * trust; });
  }
  std::vector<float> is_label(static_cast<std::size_t>(pitch_)), floor(is_label.size());
  std::fill_n(is_label.begin(), surfaces_.size(), 1.0F);
  std::fill_n(floor.begin(), surfaces_.size(), kLeastProbability);
  kernel.weigh({disparity_.width, pitch_, misfits(y), strength.data(), is_label.data(),
                floor.data(), kMostMisfit},
               probabilities);
}

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
