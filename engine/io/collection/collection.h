// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/collection/collection_entry.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace episcope::io {

struct CollectionOptions {
  /// File that keeps what headers told (CollectionCache); empty = none.
  std::filesystem::path cache_file{};
  /// Called for every light field as soon as it is found, with the results known by then.
  std::function<void(const CollectionEntry&)> on_entry{};
};

/// Every light field in `root` and below, any form, any depth, in the order of their paths; `root`
/// may be a light field itself, or a file. A scene folder is one light field and is not searched
/// further; several light-field files in one folder are one each. Hidden folders are left out, and
/// a folder that several links lead to is searched once. Result files are given to the light field
/// that they name, that shares their folder, or whose name they have. What cannot be opened is
/// there with its problem. Reads headers only. Throws IoError if there is no `root`, Cancelled.
[[nodiscard]] std::vector<CollectionEntry> find_light_fields(const std::filesystem::path& root,
                                                             const CollectionOptions& options,
                                                             const Progress& progress);

}  // namespace episcope::io
