// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/kernels/structure_tensor_kernel.h"

#include <functional>
#include <memory>
#include <vector>

namespace episcope {

/// Scales of the structure tensor on epipolar plane images.
struct TensorScales {
  double inner = 0.5;   ///< σ_i in px and views: Gaussian before the derivatives.
  double outer = 1.0;   ///< σ_o in px: Gaussian over the products of derivatives, along the EPI.
  double views = 1.5;   ///< Gaussian over the products along the views.
  double across = 1.0;  ///< Gaussian over the products across neighboring EPIs, in px.
  double contrast = 2;  ///< Gradients above this are toned down, in 1/255; 255 = none are.
  double noise = 0.15;  ///< Contrast below which coherence fades, in 1/255.
};

/// The filters of a structure tensor over an EPI of some views, with the memory they live in.
struct TensorFilterSet {
  TensorFilters filters;  ///< Its rows point into the vectors below.
  Taps across;            ///< Average over neighboring EPIs.
  int view_reach = 0;     ///< How many views away samples still matter for a result.
  std::vector<RowTaps> row_smooth, row_derivative, row_integrate;
};

/// Half the length of the Gaussian with this σ.
[[nodiscard]] int gaussian_radius(double sigma);

/// Gaussians cut at 2σ and normalized; along the views truncated at the first and last and
/// renormalized. σ = 0 leaves a filter out.
[[nodiscard]] TensorFilterSet make_tensor_filters(int rows, int channels,
                                                  const TensorScales& scales);

/// Where orientation is looked for.
struct TensorSearch {
  /// Estimates accepted, px per view step: the range of interest and some overshoot for noise.
  Interval accepted;
  /// Shears in half pixels per view step; every disparity of interest lies within `limit` of one.
  std::vector<int> half_step_shears;
  double limit = 0.6;
  /// Reads the disparity off the eigenvector of the tensor, instead of by least squares.
  bool eigenvector = false;
};

/// Shears that cover `range`, `step_half_px` half pixels apart, whole multiples of that.
[[nodiscard]] TensorSearch cover_range(Interval range, int step_half_px);
/// Likewise with as few shears as the range demands: none up to ±1.2 px, where any orientation
/// found counts, else whole pixels and what lies within 1.1 px of them.
[[nodiscard]] TensorSearch cover_range_sparsely(Interval range);

/// A rectangle of image pixels seen by one row or column of cameras.
struct TensorTask {
  int camera_line = 0;  ///< Horizontal EPIs: camera row v. Vertical EPIs: camera column u.
  PixelIndex begin;
  int height = 0;
  int width = 0;
  int first_view = 0, last_view = 0;  ///< Wanted views [first, last) of that line: u or v.
};

/// Size of a rectangle of image pixels.
struct TensorExtent {
  int height = 0;
  int width = 0;
};

/// Disparity and coherence of the views of an EPI by the structure tensor: smoothing with σ_i,
/// derivatives (central difference along, Scharr's [3,10,3]/16 across), products summed over
/// color channels, integration with σ_o, orientation d = −2Jxs/(Jxx − Jss + √((Jxx − Jss)² +
/// 4Jxs²)) and coherence r = √((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²), n² the energy of the noise.
/// Source: Bigün and Granlund 1987 [BG87]; Wanner and Goldluecke 2012 [WG12].
///
/// Departures from it, each of which lowers the error on scenes with known truth:
/// - The EPI is sheared to several disparities and the most coherent answer kept. Each view is
///   integrated in coordinates of its own, so all views get estimates at whole pixels.
/// - Products are divided by (1 + |∇|²/contrast²): else a silhouette drowns the weaker texture
///   beside it and objects grow by the size of the window.
/// - The tensor of the chosen shear, turned back to unsheared coordinates, is averaged over
///   neighboring EPIs before the disparity is read off, by least squares. Neighbors count less
///   the more their own disparity differs, 0.3 px by half: averages over all of them make objects
///   grow by the size of that window as well.
/// With `TensorSearch::eigenvector` the disparity follows the formula, EPI by EPI.
/// Filters are truncated at the first and last view and renormalized, so that slopes there come
/// out right.
///
/// Not thread-safe: use one object per thread. Takes 2 to 10 MB.
class StructureTensor {
 public:
  enum class Direction { Horizontal, Vertical };

  /// Takes a run of results of one view: pixels (begin.y, begin.x …). Coherence 0 = no accepted
  /// orientation; the disparity is then 0 or the nearest accepted.
  using Sink = std::function<void(int view, PixelIndex begin, int count, const float* disparity,
                                  const float* coherence)>;

  /// The views of an EPI. Throws InvalidInput if the grid has fewer than 2 or more than 160 in that
  /// direction.
  [[nodiscard]] static int views_along(const LightField& light_field, Direction direction);

  /// Throws InvalidInput as `views_along`.
  StructureTensor(const LightField& light_field, Direction direction, const TensorScales& scales,
                  const TensorSearch& search);
  ~StructureTensor();
  StructureTensor(StructureTensor&&) noexcept;

  /// Largest rectangle of one task: narrow blocks for vertical EPIs, whole rows for horizontal.
  [[nodiscard]] static TensorExtent largest_task(const LightField& light_field, Direction direction,
                                                 const TensorScales& scales);

  /// How far the samples that an estimate depends on are from its pixel, along the EPI, in px;
  /// across it depends on those within the radius of the cross scale.
  [[nodiscard]] static int reach(const LightField& light_field, Direction direction,
                                 const TensorScales& scales, const TensorSearch& search);

  void estimate(const TensorTask& task, const Sink& sink);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Merges `count` estimates of one direction into the estimates of the other: where both agree
/// within 0.3 px their mean weighted by coherence^power, else the more coherent one; coherence
/// becomes the larger of the two. Source: winner-takes-all as in [WG12], here weighted.
void merge_orientations(const float* disparity, const float* coherence, int count, int power,
                        float* to_disparity, float* to_coherence);

/// Settings of the device for a structure tensor with these scales in this light field: both
/// directions, where the grid has them. How estimates are merged is left open. Throws InvalidInput
/// as StructureTensor.
[[nodiscard]] cuda::TensorSettings device_tensor_settings(const LightField& light_field,
                                                          const TensorScales& scales,
                                                          const TensorSearch& search);

}  // namespace episcope
