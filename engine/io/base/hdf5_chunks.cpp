// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_chunks.h"

#include <algorithm>
#include <cstring>

namespace episcope::io {
namespace {

/// Of a chunk that does not become smaller.
constexpr hsize_t kLargestGrowth = 1024;
constexpr hsize_t kLargestChunk = std::size_t{1} << 30;

/// Deflate alone, or behind shuffle; others are the library's.
bool has_known_filters(hid_t creation, bool& is_shuffled) {
  const int count = H5Pget_nfilters(creation);
  is_shuffled = count == 2;
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t values = 0;
    const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values,
                                           nullptr, 0, nullptr, &config);
    if (id != (i + 1 == count ? H5Z_FILTER_DEFLATE : H5Z_FILTER_SHUFFLE)) return false;
  }
  return count == 1 || count == 2;
}

}  // namespace

void DeflatedChunks::EndInflate::operator()(z_stream* stream) const {
  inflateEnd(stream);
  delete stream;
}

DeflatedChunks::DeflatedChunks(hid_t dataset) : dataset_(dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED || !has_known_filters(creation, is_shuffled_)) return;
  const Hdf5Dataset facts = describe_dataset(dataset, {});
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  number_bytes_ = H5Tget_size(type);
  extent_.assign(facts.shape.begin(), facts.shape.end());
  hsize_t bytes = number_bytes_;
  for (const std::size_t side : facts.chunk) {
    if (side == 0 || side > kLargestChunk / std::max<hsize_t>(1, bytes)) return;
    bytes *= side;
  }
  stream_.reset(new z_stream{});
  if (facts.chunk.empty() || inflateInit(stream_.get()) != Z_OK) return;
  chunk_bytes_ = bytes;
  sides_.assign(facts.chunk.begin(), facts.chunk.end());
}

bool DeflatedChunks::has_whole_chunks(const Hdf5Block& block) const {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const hsize_t end = block.start[i] + block.count[i];
    const bool ends = end % sides_[i] == 0 || end == extent_[i];
    if (block.count[i] == 0 || block.start[i] % sides_[i] != 0 || end > extent_[i] || !ends) {
      return false;
    }
  }
  return true;
}

bool DeflatedChunks::read(const Hdf5Block& block, hid_t memory, void* out) {
  if (sides_.empty() || block.start.size() != sides_.size() || !has_whole_chunks(block)) {
    return false;
  }
  const Hdf5Handle type(H5Dget_type(dataset_), H5Tclose);
  if (H5Tequal(type, memory) <= 0) return false;
  Lengths at(block.start.begin(), block.start.end());
  do {
    if (!unpack(at)) return false;
    place(at, block, static_cast<std::uint8_t*>(out));
  } while (next_chunk(block, sides_, at));
  return true;
}

bool DeflatedChunks::unpack(const Lengths& at) {
  samples_.resize(chunk_bytes_);
  hsize_t stored = 0;
  const bool is_there = H5Dget_chunk_storage_size(dataset_, at.data(), &stored) >= 0 &&
                        stored > 0 &&
                        stored <= samples_.size() + samples_.size() / 8 + kLargestGrowth;
  if (!is_there) return false;
  packed_.resize(stored);
  std::uint32_t skipped = 0;
  if (H5Dread_chunk(dataset_, H5P_DEFAULT, at.data(), &skipped, packed_.data()) < 0) return false;
  if (skipped != 0) return false;
  if (!is_shuffled_ || number_bytes_ == 1) return inflate_into(samples_);
  shuffled_.resize(samples_.size());
  if (!inflate_into(shuffled_)) return false;
  unshuffle();
  return true;
}

bool DeflatedChunks::inflate_into(std::vector<std::uint8_t>& out) {
  if (inflateReset(stream_.get()) != Z_OK) return false;
  stream_->next_in = packed_.data();
  stream_->avail_in = static_cast<uInt>(packed_.size());
  stream_->next_out = out.data();
  stream_->avail_out = static_cast<uInt>(out.size());
  return inflate(stream_.get(), Z_FINISH) == Z_STREAM_END && stream_->avail_out == 0;
}

/// All first bytes of the numbers come first, then all second ones.
void DeflatedChunks::unshuffle() {
  const std::size_t count = samples_.size() / number_bytes_;
  for (std::size_t byte = 0; byte < number_bytes_; ++byte) {
    const std::uint8_t* from = shuffled_.data() + byte * count;
    for (std::size_t i = 0; i < count; ++i) samples_[i * number_bytes_ + byte] = from[i];
  }
}

void DeflatedChunks::place(const Lengths& at, const Hdf5Block& block, std::uint8_t* out) const {
  const std::size_t rank = sides_.size();
  Lengths part(rank), from_steps(rank), to_steps(rank);
  hsize_t from_step = number_bytes_, to_step = number_bytes_, to = 0;
  for (std::size_t i = rank; i-- > 0;) {
    part[i] = std::min<hsize_t>(sides_[i], extent_[i] - at[i]);
    from_steps[i] = from_step;
    to_steps[i] = to_step;
    to += (at[i] - block.start[i]) * to_step;
    from_step *= sides_[i];
    to_step *= block.count[i];
  }
  // What follows each other in the chunk and in the block is copied at once.
  std::size_t inner = rank - 1;
  hsize_t run = part[inner] * number_bytes_;
  while (inner > 0 && part[inner] == sides_[inner] && part[inner] == block.count[inner]) {
    run *= part[--inner];
  }
  Lengths index(inner, 0);
  hsize_t from = 0;
  for (bool goes_on = true; goes_on;) {
    std::memcpy(out + to, samples_.data() + from, run);
    goes_on = false;
    for (std::size_t i = inner; i-- > 0 && !goes_on;) {
      from += from_steps[i];
      to += to_steps[i];
      goes_on = ++index[i] < part[i];
      if (goes_on) continue;
      from -= from_steps[i] * part[i];
      to -= to_steps[i] * part[i];
      index[i] = 0;
    }
  }
}

}  // namespace episcope::io
