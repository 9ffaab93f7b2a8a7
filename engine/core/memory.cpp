// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/memory.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <mutex>
#include <new>
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

namespace {

constexpr double kGigabyte = 1e9;

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

// A file of the system, closed at the end of its scope.
class OpenFile {
 public:
  explicit OpenFile(int id) : id_(id) {}
  ~OpenFile() {
    if (id_ >= 0) close(id_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int id() const { return id_; }

 private:
  int id_;
};

// Where the memory of the user lies in whole pages, with one more behind.
struct Pages {
  char* first;
  std::size_t bytes;
};

Pages pages_of(const void* memory, std::size_t bytes) {
  const std::size_t before = reinterpret_cast<std::uintptr_t>(memory) % page_size();
  return {static_cast<char*>(const_cast<void*>(memory)) - before,
          round_up(before + bytes, page_size())};
}

// What a file has lost cannot be read: instead of ending the program, zeros are put in its place.
// Handlers of signals may only look at what needs no lock.
constexpr std::size_t kMostMaps = 256;
struct MappedRange {
  std::atomic<std::uintptr_t> first{0}, last{0};
};
std::array<MappedRange, kMostMaps> mapped_files;
std::atomic<bool> has_lost{false};
struct sigaction former_action;

bool is_of_mapped_file(std::uintptr_t address) {
  for (const MappedRange& range : mapped_files) {
    if (address >= range.first.load() && address < range.last.load()) return true;
  }
  return false;
}

void replace_lost_page(int signal, siginfo_t* info, void* context) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const auto page = static_cast<std::uintptr_t>(getpagesize());
  if (is_of_mapped_file(address)) {
    void* const place = static_cast<char*>(info->si_addr) - address % page;
    has_lost = true;
    if (mmap(place, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) !=
        MAP_FAILED) {
      return;
    }
  }
  if ((former_action.sa_flags & SA_SIGINFO) != 0 && former_action.sa_sigaction != nullptr) {
    former_action.sa_sigaction(signal, info, context);
    return;
  }
  sigaction(SIGBUS, &former_action, nullptr);  // happens again, and ends the program
}

void watch_for_lost_pages() {
  [[maybe_unused]] static const int is_set = [] {
    struct sigaction action {};
    action.sa_sigaction = replace_lost_page;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    return sigaction(SIGBUS, &action, &former_action);
  }();
}

void note_mapped(std::uintptr_t first, std::uintptr_t last) {
  watch_for_lost_pages();
  for (MappedRange& range : mapped_files) {
    std::uintptr_t none = 0;
    if (!range.first.compare_exchange_strong(none, first)) continue;
    range.last = last;
    return;
  }
}

void note_unmapped(std::uintptr_t first) {
  for (MappedRange& range : mapped_files) {
    if (range.first.load() != first) continue;
    range.last = 0;
    range.first = 0;
    return;
  }
}

// The page behind is there to be read, whatever the file holds.
char* reserve(std::size_t bytes) {
  void* const place = mmap(nullptr, bytes + page_size(), PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return place == MAP_FAILED ? nullptr : static_cast<char*>(place);
}

// A file without a name.
int open_scratch(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = (folder / "episcope-XXXXXX").string();
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

[[noreturn]] void throw_no_room(const std::filesystem::path& folder, std::size_t bytes, int error) {
  std::error_code unknown;
  const auto space = std::filesystem::space(folder, unknown);
  const std::string free = unknown ? std::string()
                                   : fmt::format("; {:.2f} GB are free",
                                                 static_cast<double>(space.available) / kGigabyte);
  throw IoError(folder,
                fmt::format("{:.3f} GB do not fit into memory and should go here, but that failed "
                            "({}{}); make room, or name another folder in XDG_CACHE_HOME",
                            static_cast<double>(bytes) / kGigabyte, std::strerror(error), free));
}

}  // namespace

void* map_file(const std::filesystem::path& path, std::uintmax_t offset, std::size_t bytes) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat facts {};
  if (file.id() < 0 || fstat(file.id(), &facts) != 0) {
    throw IoError(path, fmt::format("it cannot be read ({})", std::strerror(errno)));
  }
  if (static_cast<std::uintmax_t>(facts.st_size) < offset + bytes) {
    throw IoError(path, fmt::format("the file is truncated ({} of {} bytes are present); copy or "
                                    "download it again",
                                    facts.st_size, offset + bytes));
  }
  const std::size_t before = offset % page_size();
  const std::size_t whole = round_up(before + bytes, page_size());
  char* const place = reserve(whole);
  if (place == nullptr ||
      mmap(place, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE | MAP_FIXED, file.id(),
           static_cast<off_t>(offset - before)) == MAP_FAILED) {
    throw IoError(path, fmt::format("it cannot be mapped ({})", std::strerror(errno)));
  }
  const auto first = reinterpret_cast<std::uintptr_t>(place);
  note_mapped(first, first + whole);
  return place + before;
}

void* map_scratch(std::size_t bytes) {
  const std::filesystem::path folder = scratch_folder();
  const OpenFile file(open_scratch(folder));
  if (file.id() < 0) throw_no_room(folder, bytes, errno);
  const std::size_t whole = round_up(bytes, page_size());
  // A disk that fills up later would end the program.
  const int error = posix_fallocate(file.id(), 0, static_cast<off_t>(whole));
  if (error != 0) throw_no_room(folder, bytes, error);
  char* const place = reserve(whole);
  if (place == nullptr || mmap(place, whole, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED,
                               file.id(), 0) == MAP_FAILED) {
    throw std::bad_alloc();
  }
  return place;
}

void* map_zeros(std::size_t bytes) {
  char* const place = reserve(round_up(bytes, page_size()));
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

void unmap(void* memory, std::size_t bytes) noexcept {
  const Pages pages = pages_of(memory, bytes);
  note_unmapped(reinterpret_cast<std::uintptr_t>(pages.first));
  munmap(pages.first, pages.bytes + page_size());
}

void forget_pages(const void* memory, std::size_t bytes) noexcept {
  const Pages pages = pages_of(memory, bytes);
  madvise(pages.first, pages.bytes, MADV_DONTNEED);
}

void fetch_pages(const void* memory, std::size_t bytes) noexcept {
  const Pages pages = pages_of(memory, bytes);
  madvise(pages.first, pages.bytes, MADV_WILLNEED);
}

bool has_lost_pages() {
  return has_lost;
}

}  // namespace episcope

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace episcope {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kCacheLine = 64;
// Less is never worth a file.
constexpr std::size_t kLeastOnDisk = std::size_t{1} << 20;
constexpr std::size_t kLeastUnasked = std::size_t{256} << 20;

// Of arrays that could have gone to disk, and what is set aside.
std::atomic<std::size_t> in_memory{0};

bool is_counted(std::size_t bytes) {
  return bytes >= kLeastOnDisk;
}

bool fits_budget(std::size_t bytes) {
  if (!is_counted(bytes)) return true;
  if (is_memory_budget_set()) return in_memory + bytes <= memory_budget();
  return bytes < kLeastUnasked || bytes <= memory_budget();
}

LargeMemory counted(LargeMemory memory) {
  if (is_counted(memory.bytes)) in_memory += memory.bytes;
  return memory;
}

}  // namespace

LargeMemory allocate_large(std::size_t bytes) {
  if (!fits_budget(bytes)) return {map_scratch(bytes), bytes, LargeKind::Scratch};
  const bool huge = bytes >= 2 * kHugePage;
  const std::size_t alignment = huge ? kHugePage : kCacheLine;
  const std::size_t rounded = round_up(bytes, alignment);
  void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // Only a hint: where it is refused, the memory is ordinary.
  if (huge) madvise(memory, rounded, MADV_HUGEPAGE);
#endif
  return counted({memory, bytes, LargeKind::Heap});
}

LargeMemory allocate_large_zeros(std::size_t bytes) {
  if (bytes >= 2 * kHugePage) return {map_zeros(bytes), bytes, LargeKind::Zeros};
  const LargeMemory memory = allocate_large(bytes);
  std::memset(memory.data, 0, bytes);
  return memory;
}

LargeMemory large_part_of_file(const std::filesystem::path& path, std::uintmax_t offset,
                               std::size_t bytes) {
  return {map_file(path, offset, bytes), bytes, LargeKind::File};
}

void release_large(const LargeMemory& memory) noexcept {
  if (memory.kind != LargeKind::Heap) {
    unmap(memory.data, memory.bytes);
    return;
  }
  std::free(memory.data);
  if (memory.data != nullptr && is_counted(memory.bytes)) in_memory -= memory.bytes;
}

void take_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(MADV_POPULATE_WRITE)
  // The system wants whole pages: those that begin in the piece.
  constexpr std::size_t kPage = 4096;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = round_up(begin, kPage), end = round_up(begin + bytes, kPage);
  if (first < end)
    madvise(static_cast<char*>(memory) + (first - begin), end - first, MADV_POPULATE_WRITE);
#endif
}

MemorySetAside::MemorySetAside(std::size_t bytes) noexcept : bytes_(bytes) {
  in_memory += bytes_;
}

MemorySetAside::~MemorySetAside() {
  in_memory -= bytes_;
}

}  // namespace episcope
