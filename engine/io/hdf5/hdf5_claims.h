// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>

/// Checks of what an HDF5 file claims, before memory is taken for it. For the sources that speak to
/// HDF5 only.
namespace episcope::io {

/// Throws IoError if a dataset claims far more samples than its file can hold, compressed or not,
/// or is compressed by a filter that is not at hand. A dataset that was never written counts as
/// samples that are not there, unless it is small.
void require_sound_dataset(const std::filesystem::path& path, const std::string& name,
                           hid_t dataset);

/// Whether a dataset whose samples are in its header claims more than are there: HDF5 1.10 reads
/// beyond them.
[[nodiscard]] bool is_short_in_header(hid_t dataset);

/// Whether numbers of a dataset have no more bytes than any machine's: what the library does with
/// larger ones, which only damage makes, reads beyond its memory.
[[nodiscard]] bool has_sound_numbers(hid_t dataset);

/// Whether the samples of a dataset are in its file: not in raw files that it names, nor in
/// datasets of other files that it is made of. Such a file could name any file of the user's.
[[nodiscard]] bool holds_own_samples(hid_t dataset);
/// Throws IoError if it does not.
void require_own_samples(const std::filesystem::path& path, const std::string& name, hid_t dataset);

/// Whether `bytes` of an attribute or text are no more than the file holds.
[[nodiscard]] bool fits_file(const std::filesystem::path& path, double bytes);

}  // namespace episcope::io
