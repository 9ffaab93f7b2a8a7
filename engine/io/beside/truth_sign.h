// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/map_scale.h"
#include "engine/io/beside/near_side.h"

#include <string>

namespace episcope::io {

/// Whether larger values of a disparity map are nearer.
struct TruthSign {
  bool is_negated = false;  ///< Values are to be negated.
  bool is_known = false;    ///< Else it is only assumed.
  std::string evidence;     ///< For reports; empty if values are assumed to be as they should.
};

/// What `side` says; else what hides what in the views (`check_sign`), in the order that
/// `explanation` found for them. Where that is not decided either, values are negated if only that
/// puts the views into the order in which they are stored, since maps of the other sign are more
/// common than views that run backwards along every axis.
[[nodiscard]] TruthSign find_truth_sign(const LightField::Samples& samples, const NearSide& side,
                                        const Explanation& explanation);

}  // namespace episcope::io
