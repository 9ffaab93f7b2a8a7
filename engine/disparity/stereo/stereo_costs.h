// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/schema.h"
#include "engine/disparity/common/matching_cost.h"
#include "engine/disparity/stereo/guided_filter.h"

#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// A cap ε that no difference of samples in [0, 1] reaches, √3 being the largest: uncapped.
inline constexpr double kUncapped = 2;

/// Whether a method of multi-view stereo is run as we tuned it or as published.
enum class Profile { Tuned, Paper };
[[nodiscard]] Names<Profile> names_of(Profile);

/// What every method of multi-view stereo has in common: which labels of which view are compared
/// with the others, and how.
struct StereoCostParameters {
  Profile profile = Profile::Tuned;
  int labels = 64;
  double epsilon = 0;  ///< ε; 0 = from the noise of the light field, kUncapped = none.
  Interpolation interpolation = Interpolation::Cubic;
  int aggregation = 2;
  IntervalOrAuto range;
  ViewOrAuto view;
};

/// Profile::Paper overwrites ε (no cap for the cross-hair, 1 for all views), interpolation
/// (bilinear) and aggregation (none).
[[nodiscard]] Schema<StereoCostParameters> stereo_cost_schema(MatchedViews views);

/// The data term of a view, found out from parameters and light field, before the labels of single
/// pixels are looked at. Immutable, shared by threads.
struct StereoCosts {
  ViewIndex view;
  Interval range;                           ///< Searched.
  std::vector<float> labels;                ///< Equidistant over the range.
  MatchingCost matching;                    ///< With the ε used.
  std::shared_ptr<const GuideImage> guide;  ///< For the aggregation; null = none.
};

/// Prepares the data term. An ε of 0 becomes a multiple of the residual: the median, over some rows
/// of the view, of the uncapped cost that is left at the best label. It measures noise (of the
/// sensor, of compression, of interpolation) where most pixels match, whatever the scene is.
///
/// Why: ε decides more than anything else, and on clean light fields the best is near 0.015; but
/// under noise of 5/255 such a cap takes nearly all differences for occlusions, and the error grows
/// thirty-fold. Measured on the built-in scenes with noise of 0 to 10/255, still_life and cotton.
///
/// Unless the profile is Paper, the matching also gets the noise of the view (matching_cost.h):
/// at each pixel that of its surroundings (local_noise.h), at most what the residual of the best
/// quarter of the pixels allows. Error (MSE×100, BadPix(0.07) %) without and with it, ST_AV_S:
/// still_life 0.51, 11.2; 0.43, 5.3; objects with noise of 5/255 0.26, 8.8; 0.20, 4.1; ST_AV_G:
/// still_life 0.61, 16.9; 0.46, 4.7; scenes without noise as before. Throws InvalidInput (no such
/// view, a single view), Cancelled.
[[nodiscard]] StereoCosts prepare_stereo(const LightField& light_field, MatchedViews views,
                                         const StereoCostParameters& parameters,
                                         const Progress& progress);

/// For the notes of an estimate: which cap was used.
[[nodiscard]] std::string cap_note(const StereoCosts& costs);

/// The costs of some rows, aggregated. Not thread-safe: one object for each thread.
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

/// Rows of a band that a thread computes at once: many against those it needs beyond the band to
/// aggregate, few enough to keep every thread busy.
[[nodiscard]] int stereo_band_rows(int height);

/// The costs of all rows: height · width · labels · 4 bytes. Throws Cancelled.
[[nodiscard]] Volume<float> stereo_volume(const LightField& light_field, const StereoCosts& costs,
                                          const Progress& progress);

}  // namespace episcope
