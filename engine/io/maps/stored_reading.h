// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/reading.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <string>

namespace episcope::io {

/// Stores how a light field was read as attributes of a group or of the root; nothing if that is
/// not known.
void write_reading(Hdf5Output& file, const std::string& group, const Reading& reading);

/// What `write_reading` stored; unknown in files of others and of former versions.
[[nodiscard]] Reading reading_in(const Hdf5Input& file, const std::string& group);

}  // namespace episcope::io
