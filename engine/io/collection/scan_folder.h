// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/collection/collection_entry.h"
#include "engine/io/collection/folder_listing.h"

#include <filesystem>
#include <optional>

namespace episcope::io {

/// Which light fields a folder holds, by the table of readers (reader.h): itself, if it is a scene
/// folder, or those of its files that are light fields each. What cannot be opened is an entry with
/// a problem. Reads headers only.
[[nodiscard]] FolderRecord scan_folder(const FolderListing& listing);

/// The light field that a file is by itself; none if it is a part of one, or none at all.
[[nodiscard]] std::optional<CollectionEntry> scan_file(const std::filesystem::path& file);

}  // namespace episcope::io
