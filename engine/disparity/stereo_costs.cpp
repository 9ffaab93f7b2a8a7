// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo_costs.h"

#include "engine/core/finding.h"
#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/memory.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/kernels/matching_kernel.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr int kInversePlanes = 6;

// Symmetric 3×3: 00, 01, 02, 11, 12, 22.
using Symmetric = std::array<double, 6>;

Symmetric inverted(const Symmetric& m) {
  const double a = m[3] * m[5] - m[4] * m[4];
  const double b = m[2] * m[4] - m[1] * m[5];
  const double c = m[1] * m[4] - m[2] * m[3];
  const double scale = 1 / (m[0] * a + m[1] * b + m[2] * c);
  return {a * scale,
          b * scale,
          c * scale,
          (m[0] * m[5] - m[2] * m[2]) * scale,
          (m[1] * m[2] - m[0] * m[4]) * scale,
          (m[0] * m[3] - m[1] * m[1]) * scale};
}

int padded_width(int width) {
  return width + kGuidedSlack;
}

// Rows in which the residual is measured.
constexpr int kProbedCostRows = 24;
// At least so many labels there: between coarse ones the residual is not that of noise.
constexpr int kProbedLabels = 64;
// ε in residuals, and the least in three channels: below it the steps of 8-bit samples are cut off.
constexpr double kCapInResiduals = 2;
constexpr double kMinCap = 0.015;
// The residual that noise of σ = 1 leaves in three channels (1.6·√(1 + Σw²) = 2.1), and a tenth
// more for what is not noise in it. One channel leaves half of that.
constexpr double kResidualOfNoise = 2.3;
// Regularization of the guided filter, variance of samples in [0, 1] in three channels, and of
// their noise variance: whatever contrast is not noise is an edge.
constexpr double kLeastGuideVariance = 3e-5;
constexpr double kNoiseInGuide = 8;

// Half the side of the windows that samples are relative to, px: wide, since what an edge adds to
// them differs from view to view.
constexpr int kSurroundings = 100;

// In place of the residual of a pixel that is not valid.
constexpr float kNothingSeen = -1;

// The residuals of prepare_stereo: over all pixels, and of the tenth that matches best.
constexpr double kMiddle = 0.5, kLowest = 0.1;
struct Residuals {
  double median = 0, lowest_tenth = 0;
};

// The least cost of every valid pixel of some rows, by the CPU.
std::vector<float> least_costs(const LightField& lf, const StereoCosts& costs,
                               const MatchingCost& probe, const std::vector<float>& labels,
                               const std::vector<int>& rows, const Progress& progress) {
  std::vector<float> least(rows.size() * lf.width());
  parallel_for_workers(static_cast<int>(rows.size()), progress, [&] {
    return [&, matching = MatchingCostRows(lf, costs.view, probe, labels),
            row = Volume<float>(1, static_cast<int>(labels.size()), lf.width())](int i) mutable {
      matching.compute(rows[i], row.view(), progress);
      float* out = least.data() + static_cast<std::size_t>(i) * lf.width();
      std::fill_n(out, lf.width(), static_cast<float>(kUncapped));
      for (int label = 0; label < row.layers(); ++label) {
        const float* cost = row.view().row(0, label);
        for (int x = 0; x < lf.width(); ++x) out[x] = std::min(out[x], cost[x]);
      }
      for (int x = 0; x < lf.width(); ++x) {
        if (!lf.is_valid(costs.view, rows[i], x)) out[x] = kNothingSeen;
      }
    };
  });
  std::erase(least, kNothingSeen);
  return least;
}

std::size_t count_valid(const LightField& lf, ViewIndex view, const std::vector<int>& rows) {
  if (lf.valid().empty()) return rows.size() * static_cast<std::size_t>(lf.width());
  std::size_t count = 0;
  for (const int y : rows) {
    for (int x = 0; x < lf.width(); ++x) count += lf.is_valid(view, y, x) ? 1 : 0;
  }
  return count;
}

// The cross-hair tells as much about noise as all views.
Residuals find_residuals(const LightField& lf, const StereoCosts& costs, const Progress& progress) {
  MatchingCost probe{MatchedViews::CrossHair, costs.matching.interpolation, kUncapped};
  probe.places = costs.matching.places;
  const std::vector<float> labels = equidistant_labels(
      costs.range, std::max(static_cast<int>(costs.labels.size()), kProbedLabels));
  std::vector<int> rows(std::min(kProbedCostRows, lf.height()));
  const int count = static_cast<int>(rows.size());
  for (int i = 0; i < count; ++i) rows[i] = (2 * i + 1) * lf.height() / (2 * count);
  if (costs.matcher) {
    const std::size_t valid = count_valid(lf, costs.view, rows);
    if (valid == 0) return {};
    const std::vector<int> ranks{static_cast<int>(quantile_rank(valid, kMiddle)),
                                 static_cast<int>(quantile_rank(valid, kLowest))};
    const std::vector<float> found =
        costs.matcher->least_costs(device_matching(lf, costs.view, probe, labels), rows,
                                   static_cast<float>(kUncapped), ranks, progress);
    return {found[0], found[1]};
  }
  std::vector<float> least = least_costs(lf, costs, probe, labels, rows, progress);
  if (least.empty()) return {};
  return {quantile(least, kMiddle), quantile(least, kLowest)};
}

std::string outlier_text(int outliers) {
  return outliers == 0 ? "" : fmt::format(" ({} of them not believed)", outliers);
}

// Where the view is smoother, the noise that interpolation removes need not be added back.
void compensate_noise(const LightField& lf, double residual, StereoCosts& costs,
                      const Progress& progress) {
  const double sigma = residual * (lf.channels() == 1 ? 2 : 1) / kResidualOfNoise;
  const auto most = static_cast<float>(sigma * sigma);
  if (costs.matcher) return costs.matcher->compensate_noise(most, progress);
  auto noise = std::make_shared<Image<float>>(local_noise_variance(lf, costs.view, progress));
  for (float& variance : *noise) variance = std::min(variance, most);
  costs.matching.noise = std::move(noise);
}

// The median of the noise that is compensated; 0 if none is.
double median_noise(const StereoCosts& costs) {
  if (costs.matcher) return costs.matcher->median_noise();
  if (!costs.matching.noise) return 0;
  std::vector<float> variances(costs.matching.noise->begin(), costs.matching.noise->end());
  return quantile(variances, 0.5);
}

// Sets the places of the views to those that files state, if they match better there.
void choose_places(const LightField& lf, const ViewPlaces& stated, StereoCosts& costs,
                   Residuals& residuals, const Progress& progress) {
  costs.matching.places = std::make_shared<const std::vector<ViewPlace>>(stated.places);
  const Residuals there = find_residuals(lf, costs, progress);
  if (there.median < residuals.median) {
    residuals = there;
    costs.notes.push_back(fmt::format(finding_text("positions.used"), stated.largest_deviation,
                                      outlier_text(stated.outliers)));
    return;
  }
  costs.matching.places = nullptr;
  costs.notes.push_back(fmt::format(finding_text("positions.no_better"), stated.largest_deviation,
                                    outlier_text(stated.outliers)));
}

void make_guide(const LightField& lf, int radius, StereoCosts& costs, const Progress& progress) {
  const double regularization =
      (kLeastGuideVariance + kNoiseInGuide * median_noise(costs)) / channel_weight(lf.channels());
  if (costs.matcher) return costs.matcher->aggregate(radius, regularization);
  costs.guide = std::make_shared<GuideImage>(lf, costs.view, radius, regularization, progress);
}

std::string cap_note(const StereoCosts& costs) {
  if (costs.matching.cap >= kUncapped) return std::string(finding_text("cap.none"));
  return fmt::format(finding_text("cap"), costs.matching.cap);
}

// Bytes of the samples on disk that so many rows of costs look at.
double looked_at_bytes(const LightField& lf, const StereoCosts& costs, int rows) {
  const GridShape grid = lf.grid();
  const bool all = costs.matching.views == MatchedViews::All;
  const double views = all ? grid.count() : grid.v + grid.u - 1;
  const double steps = std::max(grid.v, grid.u);
  const double reach = steps * std::max(std::abs(costs.range.min), std::abs(costs.range.max)) + 32;
  const double view_row = static_cast<double>(lf.byte_size()) / grid.count() / lf.height();
  return views * view_row * std::min<double>(rows + 2 * reach, lf.height());
}

// Rows of costs between which samples are dropped: multiples of a band.
int rows_at_once(const LightField& lf, const StereoCosts& costs, int band_rows) {
  const double most = static_cast<double>(memory_budget()) / 4;
  int rows = lf.height();
  while (rows > band_rows && looked_at_bytes(lf, costs, rows) > most) rows /= 2;
  return std::max(rows / band_rows, 1) * band_rows;
}

std::vector<cuda::MatchShift> device_shifts(const std::vector<AxisShift>& shifts) {
  std::vector<cuda::MatchShift> result;
  result.reserve(shifts.size());
  for (const AxisShift& shift : shifts) {
    cuda::MatchShift& each = result.emplace_back();
    std::ranges::copy(shift.weights, each.weights);
    each.origin = shift.origin;
    each.taps = shift.taps;
    each.first = shift.first;
    each.last = shift.last;
    each.nearest = shift.nearest;
    each.noise_left = shift.noise_left();
  }
  return result;
}

// In the order in which the CPU adds them.
std::vector<cuda::MatchedView> matched_views(GridShape grid, ViewIndex reference,
                                             const MatchingCost& cost) {
  std::vector<cuda::MatchedView> views;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const bool on_cross = view.v == reference.v || view.u == reference.u;
    if (view == reference || (cost.views == MatchedViews::CrossHair && !on_cross)) continue;
    views.push_back({view, cost.places ? i : view.v, cost.places ? i : view.u});
  }
  return views;
}

}  // namespace

GuideImage::GuideImage(const LightField& lf, ViewIndex view, int radius, double regularization,
                       const Progress& progress)
    : radius_(radius),
      height_(lf.height()),
      width_(lf.width()),
      channels_(lf.channels()),
      planes_(channels_ == 3 ? 6 + kInversePlanes : 3),
      pitch_(padded_width(lf.width())) {
  assert(radius >= 1 && radius <= kMaxGuidedRadius);
  memory_.resize(static_cast<std::size_t>(height_) * planes_ * pitch_ + kGuidedSlack);
  read_samples(lf, view);
  parallel_for(height_, progress, [&](int y) { find_statistics(y, regularization); });
}

void GuideImage::read_samples(const LightField& lf, ViewIndex view) {
  SamplePlanes samples(lf);
  for (int y = 0; y < height_; ++y) {
    std::array<float*, 3> rows{};
    for (int c = 0; c < channels_; ++c) rows[c] = row(c, y);
    samples.read(view, y, 0, width_, rows.data());
  }
}

void GuideImage::find_statistics(int y, double regularization) {
  const int y0 = std::max(0, y - radius_);
  const int y1 = std::min(height_, y + radius_ + 1);
  // Sums down the window's columns: samples, then products.
  constexpr int kMaxColumns = 9;
  std::array<std::vector<double>, kMaxColumns> columns;
  const int products = channels_ == 3 ? kInversePlanes : 1;
  for (int i = 0; i < channels_ + products; ++i) columns[i].assign(width_, 0.0);
  for (int j = y0; j < y1; ++j) {
    int product = channels_;
    for (int a = 0; a < channels_; ++a) {
      const float* first = row(a, j);
      for (int x = 0; x < width_; ++x) columns[a][x] += first[x];
      for (int b = a; b < channels_; ++b, ++product) {
        const float* second = row(b, j);
        for (int x = 0; x < width_; ++x) columns[product][x] += first[x] * second[x];
      }
    }
  }
  for (int x = 0; x < width_; ++x) {
    const int x0 = std::max(0, x - radius_);
    const int x1 = std::min(width_, x + radius_ + 1);
    std::array<double, kMaxColumns> mean{};
    for (int i = 0; i < channels_ + products; ++i) {
      for (int j = x0; j < x1; ++j) mean[i] += columns[i][j];
      mean[i] /= (x1 - x0) * (y1 - y0);
    }
    for (int c = 0; c < channels_; ++c) row(channels_ + c, y)[x] = static_cast<float>(mean[c]);
    if (channels_ == 1) {
      const double variance = mean[1] - mean[0] * mean[0] + regularization;
      row(2, y)[x] = static_cast<float>(1 / variance);
      continue;
    }
    Symmetric covariance{};
    int product = 0;
    for (int a = 0; a < channels_; ++a) {
      for (int b = a; b < channels_; ++b, ++product) {
        covariance[product] = mean[channels_ + product] - mean[a] * mean[b];
        if (a == b) covariance[product] += regularization;
      }
    }
    const Symmetric inverse = inverted(covariance);
    for (int i = 0; i < kInversePlanes; ++i) row(6 + i, y)[x] = static_cast<float>(inverse[i]);
  }
}

struct GuidedFilter::State {
  const GuideImage& guide;
  const GuidedKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kGuidedKernel);
  int window = 0;  // Rows of it.
  int pitch = 0;
  std::vector<float> memory;
  float* scratch = nullptr;
  float* share = nullptr;
  std::array<float*, kGuidedPlanes> model{};
  // The last `window` rows of sums of products and of models.
  std::array<std::array<float*, kGuidedPlanes>, 2 * kMaxGuidedRadius + 1> products{}, models{};

  explicit State(const GuideImage& image);
  [[nodiscard]] GuideRow guide_row(int y) const;
  void filter_layer(int y, VolumeView<float> values, int layer);
  using Ring = std::array<std::array<float*, kGuidedPlanes>, 2 * kMaxGuidedRadius + 1>;
  [[nodiscard]] GuidedSums window_about(const Ring& ring, int y, int height) const;
};

GuidedFilter::State::State(const GuideImage& image)
    : guide(image),
      window(2 * image.radius() + 1),
      pitch(padded_width(image.width()) + 2 * image.radius() + kGuidedSlack) {
  const int rows = 2 + kGuidedPlanes + 2 * window * kGuidedPlanes;
  memory.assign(static_cast<std::size_t>(rows) * pitch, 0.0F);
  float* next = memory.data();
  const auto take = [&] { return std::exchange(next, next + pitch); };
  scratch = take();
  share = take();
  for (float*& row : model) row = take();
  for (Ring* ring : {&products, &models}) {
    for (int i = 0; i < window; ++i) {
      for (float*& row : (*ring)[i]) row = take();
    }
  }
  for (int x = 0; x < guide.width(); ++x) {
    const int x0 = std::max(0, x - guide.radius());
    const int x1 = std::min(guide.width(), x + guide.radius() + 1);
    share[x] = 1.0F / static_cast<float>(x1 - x0);
  }
}

GuideRow GuidedFilter::State::guide_row(int y) const {
  GuideRow row;
  row.channels = guide.channels();
  row.width = guide.width();
  row.radius = guide.radius();
  row.share = share;
  for (int c = 0; c < row.channels; ++c) {
    row.guide[c] = guide.row(c, y);
    row.mean[c] = guide.row(row.channels + c, y);
  }
  const int inverses = row.channels == 3 ? kInversePlanes : 1;
  for (int i = 0; i < inverses; ++i) row.inverse[i] = guide.row(2 * row.channels + i, y);
  return row;
}

GuidedSums GuidedFilter::State::window_about(const Ring& ring, int y, int height) const {
  GuidedSums sums;
  const int last = std::min(height - 1, y + guide.radius());
  for (int j = std::max(0, y - guide.radius()); j <= last; ++j) {
    std::copy_n(ring[j % window].begin(), kGuidedPlanes, sums.planes[sums.rows]);
    ++sums.rows;
  }
  return sums;
}

// A row of sums, the model a radius above it and the result another radius above follow each other
// down the band, so that nothing but rows is held.
void GuidedFilter::State::filter_layer(int y, VolumeView<float> values, int layer) {
  const int radius = guide.radius();
  for (int row = 0; row < values.height + 2 * radius; ++row) {
    if (row < values.height) {
      // A copy, because the kernel reads beyond the row.
      std::copy_n(values.row(row, layer), values.width, model[0]);
      kernel.sum_products(guide_row(y + row), model[0], scratch, products[row % window].data());
    }
    const int middle = row - radius;
    if (middle >= 0 && middle < values.height) {
      kernel.solve(guide_row(y + middle), window_about(products, middle, values.height), scratch,
                   model.data(), models[middle % window].data());
    }
    const int done = row - 2 * radius;
    if (done >= 0) {
      kernel.apply(guide_row(y + done), window_about(models, done, values.height),
                   values.row(done, layer));
    }
  }
}

GuidedFilter::GuidedFilter(const GuideImage& guide) : state_(std::make_unique<State>(guide)) {}
GuidedFilter::~GuidedFilter() = default;

void GuidedFilter::apply(int y, VolumeView<float> values, const Progress& progress) {
  for (int layer = 0; layer < values.layers; ++layer) {
    progress.check();
    state_->filter_layer(y, values, layer);
  }
}

Names<Compared> names_of(Compared) {
  return {{Compared::Absolute, "absolute"}, {Compared::Relative, "relative"}};
}

Names<Positions> names_of(Positions) {
  return {{Positions::Use, "use"}, {Positions::Ignore, "ignore"}};
}

Schema<StereoCostParameters> stereo_matching_schema() {
  using P = StereoCostParameters;
  return Schema<P>()
      .integer("labels", &P::labels,
               {"Disparity steps", "Number of equidistant disparities tested"}, {2, 512, true})
      .real("epsilon", &P::epsilon,
            {"Cost cap ε",
             "Maximum cost that one view contributes, so that views in which the point is occluded "
             "do not dominate; 0 derives it from the noise of the light field, 2 disables the cap"},
            {0, kUncapped})
      .choice("interpolation", &P::interpolation,
              {"Interpolation", "How views are interpolated between pixels"})
      .flag("compensate_noise", &P::compensate_noise,
            {"Compensate noise",
             "Add to the costs what interpolation averages away of the noise, so that labels that "
             "move views by whole pixels are at no disadvantage"})
      .integer("aggregation", &P::aggregation,
               {"Aggregation radius",
                "Radius of the guided filter that averages the costs of neighbors of similar "
                "color; 0 = off",
                "px"},
               {0, 8})
      .choice("cost", &P::cost,
              {"Compare samples",
               "absolute: samples are compared as they are; relative: relative to the mean around "
               "them, for views of different brightness"})
      .choice("positions", &P::positions, {"Camera positions", kPositionsHelp})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20})
      .view("view", &P::view,
            {"View", "Row and column of the view to estimate; auto = center view"});
}

Schema<StereoCostParameters> stereo_cost_schema(MatchedViews views) {
  return stereo_matching_schema()
      .part(&StereoCostParameters::profile, profile_schema())
      .begin_with(kProfileKey)
      .preset(kProfileKey, kPaperProfile,
              {{"epsilon", views == MatchedViews::All ? 1.0 : kUncapped},
               {"interpolation", std::string("bilinear")},
               {"compensate_noise", false},
               {"aggregation", 0},
               {"cost", std::string("absolute")},
               {"positions", std::string("ignore")}});
}

StereoCosts prepare_stereo(const LightField& lf, MatchedViews views,
                           const StereoCostParameters& parameters, const Progress& progress,
                           Device device) {
  StereoCosts costs;
  costs.view = parameters.view.value_or(lf.center());
  check_matching(lf, costs.view);
  if (parameters.cost == Compared::Relative) {
    costs.relative = std::make_shared<const LightField>(
        relative_samples(lf, kSurroundings, progress.part(0, 0.1)));
  }
  const LightField& compared = costs.relative ? *costs.relative : lf;
  if (device == Device::Cuda) {
    costs.matcher = std::make_shared<cuda::StereoMatcher>(
        compared, lf, costs.view, views == MatchedViews::CrossHair, progress.part(0.1, 0.1));
  }
  costs.range = search_range(compared, parameters.range, progress.part(0.1, 0.5));
  costs.labels = equidistant_labels(costs.range, parameters.labels);
  costs.matching.views = views;
  costs.matching.interpolation = parameters.interpolation;
  costs.matching.cap = parameters.epsilon;
  ViewPlaces stated;
  if (parameters.positions == Positions::Use) stated = view_places(compared.info(), lf.grid());
  if (stated.kind == PlacesKind::Implausible) {
    costs.notes.emplace_back(finding_text("positions.no_grid"));
  }
  const bool is_irregular = stated.kind == PlacesKind::Irregular;
  if (parameters.compensate_noise || parameters.epsilon == 0 || is_irregular) {
    progress.step("noise");
    Residuals residuals = find_residuals(compared, costs, progress.part(0.5, 0.7));
    if (is_irregular) choose_places(compared, stated, costs, residuals, progress.part(0.7, 0.8));
    if (parameters.compensate_noise) {
      compensate_noise(compared, residuals.lowest_tenth, costs, progress.part(0.8, 0.9));
    }
    if (parameters.epsilon == 0) {
      const double least = kMinCap / std::sqrt(channel_weight(compared.channels()));
      costs.matching.cap = std::clamp(kCapInResiduals * residuals.median, least, kUncapped);
    }
  }
  if (parameters.aggregation > 0) {
    make_guide(lf, parameters.aggregation, costs, progress.part(0.9, 1));
  }
  return costs;
}

StereoCostRows::StereoCostRows(const LightField& lf, const StereoCosts& costs)
    : costs_(costs),
      height_(lf.height()),
      width_(lf.width()),
      matching_(costs.relative ? *costs.relative : lf, costs.view, costs.matching, costs.labels),
      filter_(costs.guide ? std::make_unique<GuidedFilter>(*costs.guide) : nullptr) {}

VolumeView<const float> StereoCostRows::compute(int y, int rows, const Progress& progress) {
  const int reach = costs_.guide ? 2 * costs_.guide->radius() : 0;
  const int first = std::max(0, y - reach);
  const int last = std::min(height_, y + rows + reach);
  if (band_.height() < last - first) {
    band_ = Volume<float>(last - first, static_cast<int>(costs_.labels.size()), width_);
  }
  VolumeView<float> band = band_.view();
  band.height = last - first;
  matching_.compute(first, band, progress);
  if (filter_) filter_->apply(first, band, progress);
  band.data = band.row(y - first, 0);
  band.height = rows;
  return band;
}

int stereo_band_rows(int height) {
  return std::clamp(height / 12, 16, 64);
}

void compute_stereo_costs(const LightField& lf, const StereoCosts& costs,
                          const TakeStereoCosts& take, const Progress& progress) {
  const int height = lf.height(), band = stereo_band_rows(height);
  const int rows = lf.is_on_disk() ? rows_at_once(lf, costs, band) : height;
  for (int first = 0; first < height; first += rows) {
    const int end = std::min(first + rows, height);
    const auto share = [&](int y) { return static_cast<double>(y) / height; };
    if (costs.matching.views == MatchedViews::All) lf.fetch_samples(first, end);
    parallel_for_workers((end - first + band - 1) / band, progress.part(share(first), share(end)),
                         [&] {
                           return [&, source = StereoCostRows(lf, costs)](int i) mutable {
                             const int y = first + i * band;
                             take(y, source.compute(y, std::min(band, end - y), progress));
                           };
                         });
    if (rows < height) lf.forget_samples();
  }
}

Volume<float> stereo_volume(const LightField& lf, const StereoCosts& costs,
                            const Progress& progress) {
  Volume<float> volume(lf.height(), static_cast<int>(costs.labels.size()), lf.width());
  const VolumeView<float> rows = volume.view();
  compute_stereo_costs(
      lf, costs,
      [&](int y, VolumeView<const float> band) {
        std::copy_n(band.data, band.size(), rows.row(y, 0));
      },
      progress);
  return volume;
}

std::vector<std::string> cost_notes(const StereoCosts& costs) {
  std::vector<std::string> notes{cap_note(costs)};
  notes.insert(notes.end(), costs.notes.begin(), costs.notes.end());
  return notes;
}

cuda::StereoMatching device_matching(const LightField& lf, ViewIndex reference,
                                     const MatchingCost& cost, const std::vector<float>& labels) {
  check_matching(lf, reference);
  const GridShape grid = lf.grid();
  const int count = static_cast<int>(labels.size());
  const auto shifts = [&](int places, int at, double ViewPlace::*axis, int extent) {
    const std::size_t index = static_cast<std::size_t>(reference.v) * grid.u + reference.u;
    return make_shifts(
        cost.places ? stated_ways(*cost.places, index, axis) : regular_ways(places, at), extent,
        cost.interpolation, labels);
  };
  const std::vector<AxisShift> rows = shifts(grid.v, reference.v, &ViewPlace::v, lf.height());
  const std::vector<AxisShift> columns = shifts(grid.u, reference.u, &ViewPlace::u, lf.width());
  cuda::StereoMatching matching;
  matching.views = matched_views(grid, reference, cost);
  matching.labels = count;
  matching.disparities = labels;
  matching.rows = device_shifts(rows);
  matching.columns = device_shifts(columns);
  if (lf.valid().empty() && !cost.places) {
    matching.rows_seen = count_seen(rows, count, lf.height());
    matching.columns_seen = count_seen(columns, count, lf.width());
  }
  matching.is_cross_hair = cost.views == MatchedViews::CrossHair;
  matching.cap = static_cast<float>(cost.cap);
  matching.worst =
      static_cast<float>(std::min(cost.cap, std::sqrt(static_cast<double>(lf.channels()))));
  return matching;
}

cuda::LabelPlaces::Refinement device_refinement(Refinement refinement) {
  using To = cuda::LabelPlaces::Refinement;
  if (refinement == Refinement::Parabola) return To::Parabola;
  return refinement == Refinement::Equiangular ? To::Equiangular : To::None;
}

}  // namespace episcope
