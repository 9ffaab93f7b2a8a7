// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope::cuda {

/// How one axis of a view is sampled at one label; see AxisShift of the estimators.
struct alignas(16) MatchShift {
  float weights[4] = {1, 0, 0, 0};
  int origin = 0;           ///< Pixels from the reference pixel to the first tap.
  int taps = 1;             ///< 1, 2 or 4.
  int first = 0, last = 0;  ///< Reference pixels whose sample lies within the image.
  int nearest = 0;          ///< Pixels from the reference pixel to the one next to the sample.
  double noise_left = 1;    ///< Share of the variance of noise that the weights leave.
};

/// A view to compare with, and its ways along both axes.
struct MatchedView {
  ViewIndex view;
  int row = 0, column = 0;
};

/// Which views are compared at which labels, and how; see MatchingCost.
struct StereoMatching {
  std::vector<MatchedView> views;  ///< In the order in which costs are added.
  int labels = 0;
  std::vector<float> disparities;         ///< Of the labels.
  std::vector<MatchShift> rows, columns;  ///< `[way][label]`
  /// For each label and pixel of an axis, in how many places it is seen, `[label][pixel]`. Empty =
  /// the samples are counted one by one, because some may be invalid or places are irregular.
  std::vector<float> rows_seen, columns_seen;
  bool is_cross_hair = false;
  float cap = 0;    ///< ε
  float worst = 0;  ///< Cost where nothing is seen.
};

/// How a label becomes a disparity.
struct LabelPlaces {
  enum class Refinement { None, Parabola, Equiangular };
  float first = 0, step = 1;  ///< px
  Refinement refinement = Refinement::None;
};

/// Matching costs of one view on the device, and what is chosen by them; the results of
/// MatchingCostRows, GuidedFilter and the local stereo methods. Not thread-safe.
class StereoMatcher {
 public:
  /// `compared` is matched, `shown` guides the aggregation; views of the row and the column of
  /// `view` alone, or all. Throws DeviceFailure, Cancelled.
  StereoMatcher(const LightField& compared, const LightField& shown, ViewIndex view,
                bool is_cross_hair, const Progress& progress);
  ~StereoMatcher();

  /// Of the least costs over all labels, at most `most`, of every valid pixel of some rows, those
  /// of these ranks in ascending order, each less than the number of such pixels. Without noise and
  /// aggregation. Throws DeviceFailure, Cancelled.
  [[nodiscard]] std::vector<float> least_costs(const StereoMatching& matching,
                                               const std::vector<int>& rows, float most,
                                               const std::vector<int>& ranks,
                                               const Progress& progress);

  /// Later costs are compensated for the local noise variance of the view (local_noise_variance),
  /// at most `most`. Throws DeviceFailure, Cancelled.
  void compensate_noise(float most, const Progress& progress);
  /// The median of what is compensated; 0 if nothing is. Throws DeviceFailure.
  [[nodiscard]] float median_noise() const;
  /// What is compensated, `[y][x]`; empty if nothing is. Throws DeviceFailure, Cancelled.
  [[nodiscard]] Image<float> noise(const Progress& progress) const;
  /// view_noise_variance of the shown view. Throws DeviceFailure, Cancelled.
  [[nodiscard]] float noise_variance(const Progress& progress) const;
  /// Later costs are aggregated by the guided filter; as GuideImage. Throws DeviceFailure.
  void aggregate(int radius, double regularization);
  /// Later costs of `volume` have a cap of its own for each pixel, `[y][x]`, instead of the cap of
  /// the matching; in the end they are divided by that cap and times the mean of all caps. Throws
  /// DeviceFailure, Cancelled.
  void set_caps(const Image<float>& caps, const Progress& progress);
  /// In later costs of `volume`, samples that a surface of the view occludes count less, as
  /// Occluders has it: `surface` `[y][x]` is its disparity in the view, kNothingNear where none is
  /// known (surfaces_in_views). Throws DeviceFailure, Cancelled.
  void set_occluders(const Image<float>& surface, float tolerance, float softness,
                     const Progress& progress);

  /// The disparity and the confidence of every pixel, by the label of least cost: see
  /// estimate_stereo_local. Both images have the size of a view. Throws DeviceFailure, Cancelled.
  void choose(const StereoMatching& matching, const LabelPlaces& places, ImageView<float> disparity,
              ImageView<float> confidence, const Progress& progress);
  /// All costs. Throws DeviceFailure, Cancelled.
  [[nodiscard]] SharedVolume volume(const StereoMatching& matching, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Costs of a volume around one label of each pixel, `[y][x]`: of the label before, of the label,
/// of the one after (the label's own at the ends), and the mean over all.
struct CostsAtLabels {
  Image<float> before, here, after, mean;
};
/// Throws DeviceFailure, Cancelled.
[[nodiscard]] CostsAtLabels costs_at_labels(const DeviceVolume& volume, const Image<int>& labels,
                                            const Progress& progress);

/// The label of least cost at each pixel, of equals the lowest. Throws DeviceFailure, Cancelled.
[[nodiscard]] Image<int> least_labels(const DeviceVolume& volume, const Progress& progress);

/// The sum over the valid pixels of the mean cost of the labels within `reach` of a pixel's best
/// one; see cost_unit. `valid` `[y][x]` is on the host, null = all. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] double sum_around_best(const DeviceVolume& volume, const std::uint8_t* valid,
                                     int reach, const Progress& progress);

}  // namespace episcope::cuda
