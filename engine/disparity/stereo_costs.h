// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/cuda/stereo_matcher.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/matching_cost.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// What the guided filter knows of a view: samples, their means and inverse covariances over
/// windows of (2·radius + 1)² pixels. Immutable; 48 bytes per pixel (12 for gray views).
class GuideImage {
 public:
  /// `regularization` is added to the variances, samples in [0, 1]: contrast below its root is
  /// averaged away, contrast above is kept. Precondition: 1 ≤ radius ≤ 8.
  /// Throws Cancelled.
  GuideImage(const LightField& light_field, ViewIndex view, int radius, double regularization,
             const Progress& progress);

  [[nodiscard]] int radius() const { return radius_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int channels() const { return channels_; }
  /// Rows, each with slack behind it: plane 0..c−1 the samples, c..2c−1 their means, then the
  /// inverse covariances (6 of three channels, 1 of one).
  [[nodiscard]] const float* row(int plane, int y) const {
    return memory_.data() + (static_cast<std::size_t>(y) * planes_ + plane) * pitch_;
  }
  [[nodiscard]] int pitch() const { return pitch_; }

 private:
  [[nodiscard]] float* row(int plane, int y) {
    return memory_.data() + (static_cast<std::size_t>(y) * planes_ + plane) * pitch_;
  }
  void read_samples(const LightField& light_field, ViewIndex view);
  void find_statistics(int y, double regularization);

  int radius_ = 0;
  int height_ = 0;
  int width_ = 0;
  int channels_ = 0;
  int planes_ = 0;
  int pitch_ = 0;
  std::vector<float> memory_;
};

/// Filters every layer of a volume by the guided filter (a local affine model of the layer in the
/// colors of the guide): averages over windows, but not across edges of the guide. Not
/// thread-safe: use one object per thread.
///
/// Applied to matching costs it gathers evidence from neighbors on the same surface.
/// Reference: He, Sun, Tang 2013 [HST13]; for costs, Rhemann et al. 2011 [RHBRG11].
class GuidedFilter {
 public:
  explicit GuidedFilter(const GuideImage& guide);
  ~GuidedFilter();

  /// Filters in place `values`, rows [y, y + height) of the guide. Where the band is cut from a
  /// taller image, the 2·radius rows next to the cut are not what they were in the whole.
  /// Throws Cancelled on a stop request (checked for each layer).
  void apply(int y, VolumeView<float> values, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A cap ε that no difference of samples in [0, 1] reaches, √3 being the largest: uncapped.
inline constexpr double kUncapped = 2;

/// What is compared: samples as they are, or relative to their surroundings (relative_samples),
/// which a gain of a view does not change.
enum class Compared { Absolute, Relative };
[[nodiscard]] Names<Compared> names_of(Compared);

/// Whether views are sampled at the positions of cameras that files state, where these can be
/// believed, or on a regular grid.
enum class Positions { Use, Ignore };
[[nodiscard]] Names<Positions> names_of(Positions);
inline constexpr const char* kPositionsHelp =
    "use: views are sampled at the positions that files state, if they match better there; "
    "ignore: on the regular grid";

/// What all methods of multi-view stereo have in common: which labels of which view are compared
/// with the other views, and how.
struct StereoCostParameters {
  ProfileChoice profile = {};
  int labels = 64;
  double epsilon = 0;  ///< ε; 0 = from the noise of the light field, kUncapped = none.
  Interpolation interpolation = Interpolation::Cubic;
  bool compensate_noise = true;
  int aggregation = 2;
  Compared cost = Compared::Absolute;
  Positions positions = Positions::Use;
  IntervalOrAuto range;
  ViewOrAuto view;
};

/// All but the profile, for methods that no paper tells.
[[nodiscard]] Schema<StereoCostParameters> stereo_matching_schema();
/// The profile `paper` sets ε (no cap for the cross-hair, 1 for all views), interpolation
/// (bilinear), no compensation of noise, no aggregation, cost (absolute) and positions (ignored).
[[nodiscard]] Schema<StereoCostParameters> stereo_cost_schema(MatchedViews views);

/// The data term of a view, derived from parameters and light field before the labels of single
/// pixels are examined. Immutable, shared by threads.
struct StereoCosts {
  ViewIndex view;
  Interval range;                              ///< Searched.
  std::vector<float> labels;                   ///< Equidistant over the range.
  MatchingCost matching;                       ///< With the ε used.
  std::shared_ptr<const GuideImage> guide;     ///< For the aggregation; null = none.
  std::shared_ptr<const LightField> relative;  ///< Compared in place of the samples; null = none.
  std::vector<std::string> notes;              ///< About the positions of cameras.
  /// Computes the costs on the device, holds noise and guide there; null = on the CPU.
  std::shared_ptr<cuda::StereoMatcher> matcher;
};

/// Prepares the data term. An ε of 0 is replaced by a multiple of the residual: the median, over
/// some rows of the view, of the uncapped cost at the best label. Where most pixels match, it
/// measures the noise (of the sensor, of compression, of interpolation), whatever the scene. A
/// fixed ε that is best on clean light fields takes nearly all differences for occlusions under
/// noise.
///
/// With `compensate_noise` the matching also gets the noise of the view (matching_cost.h): at
/// each pixel that of its surroundings (local_noise_variance), at most what the residual of the
/// best tenth of the pixels allows. Stated positions of cameras (light_field.h) are used if that
/// residual is smaller with them than on the regular grid: whatever they say, they do no harm.
/// The guide of the aggregation keeps whatever contrast is not noise: its regularization is
/// 3·10⁻⁵ + 8σ², σ² the median of that noise over the view (0 without `compensate_noise`). Evidence
/// for all three: tests/accuracy/tuning.md. One channel counts as three equal ones
/// (channel_weight). Throws InvalidInput (no such view, a single view),
/// DeviceFailure, Cancelled.
[[nodiscard]] StereoCosts prepare_stereo(const LightField& light_field, MatchedViews views,
                                         const StereoCostParameters& parameters,
                                         const Progress& progress, Device device = Device::Cpu);

/// For the notes of an estimate: which cap was used, and which positions of cameras if any are
/// stated.
[[nodiscard]] std::vector<std::string> cost_notes(const StereoCosts& costs);

/// The costs of some rows, aggregated, on the CPU. Not thread-safe: use one object per thread.
class StereoCostRows {
 public:
  StereoCostRows(const LightField& light_field, const StereoCosts& costs);

  /// Costs of rows [y, y + rows), `[row][label][x]`; valid until the next call. Throws Cancelled.
  [[nodiscard]] VolumeView<const float> compute(int y, int rows, const Progress& progress);

 private:
  const StereoCosts& costs_;
  int height_ = 0;
  int width_ = 0;
  MatchingCostRows matching_;
  std::unique_ptr<GuidedFilter> filter_;
  Volume<float> band_;
};

/// Rows of a band that a thread computes at once: many compared with those it needs beyond the band
/// for the aggregation, few enough to keep every thread busy.
[[nodiscard]] int stereo_band_rows(int height);

/// Takes the costs of some rows, from `first_row` on.
using TakeStereoCosts = std::function<void(int first_row, VolumeView<const float> costs)>;

/// Computes the costs of all rows on the CPU; several threads call `take`, for other rows each.
/// Samples on disk are dropped from memory on the way, so that they take no more than a quarter of
/// the memory budget if a few rows do not. Throws Cancelled.
void compute_stereo_costs(const LightField& light_field, const StereoCosts& costs,
                          const TakeStereoCosts& take, const Progress& progress);
/// All of them: height · width · labels · 4 bytes.
[[nodiscard]] Volume<float> stereo_volume(const LightField& light_field, const StereoCosts& costs,
                                          const Progress& progress);

/// What the device needs to know of a matching; noise, caps of single pixels and occluders are the
/// matcher's own. Throws InvalidInput as MatchingCostRows.
[[nodiscard]] cuda::StereoMatching device_matching(const LightField& light_field,
                                                   ViewIndex reference, const MatchingCost& cost,
                                                   const std::vector<float>& labels);

[[nodiscard]] cuda::LabelPlaces::Refinement device_refinement(Refinement refinement);

}  // namespace episcope
