// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/view_names.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// The views of folders inside of `folder` that hold one picture each, called the same in all
/// ("view_03_04/rgb.png"), as renderers write them, beside maps of that view. Their names have the
/// numbers of rows and columns, or one number after a word for a view or a camera: folders that are
/// merely counted are scenes of their own. Nothing if `folder` holds images itself. A pattern such
/// as "cam_{index}/0001.png" says which folders and which picture in them are meant, beside others.
/// Throws InvalidInput for a pattern that is none.
[[nodiscard]] std::optional<ViewNames> find_view_folders(const std::filesystem::path& folder,
                                                         const std::string& pattern = {});

/// Likewise the views called `picture`, whatever else the folders hold.
[[nodiscard]] std::optional<ViewNames> find_folders_with(const std::filesystem::path& folder,
                                                         const std::string& picture);

}  // namespace episcope::io
