// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/collection/collection_entry.h"

#include <cstdint>
#include <filesystem>

namespace episcope {

/// Longer side of thumbnails at most, px.
inline constexpr int kThumbnailSide = 160;

/// The centre view, RGB, scaled down by the means of areas. Kept as a PNG in `cache_folder`, which
/// holds those of the last few thousand light fields; empty = none is kept. Reads no more than it
/// must: as a rule the centre view alone. Throws IoError, Cancelled.
[[nodiscard]] Image<std::uint8_t> scene_thumbnail(const io::CollectionEntry& entry,
                                                  const std::filesystem::path& cache_folder,
                                                  const Progress& progress);

}  // namespace episcope
