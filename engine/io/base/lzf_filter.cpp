// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/lzf_filter.h"

#include <hdf5.h>
#include <lzf.h>

#include <cstddef>
#include <limits>

namespace episcope::io {
namespace {

/// Three bytes stand for at most 264.
constexpr std::size_t kDensestLzf = 88;
/// What a filter before this one may add to a chunk.
constexpr std::size_t kLzfHeader = 256;
constexpr std::size_t kLargestUnpacked = std::numeric_limits<unsigned>::max();

/// How large what `bytes` are turned into may be; 0 for what LZF cannot hold. Of a chunk that says
/// its size no less, since the library reads all of it, whatever came out.
std::size_t room_for(unsigned flags, std::size_t count, const unsigned values[],
                     std::size_t bytes) {
  if (bytes < 2 || bytes > kLargestUnpacked / kDensestLzf) return 0;
  if ((flags & H5Z_FLAG_REVERSE) == 0) return bytes - 1;  // else it had better be left as it is
  const bool is_stated = count > kLzfSizeAt && values[kLzfSizeAt] < kLargestUnpacked - kLzfHeader;
  return is_stated ? values[kLzfSizeAt] + kLzfHeader : bytes * kDensestLzf;
}

/// As H5Z_func_t: 0 is a failure.
std::size_t convert(unsigned flags, std::size_t count, const unsigned values[], std::size_t bytes,
                    std::size_t* room, void** buffer) {
  const std::size_t size = room_for(flags, count, values, bytes);
  void* out = size > 0 ? H5allocate_memory(size, true) : nullptr;
  if (out == nullptr) return 0;
  const auto run = (flags & H5Z_FLAG_REVERSE) != 0 ? lzf_decompress : lzf_compress;
  const unsigned written =
      run(*buffer, static_cast<unsigned>(bytes), out, static_cast<unsigned>(size));
  if (written == 0) {
    H5free_memory(out);
    return 0;
  }
  H5free_memory(*buffer);
  *buffer = out;
  *room = size;
  return written;
}

}  // namespace

void register_lzf_filter() {
  constexpr H5Z_class2_t filter{H5Z_CLASS_T_VERS, kLzfFilter, true,   true, "lzf",
                                nullptr,          nullptr,    convert};
  // That of h5py in the same process also records the size of chunks when it writes.
  static const bool is_known = H5Zfilter_avail(kLzfFilter) > 0 || H5Zregister(&filter) >= 0;
  static_cast<void>(is_known);
}

}  // namespace episcope::io
