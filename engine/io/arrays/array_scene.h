// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/arrays/array_file.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/open_options.h"
#include "engine/io/open/scene_probe.h"

#include <functional>
#include <span>

namespace episcope::io {

/// Keys of the reading options that every reader of arrays knows.
[[nodiscard]] std::span<const char* const> array_options();

/// What the shape of the light field of a file of arrays tells. Throws NoLightField if none of them
/// can be one; IoError, Undecided.
[[nodiscard]] SceneProbe probe_arrays(const ArrayFile& file, const OpenOptions& options);

/// What a file holds beside arrays that `read_array_maps` knows.
struct OtherArrays {
  std::function<bool(const ArrayEntry&)> owns;  ///< Arrays that it alone reads.
  /// Adds them to the parts, which hold samples and maps in the order of the file.
  std::function<void(SceneParts&, ConventionReport&, const Progress&)> add;
};

/// Reads the light field of a file of arrays, and the maps beside it; then, if given, what else
/// there is. A picture of the centre view is given first. Throws IoError, InvalidInput for options
/// that do not fit, Cancelled.
[[nodiscard]] Scene read_array_scene(const ArrayFile& file, const char* reader,
                                     const OpenOptions& options, const Progress& progress,
                                     const OtherArrays& more = {});

}  // namespace episcope::io
