// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/io/models/order/order_check.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Meaning of the numbers of a disparity map: times `factor` they are px per view step.
struct MapUnit {
  double factor = 1;
  std::string text;  ///< "px per view step", "px over the 8 steps of the whole baseline", …
};

/// Units in use for maps of these views, the most common first.
[[nodiscard]] std::vector<MapUnit> common_units(GridShape grid, int width);

/// How well a map explains the neighbors of its view.
struct Explanation {
  double error = 0;  ///< Mean grey error (0 … 255) after warping, each axis in its better order,
  double unwarped = 0;         ///< and without warping.
  bool is_transposed = false;  ///< Rows and columns of views are exchanged.
  bool reversed_u = false;     ///< The better order of each axis of the image,
  bool reversed_v = false;     ///< x and y.

  [[nodiscard]] bool is_good() const { return error < 0.9 * unwarped; }
};

/// Warps the neighbors of view `at` with the map times `factor`, in the stored order of views and
/// with rows and columns exchanged. Linear in the pixels.
[[nodiscard]] Explanation explain_views(const LightField::Samples& samples, ViewIndex at,
                                        const DisparityView& map, double factor);

/// Unit that explains the views: the first one unless another explains them clearly better.
struct SettledUnit {
  MapUnit unit;
  Explanation explanation;
  Explanation first;  ///< By the first of the units, for comparison.
};
/// Precondition: `units` is not empty.
[[nodiscard]] SettledUnit settle_unit(const LightField::Samples& samples, ViewIndex at,
                                      const DisparityView& map, const std::vector<MapUnit>& units);

/// Whether larger or smaller values of a disparity map occlude the others. Where two pixels of a
/// view fall on the same pixel of another view, that view shows the nearer one.
struct OcclusionOrder {
  double larger = 0;   ///< Mean grey error (0 … 255) of the pixels of larger disparity,
  double smaller = 0;  ///< and of pixels of smaller disparity.
  int points = 0;      ///< Pairs that were compared.
  double doubt = 0;    ///< Standard error of the difference of these means.

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool larger_is_nearer() const { return larger < smaller; }
};

/// Moves view `at` by the map times `factor` into views up to four steps away, in the order of
/// views that `explanation` found. Compares pairs of clearly different grey: first by 15 levels; if
/// that decides nothing, by more than noise. The order of views alone does not tell near from far:
/// reversing it together with the signs moves every pixel to the same place. Linear in the pixels.
[[nodiscard]] OcclusionOrder find_occlusion_order(const LightField::Samples& samples, ViewIndex at,
                                                  const DisparityView& map, double factor,
                                                  const Explanation& explanation);

/// What the nearer values do, for reports: "hide others in other views (…)".
[[nodiscard]] std::string hiding_text(const OcclusionOrder& side);

/// Whether larger values of a disparity map are nearer.
struct TruthSign {
  bool is_negated = false;  ///< Values are to be negated.
  bool is_known = false;    ///< Else it is only assumed.
  std::string evidence;     ///< For reports; empty if values are assumed to be as they should.
};

/// Determines the sign of a map: by `side`, else by occlusion in the views (`check_sign`), in the
/// order that `explanation` found for them. If that is undecided too, values are negated only if
/// this puts the views into their stored order: maps of the other sign are more common than views
/// that run backwards along every axis.
[[nodiscard]] TruthSign find_truth_sign(const LightField::Samples& samples,
                                        const OcclusionOrder& side, const Explanation& explanation);

/// Stored disparity values, called `name` in the report.
struct NamedValues {
  DisparityField& field;
  std::string name;
};

/// Multiplies the values of all views.
void scale_values(DisparityField& field, double factor);

/// Determines the unit of a disparity from the views (`settle_unit`). Turns maps that were stored
/// in another order of pixels back (`far_better_turn`), with a warning. Marks values that stand for
/// unknown as invalid. Precondition: `units` is not empty.
[[nodiscard]] SettledUnit infer_units(const LightField::Samples& samples,
                                      const std::vector<MapUnit>& units, NamedValues values,
                                      ConventionReport& report);

/// Marks pixels as invalid, in all views, whose value stands for unknown: 0, −1, or the largest or
/// smallest one if it is whole (65535, 1e10, −999), if many pixels have exactly that, and the
/// nearest other values explain the neighbors of view `at` clearly better there, by the values
/// times `factor`. Warns of it. Returns whether there are such values. Linear in the pixels.
bool drop_unknown_values(const LightField::Samples& samples, ViewIndex at, double factor,
                         NamedValues values, ConventionReport& report);

}  // namespace episcope::io
