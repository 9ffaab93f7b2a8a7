// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/files.h"

#include "engine/core/text.h"
#include "engine/io/base/foreign_content.h"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
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

namespace {

constexpr std::uintmax_t kNearlyNothing = 1 << 20;

// Pseudo file systems report no capacity at all.
bool is_disk_full(const std::filesystem::path& path) {
  std::error_code error;
  const auto space = std::filesystem::space(path.parent_path(), error);
  return !error && space.capacity > 0 && space.available < kNearlyNothing;
}

}  // namespace

void require_openable_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw IoError(path, "there is no such file; check the path");
  }
  if (std::filesystem::is_directory(status)) {
    throw IoError(path, "this is a folder where a file is needed; name a file in it");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // Opening a pipe would wait for whoever writes into it.
    throw IoError(path, "this is neither a file nor a folder; choose another one");
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw IoError(path, "the file cannot be opened (" + std::string(std::strerror(errno)) +
                            "); check its permissions");
  }
  ::close(descriptor);
}

void require_readable_file(const std::filesystem::path& path) {
  require_openable_file(path);
  if (const std::string content = foreign_content(path); !content.empty()) {
    throw IoError(path, content);
  }
}

IoError write_error(const std::filesystem::path& path) {
  const int code = errno;
  const bool is_forbidden = code == EACCES || code == EPERM || code == EROFS;
  if (code == EDQUOT) {
    return {path, "your quota of disk space is used up; remove files or choose another folder"};
  }
  if (code == EFBIG) {
    return {path, "the file would become larger than allowed here; choose another folder"};
  }
  if (code == ENOSPC || (!is_forbidden && is_disk_full(path))) {
    return {path, "the disk is full; free some space or choose another folder"};
  }
  if (code == ENOENT) {
    return {path, "the folder does not exist; create it or choose another one"};
  }
  if (code == ENOTDIR) {
    return {path, "part of this path is a file, not a folder; choose another path"};
  }
  const std::string reason = code == 0 ? "unknown reason" : std::strerror(code);
  return {path, "the file cannot be written (" + reason + "); choose another folder"};
}

void make_folder(const std::filesystem::path& folder, std::string_view advice) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!failure) return;
  throw IoError(folder,
                "the folder cannot be created (" + failure.message() + ")" + std::string(advice));
}

namespace fs = std::filesystem;

bool is_inside_folder(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path root = error ? fs::path() : fs::weakly_canonical(here / folder, error);
  const fs::path place = error ? fs::path() : fs::weakly_canonical(here / path, error);
  return !error && std::ranges::mismatch(root, place).in1 == root.end();
}

void report_file_size_limit() {
  std::signal(SIGXFSZ, SIG_IGN);
}

namespace {

template <class Visit>
void for_each_image(const fs::path& folder, const Visit& visit) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && is_image_name(entry.path()) && entry.is_regular_file(error)) {
      visit(entry.path());
    }
  }
}

}  // namespace

bool is_image_name(const fs::path& path) {
  constexpr std::array suffixes{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm",
                                ".pgm", ".pnm", ".webp", ".jp2", ".exr",  ".hdr"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

std::vector<fs::path> list_images(const fs::path& folder) {
  std::vector<fs::path> images;
  for_each_image(folder, [&](const fs::path& path) { images.push_back(path); });
  // Comparing whole paths, part by part, takes seconds where there are 100,000.
  std::ranges::sort(images, {},
                    [](const fs::path& path) { return std::string_view(path.native()); });
  return images;
}

std::vector<fs::path> list_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_directory(error)) folders.push_back(entry.path());
  }
  return folders;
}

int count_images(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return 0;
  int count = 0;
  for_each_image(folder, [&](const fs::path&) { ++count; });
  return count;
}

}  // namespace episcope::io
