// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/line_matches.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/order/warp_check.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Order of views that a format suggests, before it is checked.
struct ExpectedOrder {
  ViewFlip flip;
  std::string reason;  ///< "raw files of the archive store h reversed", …
  /// Rows and columns are certain: motion along the other axis is reported, not corrected.
  bool are_axes_known = false;
  /// The sign of the truth is only assumed: negated, it would fit the opposite order as well.
  bool is_truth_sign_assumed = false;
  /// Poses of cameras tell the order of views, and so near from far.
  bool is_of_poses = false;
  /// Motion between views does not tell rows from columns: only truth can check the order.
  bool are_axes_unclear = false;
};

/// The view by whose map the others are judged: the center, or the first of those there are.
[[nodiscard]] inline ViewIndex told_view(const DisparityField& field, GridShape grid) {
  return field.contains(grid.center()) ? grid.center() : field.disparity.first();
}

/// Disparity map as stored, by which neighboring views can be warped.
struct OrderEvidence {
  ViewIndex at;
  DisparityView disparity;
  std::optional<WarpErrors> errors{};  ///< Of `warp_errors` with it, if known.
};

struct OrderFinding {
  ViewFlip flip;
  std::string order;              ///< As ConventionReport::order,
  std::string check;              ///< `order_check`
  bool was_chosen = false;        ///< and `order_was_chosen`
  bool are_axes_unclear = false;  ///< and `are_axes_unclear`.
  std::string sign;               ///< As ConventionReport::sign
  std::string sign_check;         ///< and `sign_check`.
  std::vector<std::string> warnings;
};

/// Determines which view axes to reverse. Truth decides if there is any: neighbors are warped by
/// it. It tells near from far only if its sign is known. Without truth, the sign of the correlation
/// of EPI slopes tells whether the axes agree, and occlusion whether near and far do. What remains
/// open is as expected. A `choice` other than Auto takes precedence but is checked; a contradiction
/// becomes a warning. Nothing is reversed yet. Throws Cancelled.
[[nodiscard]] OrderFinding find_order(const LightField::Samples& samples,
                                      const std::vector<OrderEvidence>& truth,
                                      const ExpectedOrder& expected, Flip choice,
                                      const Progress& progress);

/// Choice that reverses these axes.
[[nodiscard]] Flip flip_choice(ViewFlip flip);

/// Order of pixels in which a program may have written maps, other than by rows from top to bottom.
struct MapTurn {
  bool is_transposed = false;
  bool flips_y = false;
  bool flips_x = false;
  const char* text = "";  ///< Such as "rows from bottom to top".
};

/// Undoes the turn in all maps.
[[nodiscard]] DisparityField turned_back(const DisparityField& field, const MapTurn& turn);

/// The turn whose undoing leaves the least of the error, and less than 0.6 of it: maps as they are
/// stored may explain views not much worse than turned ones, which are wrong then. Rows and columns
/// are exchanged in square maps only.
[[nodiscard]] std::optional<MapTurn> far_better_turn(
    const DisparityView& map, double error,
    const std::function<double(const DisparityView&)>& error_of);

/// Warning about `MapTurn::text` or `UprightTruth::undone`.
[[nodiscard]] std::string turned_back_text(const std::string& turn);

/// Truth in the usual order of pixels.
struct UprightTruth {
  std::string undone;  ///< Such as "rows from bottom to top"; empty = the truth was upright.
  std::optional<WarpErrors> errors{};  ///< Of warping by the map of one view; none without truth.
};

/// Corrects truth with rows from bottom to top (PFM of a program that forgets its order), mirrored
/// truth, and square truth with rows and columns exchanged (an array by MATLAB). Such truth hardly
/// explains the views. A turn is undone in all maps if it explains the center view, or the only
/// one, far better: its error after warping is below 0.6 of the error as stored and of the error
/// without warping.
[[nodiscard]] UprightTruth put_truth_upright(const LightField::Samples& samples,
                                             DisparityField& field);

/// Directions of the view axes according to occlusion.
struct SignFinding {
  ViewFlip flip;            ///< The order that was asked about, or what occlusion makes of it.
  bool is_decided = false;  ///< Whether near and far are told apart.
  std::string evidence;     ///< With numbers: what was counted, and for which order.
};

/// Determines which axes are reversed from occlusion, at several resolutions until it is clear.
/// `flip` is the order that is known or expected so far. With `are_axes_related` it is certain
/// whether the axes agree, and they are judged together; else each axis by itself. Throws
/// Cancelled.
[[nodiscard]] SignFinding check_sign(const CoarseMotion& coarse, ViewFlip flip,
                                     bool are_axes_related, const Progress& progress);

}  // namespace episcope::io
