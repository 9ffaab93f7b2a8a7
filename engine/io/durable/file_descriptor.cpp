// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <utility>

namespace episcope::io {
namespace {

// Repeats pread or pwrite with what is left until nothing is.
template <class Transfer, class Byte>
bool transfer_all(Transfer transfer, int descriptor, std::span<Byte> bytes, std::uintmax_t offset) {
  while (!bytes.empty()) {
    const ssize_t count =
        transfer(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uintmax_t>(count);
  }
  return true;
}

}  // namespace

FileDescriptor::FileDescriptor(const std::filesystem::path& path, int flags)
    : id_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

FileDescriptor::~FileDescriptor() {
  if (id_ >= 0) ::close(id_);
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : id_(std::exchange(other.id_, -1)) {}

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  FileDescriptor taken(std::move(other));
  std::swap(id_, taken.id_);
  return *this;
}

bool write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

bool write_all_at(int descriptor, std::span<const std::uint8_t> bytes, std::uintmax_t offset) {
  return transfer_all(::pwrite, descriptor, bytes, offset);
}

bool read_all_at(int descriptor, std::span<std::uint8_t> bytes, std::uintmax_t offset) {
  return transfer_all(::pread, descriptor, bytes, offset);
}

bool read_all(int descriptor, std::vector<std::uint8_t>& bytes) {
  std::array<std::uint8_t, 1 << 16> block{};
  for (;;) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0;
    bytes.insert(bytes.end(), block.begin(), block.begin() + count);
  }
}

}  // namespace episcope::io
