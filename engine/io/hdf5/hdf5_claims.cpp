// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_claims.h"

#include "engine/core/error.h"
#include "engine/io/hdf5/hdf5_handle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace episcope::io {
namespace {

/// Deflate, the most common filter, reaches 1032 for samples that are all the same.
constexpr double kLargestCompression = 1100;
/// What an unwritten dataset may claim, in bytes.
constexpr double kSmall = 64 << 20;

double file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : static_cast<double>(bytes);
}

/// Samples times their size; in floating point, since a file may claim any number.
double claimed_bytes(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  auto bytes = static_cast<double>(H5Tget_size(type));
  // One that is empty along an axis must not claim too much along the others, either.
  for (const hsize_t length : extent) bytes *= static_cast<double>(std::max<hsize_t>(length, 1));
  return bytes;
}

// Chunks that are looked at: filters that can be skipped rarely are, and never for long.
constexpr hsize_t kChunksSeen = 64;

/// The filters that the first chunks were all stored without, a bit each. A writer may skip those
/// that it marks as optional.
unsigned skipped_filters(hid_t dataset) {
  std::array<hsize_t, H5S_MAX_RANK> offset{};
  haddr_t place = 0;
  hsize_t size = 0, count = 0;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Dget_num_chunks(dataset, space, &count) < 0) return ~0U;
  unsigned all = ~0U;
  for (hsize_t i = 0; i < std::min(count, kChunksSeen); ++i) {
    unsigned skipped = ~0U;
    H5Dget_chunk_info(dataset, space, i, offset.data(), &skipped, &place, &size);
    all &= skipped;
  }
  return all;
}

/// The name of the first filter of the samples that the library lacks; empty if it has all.
std::string missing_filter(hid_t dataset, hid_t creation) {
  for (int i = 0; i < std::max(0, H5Pget_nfilters(creation)); ++i) {
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t count = 0;
    std::array<char, 100> name{};
    const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &count,
                                           nullptr, name.size() - 1, name.data(), &config);
    if (id < 0 || H5Zfilter_avail(id) > 0) continue;
    const bool is_optional = (flags & H5Z_FLAG_OPTIONAL) != 0;
    if (is_optional && (skipped_filters(dataset) >> i & 1U) != 0) continue;
    return fmt::format("{}{}{}", id, name[0] == 0 ? "" : ", ", name.data());
  }
  return {};
}

}  // namespace

bool fits_file(const std::filesystem::path& path, double bytes) {
  return bytes <= file_bytes(path);
}

bool holds_own_samples(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(creation) <= 0 && H5Pget_layout(creation) != H5D_VIRTUAL;
}

void require_own_samples(const std::filesystem::path& path, const std::string& name,
                         hid_t dataset) {
  if (holds_own_samples(dataset)) return;
  throw IoError(path, "the samples of the dataset " + name +
                          " are in other files, which are not read; store them in this file, for "
                          "example by h5repack");
}

bool is_short_in_header(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_COMPACT) return false;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const bool is_empty = H5Sget_simple_extent_npoints(space) == 0;
  return !is_empty && claimed_bytes(dataset) > static_cast<double>(H5Dget_storage_size(dataset));
}

bool has_sound_numbers(hid_t dataset) {
  constexpr std::size_t kMostBytes = 16;
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  return (kind != H5T_INTEGER && kind != H5T_FLOAT) || H5Tget_size(type) <= kMostBytes;
}

void require_sound_dataset(const std::filesystem::path& path, const std::string& name,
                           hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (const std::string filter = missing_filter(dataset, creation); !filter.empty()) {
    throw IoError(path, fmt::format("the dataset {} is compressed by a filter that is not known "
                                    "here ({}); store it without, for example by h5repack -f NONE",
                                    name, filter));
  }
  const double claimed = claimed_bytes(dataset);
  const bool is_compressed = H5Pget_nfilters(creation) > 0;
  const double stored =
      std::min(static_cast<double>(H5Dget_storage_size(dataset)), file_bytes(path));
  if (claimed <= std::max(kSmall, stored * (is_compressed ? kLargestCompression : 1))) return;
  throw IoError(path,
                fmt::format("the dataset {} claims {:.3g} bytes, of which the file can hold "
                            "no more than {:.3g}; it is damaged: copy or download it again",
                            name, claimed, stored * (is_compressed ? kLargestCompression : 1)));
}

}  // namespace episcope::io
