// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_chunks.h"

#include "engine/io/hdf5/hdf5_handle.h"
#include "engine/io/hdf5/lzf_filter.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace episcope::io {
namespace {

using Places = std::vector<hsize_t>;

/// Sides of a chunk; empty if they do not fit the dataset.
Places sides_of(hid_t creation, std::size_t rank) {
  Places sides(rank);
  const int count = H5Pget_chunk(creation, static_cast<int>(rank), sides.data());
  const bool is_sound = count == static_cast<int>(rank) && std::ranges::count(sides, 0U) == 0;
  return is_sound ? sides : Places();
}

Places first_chunk(const Hdf5Block& block, const Places& sides) {
  Places at(sides.size());
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = block.start[i] / sides[i] * sides[i];
  return at;
}

/// Moves `at` to the next chunk of the block; whether there is one.
bool step(const Hdf5Block& block, const Places& sides, Places& at) {
  for (std::size_t i = at.size(); i-- > 0;) {
    at[i] += sides[i];
    if (at[i] < block.start[i] + block.count[i]) return true;
    at[i] = block.start[i] / sides[i] * sides[i];
  }
  return false;
}

hsize_t bytes_of_chunk(hid_t dataset, const Places& sides) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  hsize_t bytes = H5Tget_size(type);
  for (const hsize_t side : sides) bytes *= side;
  return bytes;
}

/// Whether the dataset may become as large; of axes without an end it may.
bool fit_dataset(hid_t dataset, const Places& sides) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  Places extent(sides.size()), most(sides.size());
  H5Sget_simple_extent_dims(space, extent.data(), most.data());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (most[i] != H5S_UNLIMITED && sides[i] > most[i]) return false;
  }
  return true;
}

/// Whether the samples are deflated, perhaps shuffled before, and nothing else.
bool is_deflated(hid_t creation) {
  bool is_found = false;
  for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
    unsigned flags = 0, config = 0;
    std::size_t count = 0;
    const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &count,
                                           nullptr, 0, nullptr, &config);
    if (id != H5Z_FILTER_DEFLATE && id != H5Z_FILTER_SHUFFLE) return false;
    is_found = is_found || id == H5Z_FILTER_DEFLATE;
  }
  return is_found;
}

bool states_packed_size(hid_t creation, hsize_t bytes) {
  unsigned flags = 0, config = 0;
  std::array<unsigned, kLzfSizeAt + 1> values{};
  std::size_t count = values.size();
  const bool is_lzf = H5Pget_filter_by_id2(creation, kLzfFilter, &flags, &count, values.data(), 0,
                                           nullptr, &config) >= 0;
  return !is_lzf || (count > kLzfSizeAt && values[kLzfSizeAt] == bytes);
}

/// Up to `most`.
hsize_t inflated_size(std::vector<std::uint8_t>& packed, hsize_t most) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::vector<std::uint8_t> piece(kPiece);
  z_stream state{};
  if (inflateInit(&state) != Z_OK) return 0;
  state.next_in = packed.data();
  state.avail_in = static_cast<uInt>(packed.size());
  hsize_t size = 0;
  int result = Z_OK;
  while (result == Z_OK && size < most) {
    state.next_out = piece.data();
    state.avail_out = static_cast<uInt>(piece.size());
    result = inflate(&state, Z_NO_FLUSH);
    size += piece.size() - state.avail_out;
  }
  inflateEnd(&state);
  return size;
}

/// Of what damages the shape of chunks, all of them suffer.
bool is_first_whole(hid_t dataset, hsize_t bytes) {
  Places offset(H5S_MAX_RANK);
  unsigned skipped = 0;
  haddr_t place = HADDR_UNDEF;
  hsize_t stored = 0;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Dget_chunk_info(dataset, space, 0, offset.data(), &skipped, &place, &stored) < 0 ||
      place == HADDR_UNDEF || skipped != 0) {
    return true;
  }
  const Hdf5Handle file(H5Iget_file_id(dataset), H5Fclose);
  hsize_t size = 0;
  if (H5Fget_filesize(file, &size) < 0 || stored > size) return false;
  std::vector<std::uint8_t> packed(stored);
  if (H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &skipped, packed.data()) < 0) return true;
  return inflated_size(packed, bytes) >= bytes;
}

}  // namespace

bool has_sound_chunks(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED) return true;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  const Places sides = sides_of(creation, static_cast<std::size_t>(std::max(0, rank)));
  if (sides.empty() || !fit_dataset(dataset, sides)) return false;
  const hsize_t bytes = bytes_of_chunk(dataset, sides);
  if (!states_packed_size(creation, bytes)) return false;
  hsize_t count = 0;
  const bool has_any = H5Dget_num_chunks(dataset, space, &count) >= 0 && count > 0;
  return !has_any || !is_deflated(creation) || is_first_whole(dataset, bytes);
}

bool has_short_chunk(hid_t dataset, const Hdf5Block& block) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED) return false;
  if (std::ranges::count(block.count, 0U) > 0) return false;
  const Places sides = sides_of(creation, block.start.size());
  if (sides.empty()) return true;
  const hsize_t bytes = bytes_of_chunk(dataset, sides);
  const unsigned filters = (1U << std::max(0, H5Pget_nfilters(creation))) - 1;
  Places at = first_chunk(block, sides);
  do {
    unsigned skipped = 0;
    haddr_t place = HADDR_UNDEF;
    hsize_t stored = 0;
    if (H5Dget_chunk_info_by_coord(dataset, at.data(), &skipped, &place, &stored) < 0) return true;
    const bool is_plain = place != HADDR_UNDEF && (skipped & filters) == filters;
    if (is_plain && stored < bytes) return true;
  } while (step(block, sides, at));
  return false;
}

}  // namespace episcope::io
