// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/beside/fitted_meaning.h"
#include "engine/io/beside/map_scale.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Values of disparity as stored, of which the report speaks as `name`.
struct NamedValues {
  DisparityField& field;
  std::string name;

  /// The view by which the others are judged.
  [[nodiscard]] ViewIndex at(GridShape grid) const;
};

/// Multiplies the values of all views.
void scale_values(DisparityField& field, double factor);

/// The unit of a disparity that explains the views (`settle_unit`). Where none does well, and scale
/// and offset found from the views do clearly better (`fit_meaning`), they are applied to the
/// field, a warning says so, and the unit is px. Zeros that stand for unknown become invalid.
/// Precondition: `units` is not empty.
[[nodiscard]] SettledUnit settle_values(const LightField::Samples& samples,
                                        const std::vector<MapUnit>& units, NamedValues values,
                                        ConventionReport& report);

/// Turns values that may be of any of these forms and of any scale into disparity, and tells the
/// report. Nothing, and the field as it is, if the views do not tell what they mean.
[[nodiscard]] std::optional<FittedMeaning> settle_unknown_values(
    const LightField::Samples& samples, const std::vector<ValueForm>& forms, NamedValues values,
    ConventionReport& report);

}  // namespace episcope::io
