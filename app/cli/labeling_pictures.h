// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/pictures.h"

#include <filesystem>
#include <string>

namespace episcope::cli {

/// A picture of a file of labels that `label` wrote: `what` is "labels" in their own colours,
/// "probability" of `options.label` or "uncertainty". The middle view unless `options` says
/// otherwise. Throws InvalidInput if the file has not what is asked for, IoError.
[[nodiscard]] Picture labeling_picture(const std::filesystem::path& file, const std::string& what,
                                       const PictureOptions& options);

}  // namespace episcope::cli
