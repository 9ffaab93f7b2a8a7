// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"

#include <filesystem>

namespace episcope::io {

/// Copies an HDF5 file such that each dataset of numbers is one array, in its own type, without
/// chunks and filters: what is read fastest, and by every program. Samples that virtual datasets
/// and raw storage have in other files become part of the copy; that is what a user who asks for it
/// trusts the file with. Links are copied as they are, references between objects are left out.
/// Atomic. Throws IoError, also if one of the other files is missing; Cancelled.
void repack_hdf5(const std::filesystem::path& from, const std::filesystem::path& to,
                 const Progress& progress);

}  // namespace episcope::io
