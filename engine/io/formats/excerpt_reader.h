// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/reader.h"

#include <filesystem>
#include <map>
#include <string>

namespace episcope::io {

/// Excerpts of the 2013 archive: a folder `lf` of views with depth.bin, attributes.dat and maybe
/// mask.png beside it.
[[nodiscard]] Reader excerpt_reader();

/// Camera attributes of an excerpt of the 2013 archive, by name: `dH` (baseline), `focalLength`
/// (px), `shift`, `min_disp`, `max_disp`.
using ExcerptAttributes = std::map<std::string, double>;

/// Reads lines "value //name" of an `attributes.dat`; others are skipped. Throws IoError if the
/// file cannot be read.
[[nodiscard]] ExcerptAttributes read_excerpt_attributes(const std::filesystem::path& path);

}  // namespace episcope::io
