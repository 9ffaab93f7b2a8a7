// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/structure_tensor.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace episcope {

/// Where two disparities are looked for.
struct DoubleSearch {
  Interval accepted;          ///< Of each of the two, px per view step.
  double min_distance = 0.2;  ///< Between the two: nearer ones cannot be told apart.
  int tile_stride = 1;  ///< measure_double_layers: only one of so many tiles, for a rough look.
};

/// Two superimposed orientations on the epipolar plane images of transparent or reflective
/// surfaces: f = f₁(x + ρ₁u) + f₂(x + ρ₂u) satisfies ρ₁ρ₂ f_xx − (ρ₁+ρ₂) f_xu + f_uu = 0 in
/// canonical axes, so (ρ₁ρ₂, −(ρ₁+ρ₂), 1) is the null vector of the second-order structure tensor,
/// the products of (f_xx, f_xu, f_uu) averaged over a window and summed over channels; ρ₁, ρ₂ are
/// the roots of ρ² − (ρ₁+ρ₂) ρ + ρ₁ρ₂. Confidence is (1 − λ₃/λ₂)·λ₂/(λ₂ + n²) in [0, 1], λ₂ and λ₃
/// the middle and smallest eigenvalue, n² the energy of the noise: near 0 for one orientation,
/// whose roots mean nothing.
/// Source: Aach, Mota, Stuke, Mühlich, Barth 2006 [AMSMB06]; Wanner and Goldluecke 2013 [Ano13].
///
/// Departures from it:
/// - Derivatives are matched to each other (after Farid and Simoncelli 2004 [FS04], but exact up to
///   the sixth order): five taps along views and image, three where the grid has three or four
///   views. They are taken where they fit into the grid: the outer views integrate over the
///   derivatives of the inner ones.
/// - The derivatives are whitened: the eigenvalues of pure noise are then equal and the eigenvector
///   is the most likely one.
/// - The EPI is sheared by whole pixels, so that the mean of both disparities lies within half a
///   pixel of upright, where derivatives are most accurate; the most confident shear wins. Each
///   view is integrated in coordinates of its own.
/// - The smallest eigenvalue is found by Newton's steps from 0 on the characteristic polynomial of
///   the tensor divided by its trace, which rise monotonically: stable in float32.
///
/// Not thread-safe: use one object per thread.
class DoubleOrientation {
 public:
  enum class Direction { Horizontal, Vertical };

  /// A rectangle of image pixels seen by one row (horizontal EPIs) or column of cameras.
  struct Task {
    int camera_line = 0;
    PixelIndex begin;
    int height = 0, width = 0;          ///< At most `tile()`.
    int first_view = 0, last_view = 0;  ///< Wanted views [first, last) of the line.
  };

  /// Takes a run of results of one view: pixels (begin.y, begin.x …). Confidence 0 = none; the
  /// disparities are then 0.
  using Sink = std::function<void(int view, PixelIndex begin, int count, const float* near,
                                  const float* far, const float* confidence)>;

  /// Views that a grid axis must have.
  static constexpr int kMinViews = 3;
  static constexpr int kMaxViews = 160;

  /// Throws InvalidInput if the grid has too few or too many views in that direction.
  DoubleOrientation(const LightField& light_field, Direction direction, const TensorScales& scales,
                    const DoubleSearch& search);
  ~DoubleOrientation();
  DoubleOrientation(DoubleOrientation&&) noexcept;

  /// The tile that a task may have at most.
  [[nodiscard]] static PixelIndex tile(Direction direction);

  void estimate(const Task& task, const Sink& sink);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What the device needs to measure two orientations as DoubleOrientation does.
struct DevicePasses {
  std::vector<cuda::DoublePass> passes;  ///< Of the directions that have enough views.
  cuda::DoubleShears shears;
};

[[nodiscard]] DevicePasses device_passes(const LightField& light_field, const TensorScales& scales,
                                         const DoubleSearch& search);

/// Double orientation of every ray, raw: meaningless where confidence is low. Confidence is stored
/// in 1/255, because three float maps of all views would not fit beside the results.
struct DoubleLayers {
  ViewStack<float> near;
  ViewStack<float> far;
  ViewStack<std::uint8_t> confidence;
};

/// Throws InvalidInput if neither axis of the grid has three views.
void require_double_grid(const LightField& light_field);

/// Measures horizontal and vertical EPIs (where the grid has the views) and merges them: where both
/// directions agree within 0.3 px in both layers their mean weighted by confidence^8, else the more
/// confident one. Covers the block; a device only blocks of whole views. Throws as
/// `require_double_grid`, Cancelled.
[[nodiscard]] DoubleLayers measure_double_layers(const LightField& light_field,
                                                 const TensorScales& scales,
                                                 const DoubleSearch& search, const MapBlock& block,
                                                 const Progress& progress,
                                                 Device device = Device::Cpu);

}  // namespace episcope
