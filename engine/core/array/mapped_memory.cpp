// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/array/mapped_memory.h"

#include "engine/core/array/memory_budget.h"
#include "engine/core/array/round_up.h"
#include "engine/core/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <utility>

namespace episcope {
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
