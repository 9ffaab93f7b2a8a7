// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/atomic_file.h"

#include "engine/core/error.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <functional>
#include <random>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".part";

// Where a process number means the same process: the machine since it was started, and its
// container.
std::uint32_t machine() {
  static const std::uint32_t value = [] {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    std::string text = host.data(), boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    std::error_code ignored;
    text.append(boot).append(fs::read_symlink("/proc/self/ns/pid", ignored).string());
    return static_cast<std::uint32_t>(std::hash<std::string>()(text));
  }();
  return value;
}

// Tells this program from one that had the same number before.
std::uint32_t own_number() {
  static const std::uint32_t value = std::random_device()();
  return value;
}

// What the names of one machine begin with.
std::string beginning(const fs::path& target) {
  constexpr std::size_t kMostOfName = 200;  // leaves room for the rest
  return fmt::format(".{}.{:08x}-", target.filename().string().substr(0, kMostOfName), machine());
}

// Whether the program that made a name, of which this is what follows the beginning, has ended.
bool is_abandoned(std::string_view rest) {
  if (!rest.ends_with(kSuffix)) return false;
  const char* const end = rest.data() + rest.size();
  pid_t process = 0;
  const auto [after, error] = std::from_chars(rest.data(), end, process);
  if (error != std::errc() || process <= 0 || after == end || *after != '-') return false;
  if (process != ::getpid()) return ::kill(process, 0) != 0 && errno == ESRCH;
  std::uint32_t number = 0;
  const auto [behind, none] = std::from_chars(after + 1, end, number, 16);
  return none == std::errc() && behind != end && *behind == '-' && number != own_number();
}

}  // namespace

std::string temporary_name(const fs::path& target) {
  static std::atomic<unsigned> next{0};
  return fmt::format("{}{}-{:08x}-{}{}", beginning(target), ::getpid(), own_number(), next++,
                     kSuffix);
}

namespace {

/// Removes temporary files beside `target` that killed programs of this machine have left; failures
/// are ignored. Linear in the number of files of its folder.
void remove_abandoned(const fs::path& target) {
  const std::string begin = beginning(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begin)) continue;
    if (!is_abandoned(std::string_view(name).substr(begin.size()))) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

namespace {

fs::path resolve_link(const fs::path& named) {
  std::error_code error;
  if (!fs::is_symlink(named, error)) return named;
  const fs::path target = fs::weakly_canonical(named, error);
  return error ? named : target;
}

bool flush_to_disk(const fs::path& path, int flags) {
  const FileDescriptor file(path, flags);
  return file.ok() && ::fsync(file.id()) == 0;
}

constexpr double kMebibyte = 1 << 20;

/// Checks that `bytes` more fit on the disk that holds `folder`. Throws IoError naming `target`.
void require_space(const fs::path& target, const fs::path& folder, std::uintmax_t bytes) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  // Pseudo file systems report no capacity at all; there the write itself has to tell.
  if (error || space.capacity == 0 || space.available >= bytes) return;
  throw IoError(target, fmt::format("the disk is full: {:.1f} MiB are needed and {:.1f} MiB are "
                                    "free; free some space or choose another folder",
                                    static_cast<double>(bytes) / kMebibyte,
                                    static_cast<double>(space.available) / kMebibyte));
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target, std::uintmax_t bytes)
    : named_(target), target_(resolve_link(target)) {
  std::error_code error;
  const auto status = fs::status(target_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    throw IoError(named_, "this is a folder; name a file in it");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw IoError(named_, "this is not a regular file and is not overwritten; choose another name");
  }
  remove_abandoned(target_);
  require_space(named_, folder_of(target_), bytes);
  temporary_ = folder_of(target_) / temporary_name(target_);
  errno = 0;
  const FileDescriptor file(temporary_, O_CREAT | O_EXCL | O_WRONLY);
  if (!file.ok()) {
    temporary_.clear();
    throw write_error(named_);
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  if (!flush_to_disk(temporary_, O_RDONLY)) throw write_error(named_);
  commit_unflushed();
  // The file is whole by now; a folder that cannot be flushed only risks the name after a crash.
  flush_folder(target_);
}

void AtomicFile::commit_unflushed() {
  errno = 0;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(named_);
  temporary_.clear();
}

void flush_folder(const fs::path& target) {
  flush_to_disk(folder_of(target), O_RDONLY | O_DIRECTORY);
}

void write_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
  AtomicFile file(target, bytes.size());
  {
    const FileDescriptor out(file.temporary(), O_WRONLY);
    if (!out.ok()) throw write_error(target);
    if (!write_all(out.id(), bytes)) throw write_error(target);
  }
  file.commit();
}

void write_atomically(const std::filesystem::path& target, std::string_view text) {
  write_atomically(target,
                   std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

AtomicFolder::AtomicFolder(const fs::path& target, std::uintmax_t bytes) : target_(target) {
  std::error_code error;
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::exists(target_, error) && !fs::is_directory(target_, error)) {
    throw IoError(target, "this is a file; name a new folder");
  }
  if (fs::is_directory(target_, error) && !fs::is_empty(target_, error)) {
    throw IoError(target, "the folder holds other files; name a new or an empty folder");
  }
  const fs::path parent = folder_of(target_);
  remove_abandoned(target_);
  require_space(target, parent, bytes);
  temporary_ = parent / temporary_name(target_);
  errno = 0;
  if (!fs::create_directory(temporary_, error)) {
    errno = error.value();
    temporary_.clear();
    throw write_error(target);
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(target_);
  temporary_.clear();
}

}  // namespace episcope::io
