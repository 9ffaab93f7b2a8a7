// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/temporary_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <functional>
#include <random>
#include <string_view>

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

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

}  // namespace episcope::io
