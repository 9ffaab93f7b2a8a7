// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// A plane through one pixel: its value there, and its slope along x and y, per px.
struct Plane {
  float value = 0;
  float dx = 0;
  float dy = 0;
  /// At `x` and `y` px from that pixel.
  [[nodiscard]] float at(float y, float x) const { return value + dy * y + dx * x; }
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// A plane for every pixel: E = Σ ρ(x, d_x) + Λ Σ g_xy min(½ (|P_x(y) − d_y| + |P_y(x) − d_x|), τ),
/// the second sum over pairs of the 8 neighbours (diagonal ones count 1/√2), where P_x(y) is the
/// plane of x continued to y, d its value at its own pixel, and g_xy = √(g_x g_y). Planes that
/// continue each other cost nothing whatever their slope; a jump or a bend costs τ at most.
struct PlaneProblem {
  VolumeView<const float> cost;  ///< ρ at equidistant values, `[y][label][x]`, finite; ≥ 4 labels.
  float first = 0;               ///< Value of label 0.
  float step = 1;                ///< From one label to the next, > 0.
  ImageView<const float> g;      ///< `[y][x]` in (0, 1]. Empty = 1.
  float smoothness = 1;          ///< Λ ≥ 0, of the unit of costs per unit of value.
  float truncation = 1;          ///< τ > 0.
};

struct PlaneOptions {
  int sweeps = 4;
  float value_noise = 0.1F;   ///< Of the first sweep's random candidates; halved by every sweep.
  float slope_noise = 0.05F;  ///< Likewise.
  unsigned seed = 1;
};

/// Lowers E from `planes` on by PatchMatch: every pixel in turn takes the best of its own plane,
/// its eight neighbours' continued to it, its own with a slope of central differences, and
/// two drawn around its own. Costs are interpolated between labels by cubics (Catmull-Rom), values
/// kept within the labels. Pixels are visited in four groups (rows and columns even or odd): no
/// two of a group are neighbours, so that rows can run in parallel, E never rises, and the result
/// does not depend on the number of threads.
/// A local search: values settle well before slopes, which may stay near those of the start.
/// Returns E. Ends after the current sweep at `progress.finish_requested()`. Throws InvalidInput on
/// wrong shapes, Cancelled.
/// Source: Bleyer, Rhemann, Rother 2011 [BRR11]; the order of visits is our own.
double improve_planes(const PlaneProblem& problem, const PlaneOptions& options,
                      const Progress& progress, ImageView<Plane> planes);

/// E of some planes. Throws InvalidInput as above.
[[nodiscard]] double plane_energy(const PlaneProblem& problem, ImageView<const Plane> planes);

}  // namespace episcope
