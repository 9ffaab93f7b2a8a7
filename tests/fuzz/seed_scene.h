// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <filesystem>
#include <string>

namespace episcope::fuzz {

/// A tiny light field with truth, labels and scribbles: 3×3 views of 6×8 px.
[[nodiscard]] const Scene& seed_scene();

/// It by the writer of this id ("archive", "npz"); a folder, or a file of this name.
void write_seed(const std::string& writer, const std::filesystem::path& path);

/// Finds its reader and looks at its headers.
void look_at_light_field(const std::filesystem::path& path);

/// The same, and opens it.
void open_light_field(const std::filesystem::path& path);

}  // namespace episcope::fuzz
