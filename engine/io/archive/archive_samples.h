// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/archive/archive_layout.h"

namespace episcope::io {

/// The samples of an archive file in the stored order of views and in their stored type; wider
/// integers are taken as bytes if the centre view fits. Those of a large light field
/// (is_better_mapped) stay in the file, if it stores them as an array of 8 or 16 bits that nothing
/// asks to change: they are there at once, and read when they are looked at. Shows the centre view
/// (OpenOptions::on_center_view) with `info`. Throws IoError, Cancelled.
[[nodiscard]] LightField::Samples read_archive_samples(const Hdf5Input& file, ArchiveLayout layout,
                                                       const OpenOptions& options,
                                                       const LightFieldInfo& info,
                                                       const Progress& progress);

}  // namespace episcope::io
