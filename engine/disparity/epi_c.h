// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/line_check.h"
#include "engine/disparity/view_samples.h"

namespace episcope {

/// Replaces the disparity of rays that other views see through. In an opaque scene the line of a
/// visible point meets, in any other view, the same point or something nearer. A ray whose line
/// meets something farther by more than 0.1 px, of at least its own confidence, in a quarter of
/// up to 16 views (four on each side in its row and column of the grid), at least two, takes the
/// median of the disparities met there, unless that contradicts the samples: its residual
/// (LineResiduals) may exceed the residual of the ray's own disparity by 0.3·(n² + 1/255²) at most,
/// n² the residual noise of the center view (residual_noise). All rays are judged by the
/// disparities before the call, so the order of processing does not matter.
///
/// This moves an edge that all views show with the motion of the background, where no step of a
/// view-by-view descent would lower the number of violations. Confidence and samples must count:
/// otherwise thin bars that some views have lost are eaten away.
/// Both stacks have the same shape and cover all views; `disparity` is finite. Memory: 4 bytes per
/// ray. Returns the number of rays changed. Throws Cancelled.
long replace_occluded(const PackedViews& packed_views, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress);

/// Packs the views first and replaces rays on a device. Throws DeviceFailure, Cancelled.
void replace_occluded(const LightField& light_field, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress, Device device);

/// Parameters of EPI_C: the ordering along lines, and the parameters of EPI_S.
struct EpiCParameters {
  double fall = 0.1;
  double rise = 0;
  double softness = 0.05;
  int sweeps = 2;
  bool replace_occluded = true;
  LineCheck line_check = {};
  /// All views together need less smoothing than each by itself.
  DenoiseParameters denoising{.lambda = 0.05, .weight_power = 4, .edge_strength = 15};
  EpiLParameters tensor{.cross_scale = kCrossScaleOfDenoised};
};

/// EPI_C: the estimate of EPI_L, denoised for all views at once under an occlusion ordering.
///
/// In an opaque scene the line of a visible point meets, in any other view, the same point or
/// something nearer: with D u = u(x − d, u + 1) − u(x, u), and likewise for the four neighbors of
/// a view in the camera grid, D u ≥ 0. The energy over all views is
///   Σ λ g |∇u| + ½ w (u − f)² + Σ ψ(D u),   ψ(a) = μ₊ max(a, 0) + μ₋ max(−a, 0),
/// smoothed within ε (OrderingPenalty): a violation of the ordering costs μ₋ per pixel, a permitted
/// jump nothing. f, g and w are as in EPI_S (check_lines), except for λ and the least w. Before
/// the first sweep, rays that other views see through are replaced (replace_occluded) unless the
/// samples contradict that.
///
/// Solved by block descent: views are colored like a checkerboard, so that all neighbors of a
/// view have the other color. In turn, one color is fixed and each view of the other minimizes
/// its part with ψ replaced by its quadratic majorizer, which is TvL2Solver's problem with other f
/// and w. For fixed lines that lowers the energy, since ψ is smooth and TV is separable over views.
/// Lines are traced anew through the current u at each step; of lines that move with u the energy
/// is not bound to fall, but it does with every sweep on the scenes of the tests.
///
/// Defaults: λ = 0.05, p = 4, β = 15, μ₊ = 0, two sweeps (tests/accuracy/tuning.md).
///
/// The profile `paper` neither weighs data or variation nor checks lines nor replaces rays, and
/// begins with EPI_L as published. Published is that EPI_L is denoised on EPIs by a total variation
/// along the lines, with a constraint that an edge moves with the nearer of its sides, all of it
/// convex; not the form of the constraint. Chosen: the energy above with μ₊ = 0.01, four sweeps,
/// λ = 0.1.
///
/// The center view alone needs all other views as well: they are computed and dropped. The form of
/// the constraint in the original paper was not recovered.
/// Reference: Goldluecke and Wanner 2013 [GW13]; Wanner, Meister, Goldluecke 2013 [WMG13].
[[nodiscard]] Estimate estimate_epi_c(const LightField& light_field,
                                      const EpiCParameters& parameters, ViewSelection views,
                                      const Progress& progress, Device device = Device::Cpu);

/// Only the part after EPI_L: improves `estimate.field`, a first guess, to follow `observed` with
/// weights from `estimate.confidence`; both cover all views. Returns the largest relative duality
/// gap of the last sweep, 0 without sweeps. At `progress.finish_requested()` the views not yet
/// reached stay as they are. Throws Cancelled.
double denoise_with_ordering(const LightField& light_field, const EpiCParameters& parameters,
                             const ViewStack<float>& observed, Estimate& estimate,
                             const Progress& progress, Device device = Device::Cpu);

/// Share in [0, 1] of the lines to neighboring views, within the image, that violate the ordering:
/// D u < −0.05 px at u itself. `disparity` covers all views. Throws Cancelled.
[[nodiscard]] double ordering_violations(const ViewStack<float>& disparity,
                                         const Progress& progress, Device device = Device::Cpu);

[[nodiscard]] Estimator epi_c_estimator();

}  // namespace episcope
