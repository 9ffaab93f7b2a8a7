// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope::io {

/// What hides what at depth edges, as seen along one or both view axes.
struct OcclusionVotes {
  /// Points where, by the order of views as stored, the nearer of two surfaces hides the farther
  /// one, and points where it is the other way round, as if the axis were reversed.
  long long forward = 0;
  long long reversed = 0;
  /// Squares of 16×16 px in which most of the points say so: points side by side are no
  /// independent evidence.
  int forward_squares = 0;
  int reversed_squares = 0;

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool says_reversed() const { return reversed_squares > forward_squares; }
  /// The votes if the axis is reversed.
  [[nodiscard]] OcclusionVotes turned() const {
    return {reversed, forward, reversed_squares, forward_squares};
  }
  OcclusionVotes& operator+=(const OcclusionVotes& more);
};

/// Votes of every view axis; none for an axis of fewer than three views.
struct OcclusionByAxis {
  OcclusionVotes u;
  OcclusionVotes v;
};

/// Two points of the view at the centre of the grid whose disparities lead them to the same place
/// of another view, and which in the opposite view are seen side by side, each with its own motion:
/// the one that is seen in that place is the nearer one. If it has the larger disparity, the axis
/// has the canonical direction. Looks at five views of each axis, reduced to at most `side` px, of
/// them at the middle of 512×512 px. Linear in the range of disparities. Throws Cancelled.
[[nodiscard]] OcclusionByAxis count_occlusions(const LightField::Samples& samples, int side,
                                               const Progress& progress);

}  // namespace episcope::io
