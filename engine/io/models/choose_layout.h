// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/view_axes.h"

#include <string>
#include <vector>

namespace episcope::io {

/// What the axes of a light field mean, and why.
struct ChosenLayout {
  ArrayLayout layout;
  std::string reason;   ///< "by shape; parallax agrees (12.3 σ)".
  std::string warning;  ///< A sentence where a doubt remains; else empty.
};

/// Whether the shape, or the axes that the file states, fit a light field.
[[nodiscard]] bool can_be_light_field(const ArrayEntry& entry);

/// Whether the array is called lf, light_field, views or similar.
[[nodiscard]] bool has_light_field_name(const ArrayEntry& entry);

/// Whether words of the name denote maps or camera parameters.
[[nodiscard]] bool has_other_name(const ArrayEntry& entry);

/// Candidates for the light field of equal rank, chosen as `find_light_field` does; empty if there
/// are none.
[[nodiscard]] std::vector<const ArrayEntry*> light_fields_of(const ArrayFile& file,
                                                             const std::string& axes);

/// Finds the entry that holds the light field. `dataset` names it. Otherwise its shape must fit
/// `axes` or, if empty, a light field. Preferred is the only one with five axes and no name of a
/// map, then the only one called lf, light_field or views, then the only candidate. Null if there
/// is none. Throws Undecided where several can be, InvalidInput for a `dataset` that is not there.
[[nodiscard]] const ArrayEntry* find_light_field(const ArrayFile& file, const std::string& dataset,
                                                 const std::string& axes);

/// Chooses the layout that `axes` states, else the one that the file states, else by shape. Among
/// several, it takes the only one in which views move along both axes of the grid, or whose
/// pictures resemble each other like a list of views. Throws IoError if that leaves no meaning,
/// Undecided if several.
[[nodiscard]] ChosenLayout choose_layout(const ArrayFile& file, const ArrayEntry& entry,
                                         const std::string& axes);

/// Checks by parallax whether rows or columns of views come first, unless that was stated: between
/// columns, points move along rows of pixels. Exchanges them if that fits clearly better. Throws
/// IoError.
void check_layout(const ArrayInput& array, IndexOrder order, ChosenLayout& chosen,
                  const Progress& progress);

/// Compares the center view with its neighbor along each axis: reads the middle of at most three
/// views. Throws IoError.
[[nodiscard]] ViewAxes measure_parallax(const ArrayInput& array, const ArrayLayout& layout);

/// Whether an axis holds channels rather than views: motion explains the other axis, and clearly
/// less of this one.
[[nodiscard]] bool are_rather_channels(const AxisEvidence& of_channels,
                                       const AxisEvidence& of_views);

}  // namespace episcope::io
