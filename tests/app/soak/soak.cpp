// SPDX-License-Identifier: BSD-3-Clause
// soak [--rounds N | --seconds S]: does all that programs do without a window, again and again in
// one process, and fails if it holds more memory, files or threads at the end than after the first
// rounds.
#include "tests/app/soak/chores.h"

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

namespace episcope::test {
namespace {

namespace fs = std::filesystem;

// Rounds after which tables, pools and caches of libraries are as large as they get.
constexpr int kFirstRounds = 4;
// What allocators and pools may vary by, whatever the number of rounds.
constexpr long kHeapLeeway = 512L << 10;
constexpr long kResidentLeeway = 48L << 20;

// What a process holds.
struct Held {
  long heap = 0;      // bytes that were taken and not given back
  long resident = 0;  // bytes
  long files = 0, threads = 0, mappings = 0;
};

long count_in(const char* folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

long lines_of(const char* path) {
  std::ifstream file(path);
  long count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

Held held() {
  malloc_trim(0);
  const struct mallinfo2 heap = mallinfo2();
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return {static_cast<long>(heap.uordblks + heap.hblkhd), resident * ::sysconf(_SC_PAGESIZE),
          count_in("/proc/self/fd"), count_in("/proc/self/task"), lines_of("/proc/self/maps")};
}

void print(int round, const Held& now) {
  std::printf("%6d %12.2f %12.1f %8ld %8ld %8ld\n", round, static_cast<double>(now.heap) / 1e6,
              static_cast<double>(now.resident) / 1e6, now.files, now.threads, now.mappings);
  std::fflush(stdout);
}

bool is_flat(const Held& first, const Held& last) {
  return last.heap <= first.heap + kHeapLeeway &&
         last.resident <= first.resident + kResidentLeeway && last.files <= first.files &&
         last.threads <= first.threads;
}

int soak(int rounds, double seconds) {
  const fs::path folder = fs::temp_directory_path() / ("soak_" + std::to_string(::getpid()));
  const Chores chores(folder);
  std::printf("%6s %12s %12s %8s %8s %8s\n", "round", "heap MB", "resident MB", "files", "threads",
              "mappings");
  const auto start = std::chrono::steady_clock::now();
  const auto is_over = [&](int done) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return seconds > 0 ? spent.count() >= seconds && done > kFirstRounds : done >= rounds;
  };
  Held first, last;
  for (int done = 0; !is_over(done);) {
    chores.do_all(++done);
    last = held();
    if (done == kFirstRounds) first = last;
    if (done <= kFirstRounds || done % 10 == 0) print(done, last);
  }
  fs::remove_all(folder);
  const bool flat = is_flat(first, last);
  std::printf("%s\n", flat ? "flat" : "NOT FLAT");
  return flat ? 0 : 1;
}

}  // namespace
}  // namespace episcope::test

int main(int argc, char** argv) {
  const bool has_choice = argc == 3;
  const bool by_time = has_choice && std::strcmp(argv[1], "--seconds") == 0;
  const int rounds = has_choice && !by_time ? std::atoi(argv[2]) : 12;
  try {
    return episcope::test::soak(rounds, by_time ? std::atof(argv[2]) : 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
