// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/hdf5/hdf5_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace episcope::io {

/// The group in which a file without LF at its root holds one, with GT_DEPTH or the two layers of
/// it beside it and in the form of the archive; empty if there is none, or if there are several.
[[nodiscard]] std::string archive_group(const Hdf5Input& file);

/// A file of the archive, with that group in the place of the root. Throws IoError.
[[nodiscard]] std::shared_ptr<const Hdf5Input> open_archive(const std::filesystem::path& path);

}  // namespace episcope::io
