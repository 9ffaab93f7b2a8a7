// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/inflate_stream.h"

#include <algorithm>
#include <new>

namespace episcope::io {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;
constexpr int kRawDeflate = -MAX_WBITS;

}  // namespace

InflateStream::InflateStream(const std::filesystem::path& path, const ZipEntry& entry)
    : InflateStream(path, entry.begin, entry.stored, kRawDeflate) {}

InflateStream::InflateStream(const std::filesystem::path& path, std::uint64_t begin,
                             std::uint64_t bytes)
    : InflateStream(path, begin, bytes, MAX_WBITS) {}

InflateStream::InflateStream(const std::filesystem::path& path, std::uint64_t begin,
                             std::uint64_t bytes, int window)
    : in_(path, std::ios::binary), left_(bytes), piece_(kPiece) {
  in_.seekg(static_cast<std::streamoff>(begin));
  if (inflateInit2(&state_, window) != Z_OK) throw std::bad_alloc();
}

InflateStream::~InflateStream() {
  inflateEnd(&state_);
}

std::size_t InflateStream::read(std::size_t bytes, std::uint8_t* out) {
  std::size_t done = 0;
  while (done < bytes) {
    // Without input the last bytes may still be to come.
    const bool has_input = state_.avail_in > 0 || refill();
    const std::size_t wanted = std::min(bytes - done, kMostAtOnce);
    state_.next_out = out + done;
    state_.avail_out = static_cast<uInt>(wanted);
    const int result = inflate(&state_, Z_NO_FLUSH);
    const std::size_t got = wanted - state_.avail_out;
    done += got;
    is_damaged_ = is_damaged_ || result == Z_DATA_ERROR;
    const bool is_over = result != Z_OK && result != Z_BUF_ERROR;
    if (is_over || (!has_input && got == 0)) break;
  }
  position_ += done;
  return done;
}

bool InflateStream::skip_to(std::uint64_t position) {
  std::vector<std::uint8_t> skipped(std::min<std::uint64_t>(position - position_, kPiece));
  while (position_ < position) {
    const std::size_t step = std::min<std::uint64_t>(position - position_, skipped.size());
    if (read(step, skipped.data()) != step) return false;
  }
  return true;
}

bool InflateStream::ends_well() {
  std::vector<std::uint8_t> rest(kPiece);
  read(rest.size(), rest.data());
  return !is_damaged_;
}

bool InflateStream::refill() {
  const std::size_t wanted = std::min<std::uint64_t>(left_, piece_.size());
  if (wanted == 0) return false;
  in_.read(reinterpret_cast<char*>(piece_.data()), static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(in_.gcount());
  left_ -= got;
  state_.next_in = piece_.data();
  state_.avail_in = static_cast<uInt>(got);
  return got > 0;
}

}  // namespace episcope::io
