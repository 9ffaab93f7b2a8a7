// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/array/memory_budget.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <mutex>
#include <string>

namespace episcope {
namespace {

struct Settings {
  std::mutex mutex;
  std::optional<std::size_t> budget;
  std::filesystem::path scratch;
};

Settings& settings() {
  static Settings the_settings;
  return the_settings;
}

std::optional<std::size_t> number_in(const char* path) {
  std::ifstream file(path);
  std::size_t number = 0;
  return file >> number ? std::optional(number) : std::nullopt;
}

// Of version 2; nothing where there is no limit.
std::optional<std::size_t> left_by_control_group() {
  const auto most = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (!most || !used) return std::nullopt;
  return *most - std::min(*most, *used);
}

std::size_t available_to_all() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  for (std::size_t kib = 0; file >> name >> kib; std::getline(file, unit)) {
    if (name == "MemAvailable:") return kib * 1024;
  }
  return std::numeric_limits<std::size_t>::max() / 2;
}

}  // namespace

std::size_t free_memory() {
  const std::size_t available = available_to_all();
  return std::min(available, left_by_control_group().value_or(available));
}

std::size_t used_memory() {
  std::ifstream file("/proc/self/statm");
  std::size_t all_pages = 0, pages = 0;
  file >> all_pages >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void return_freed_memory() {
  constexpr int kLarge = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, kLarge);
}

std::size_t memory_budget() {
  {
    const std::scoped_lock lock(settings().mutex);
    if (settings().budget) return *settings().budget;
  }
  return free_memory() / 3 * 2;
}

void set_memory_budget(std::optional<std::size_t> bytes) {
  const std::scoped_lock lock(settings().mutex);
  settings().budget = bytes;
}

bool is_memory_budget_set() {
  const std::scoped_lock lock(settings().mutex);
  return settings().budget.has_value();
}

bool is_better_mapped(double bytes) {
  constexpr double kNeverMapped = 64 << 20;
  if (is_memory_budget_set()) return bytes > static_cast<double>(memory_budget()) / 3;
  return bytes > kNeverMapped && bytes > static_cast<double>(free_memory()) / 3;
}

void set_scratch_folder(const std::filesystem::path& folder) {
  const std::scoped_lock lock(settings().mutex);
  settings().scratch = folder;
}

std::filesystem::path scratch_folder() {
  const std::scoped_lock lock(settings().mutex);
  return settings().scratch.empty() ? std::filesystem::temp_directory_path() : settings().scratch;
}

}  // namespace episcope
