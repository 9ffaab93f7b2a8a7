// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/io/formats/collection.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// The light fields below `input` if it is a folder that holds some and is none itself; else empty.
/// Those that cannot be opened are among them. Throws IoError, Cancelled.
[[nodiscard]] std::vector<io::CollectionEntry> collection_at(const std::string& input,
                                                             const io::OpenOptions& options,
                                                             const Progress& progress);

/// Thrown for a folder that was to be opened as a light field but holds several.
class IsCollection : public IoError {
 public:
  IsCollection(const std::filesystem::path& folder, std::size_t count);
};

/// Names for files made from entries, each unique: the name of the scene, preceded by as many of
/// its folders as it takes, joined by "_".
[[nodiscard]] std::vector<std::string> unique_names(
    const std::vector<io::CollectionEntry>& entries);

/// Longer side of thumbnails at most, px.
inline constexpr int kThumbnailSide = 160;

/// The center view, RGB, scaled down by area means. Kept as a PNG in `cache_folder`, up to a few
/// thousand of them; empty = none is kept. Reads no more than it must: as a rule the center view
/// alone. Throws IoError, Cancelled.
[[nodiscard]] Image<std::uint8_t> scene_thumbnail(const io::CollectionEntry& entry,
                                                  const std::filesystem::path& cache_folder,
                                                  const Progress& progress);

}  // namespace episcope
