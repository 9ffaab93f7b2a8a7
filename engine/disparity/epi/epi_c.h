// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/denoise.h"
#include "engine/disparity/epi/epi_l.h"
#include "engine/disparity/epi/line_check.h"

namespace episcope {

/// Parameters of EPI_C: of the ordering along lines, and those of EPI_S.
struct EpiCParameters {
  double fall = 0.1;
  double rise = 0.01;
  double softness = 0.05;
  int sweeps = 4;
  LineCheck line_check = {};
  /// All views together need less smoothing than each by itself.
  DenoiseParameters denoising{.lambda = 0.06, .edge_strength = 30};
  EpiLParameters tensor = {};
};

[[nodiscard]] Schema<EpiCParameters> epi_c_schema();

/// EPI_C: the estimate of EPI_L denoised for all views at once, with the occlusion ordering.
///
/// In an opaque scene the line of a visible point meets, in any other view, the same point or
/// something nearer: with D u = u(x − d, u + 1) − u(x, u) and its like for the four neighbours of a
/// view in the camera grid, D u ≥ 0. The energy over all views is
///   Σ λ g |∇u| + ½ w (u − f)² + Σ ψ(D u),   ψ(a) = μ₊ max(a, 0) + μ₋ max(−a, 0),
/// smoothed within ε (OrderingPenalty): what violates the ordering costs μ₋ a pixel, what it allows
/// a tenth. f and g are as in EPI_S; w as well, but from a coherence lowered where the views
/// contradict the estimate (reduce_confidence), unless `check_lines` is off. Before the first sweep
/// rays that other views see through give way (replace_occluded).
///
/// Solved by block descent: views are coloured like a chequerboard, so that all neighbours of a
/// view have the other colour; in turn one colour stays and each view of the other minimises its
/// part with ψ replaced by its quadratic majoriser, which is TvL2Solver's problem with other f and
/// w. For fixed lines every step lowers the energy, since ψ is smooth and TV separates over views;
/// lines are laid anew through the current u at each step. A joint primal-dual iteration of all
/// views would move 2 GB a time and need hundreds.
///
/// Defaults: λ = 0.06, p = 6, β = 30. Of the sets tried (λ 0.03 to 0.3, p 2 to 12, β 15 to 30) on
/// edge, bars, objects and demo with noise of 0, 2 and 5/255 the one that is better than EPI_S on
/// all, mean over views and every single view looked at: at 96 px its MSE is 0.36 times that of
/// EPI_S in the centre view, 0.53 times over all (geometric means). β = 20 has less on average
/// (0.30) but spoils single views, on whose edge a column of pixels is undecided; p = 4 has fewer
/// pixels that are wrong by 0.07 px on slanted ground (still_life 4 %, now 6 %).
///
/// The centre view alone needs all others as well: they are computed and dropped.
/// The form of the constraint in the original paper was not recovered.
/// Reference: Goldluecke and Wanner 2013 [GW13]; Wanner, Meister, Goldluecke 2013 [WMG13].
[[nodiscard]] Estimate estimate_epi_c(const LightField& light_field,
                                      const EpiCParameters& parameters, ViewSelection views,
                                      const Progress& progress);

/// The part after EPI_L alone: improves `estimate.field`, a first guess, such that it follows
/// `observed` with weights from `estimate.confidence`; both cover all views. Returns the largest
/// relative duality gap of the last sweep, 0 without sweeps. At `progress.finish_requested()` views
/// that are not reached stay as they are. Throws Cancelled.
double denoise_with_ordering(const LightField& light_field, const EpiCParameters& parameters,
                             const ViewStack<float>& observed, Estimate& estimate,
                             const Progress& progress);

/// Share in [0, 1] of the lines to neighbouring views, within the image, that violate the ordering:
/// D u < −0.05 px at u itself. `disparity` covers all views. Throws Cancelled.
[[nodiscard]] double ordering_violations(const ViewStack<float>& disparity,
                                         const Progress& progress);

[[nodiscard]] Estimator epi_c_estimator();

}  // namespace episcope
