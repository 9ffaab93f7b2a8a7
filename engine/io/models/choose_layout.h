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

/// Whether its shape, or what its file states, is that of a light field.
[[nodiscard]] bool can_be_light_field(const ArrayEntry& entry);

/// Whether it is called lf, light_field, views or the like.
[[nodiscard]] bool has_light_field_name(const ArrayEntry& entry);

/// Whether words of its name are those of maps, or of what describes a camera.
[[nodiscard]] bool has_other_name(const ArrayEntry& entry);

/// The entries of equal right that can be the light field, among those that have the axes that
/// `axes` states or, if it is empty, the shape of one: as `find_light_field`; empty if none can.
[[nodiscard]] std::vector<const ArrayEntry*> light_fields_of(const ArrayFile& file,
                                                             const std::string& axes);

/// The entry that holds the light field: the one that `dataset` names; else, among those that have
/// the axes that `axes` states or, if it is empty, the shape of one, the only one with five
/// axes and no name of a map, or called lf, light_field, views or the like, or the only one that
/// can be a light field. Null if none can be. Throws Undecided where several can be, InvalidInput
/// for a `dataset` that is not there.
[[nodiscard]] const ArrayEntry* find_light_field(const ArrayFile& file, const std::string& dataset,
                                                 const std::string& axes);

/// As `axes` states, else as the file states, else by shape; where that leaves several meanings,
/// the only one in which views move along both axes of the grid, or whose pictures are as like each
/// other as those of a list of views. Throws IoError if that leaves no
/// meaning, Undecided if several.
[[nodiscard]] ChosenLayout choose_layout(const ArrayFile& file, const ArrayEntry& entry,
                                         const std::string& axes);

/// Which of rows and columns of views come first is then checked by parallax, unless it was stated:
/// between columns, points move along rows of pixels. Exchanges them if that fits clearly better.
/// Throws IoError.
void check_layout(const ArrayInput& array, IndexOrder order, ChosenLayout& chosen,
                  const Progress& progress);

/// What moves between the centre and its neighbours along each axis of views.
struct Parallax {
  AxisEvidence along_u;
  AxisEvidence along_v;
};

/// Reads three views at most, and of them the middle. Throws IoError.
[[nodiscard]] Parallax measure_parallax(const ArrayInput& array, const ArrayLayout& layout);

/// Of two axes of a layout one is perhaps that of channels: whether there is motion along the other
/// one, of views, and clearly less that motion explains along this one.
[[nodiscard]] bool are_rather_channels(const AxisEvidence& of_channels,
                                       const AxisEvidence& of_views);

}  // namespace episcope::io
