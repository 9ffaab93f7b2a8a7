// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/hdf5_open.h"

#include <hdf5.h>
#include <zlib.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope::io {

/// Reads chunks that are deflated, perhaps shuffled before, one after the other: what the library
/// does for each chunk besides takes many times as long where chunks are small. Callers hold the
/// lock of the library.
class DeflatedChunks {
 public:
  /// `dataset` stays open as long as this.
  explicit DeflatedChunks(hid_t dataset);

  /// Reads a block as numbers of the type `memory` of the library, `[…]` as the block. False, with
  /// anything in `out`, if the library is to read it: where the block cuts chunks, samples are
  /// stored in another way, or a chunk is missing or damaged.
  [[nodiscard]] bool read(const Hdf5Block& block, hid_t memory, void* out);

 private:
  using Lengths = std::vector<hsize_t>;
  struct EndInflate {
    void operator()(z_stream* stream) const;
  };

  [[nodiscard]] bool has_whole_chunks(const Hdf5Block& block) const;
  /// Unpacks the chunk that begins at `at` into `samples_`.
  [[nodiscard]] bool unpack(const Lengths& at);
  [[nodiscard]] bool inflate_into(std::vector<std::uint8_t>& out);
  void unshuffle();
  /// Copies what the block holds of the chunk to its place.
  void place(const Lengths& at, const Hdf5Block& block, std::uint8_t* out) const;

  hid_t dataset_;
  Lengths sides_;   ///< Of a chunk; empty if this reads nothing.
  Lengths extent_;  ///< Of the dataset.
  std::size_t chunk_bytes_ = 0;
  std::size_t number_bytes_ = 0;
  bool is_shuffled_ = false;
  std::unique_ptr<z_stream, EndInflate> stream_;
  std::vector<std::uint8_t> packed_, shuffled_, samples_;
};

}  // namespace episcope::io
