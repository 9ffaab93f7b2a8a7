// SPDX-License-Identifier: BSD-3-Clause
// open_large LF.h5: how long a large light field takes to open, and its EPIs to be found, with
// nothing of the file in memory and with what they need there; the largest memory of the process;
// and how fast all samples are read, beside a plain loop over the same file. What the system keeps
// of the file is dropped first.
#include "engine/core/light_field.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/io/open.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace episcope;

void drop_from_memory(const char* path) {
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  fdatasync(file);
  posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  close(file);
}

double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void say(const char* what, double seconds) {
  std::printf("%-44s %9.3f s   %6.0f MiB at most\n", what, seconds, peak_mib());
}

template <class Call>
void measure(const char* what, const Call& call) {
  const Stopwatch watch;
  call();
  say(what, watch.seconds());
}

// The whole file by read(2), 8 MiB at once, nothing of it in memory before; MB/s.
double plain_read_rate(const char* path) {
  drop_from_memory(path);
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  std::vector<char> buffer(std::size_t{8} << 20);
  const Stopwatch watch;
  double bytes = 0;
  for (ssize_t got = 1; got > 0; bytes += static_cast<double>(got)) {
    got = read(file, buffer.data(), buffer.size());
    if (got < 0) std::perror(path);
    if (got <= 0) break;
  }
  close(file);
  return bytes / watch.seconds() / 1e6;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  // As if so much memory were there: to try what a larger file would do.
  if (argc > 2) set_memory_budget(std::strtoull(argv[2], nullptr, 10) << 20);
  drop_from_memory(argv[1]);
  const Stopwatch watch;
  const Scene scene = io::open_scene(argv[1], {}, Progress());
  say("open", watch.seconds());
  const LightField& lf = *scene.light_field;
  std::printf("samples: %s\n", scene.convention.samples.c_str());
  const ViewIndex center = lf.center(), other{0, 1};
  const int x = lf.width() / 2, y = lf.height() / 2;
  lf.forget_samples();
  drop_from_memory(argv[1]);
  measure("horizontal EPI, nothing in memory", [&] { (void)horizontal_epi(lf, center, y); });
  measure("the next row", [&] { (void)horizontal_epi(lf, center, y + 1); });
  measure("again", [&] { (void)horizontal_epi(lf, center, y); });
  measure("vertical EPI, nothing in memory", [&] { (void)vertical_epi(lf, center, x); });
  measure("the next column", [&] { (void)vertical_epi(lf, center, x + 1); });
  measure("vertical EPI of another column of views", [&] { (void)vertical_epi(lf, other, x); });
  measure("a view, nothing in memory", [&] { (void)lf.view_as_float({0, 0}); });
  measure("the same view again", [&] { (void)lf.view_as_float({0, 0}); });
  std::printf("a plain loop reads the file: %.0f MB/s\n", plain_read_rate(argv[1]));
  lf.forget_samples();
  drop_from_memory(argv[1]);
  const Stopwatch all;
  const auto hash = lf.sample_hash();
  const double seconds = all.seconds();
  say("all samples, hashed", seconds);
  std::printf("%.0f MB/s, hash %016llx\n", static_cast<double>(lf.byte_size()) / seconds / 1e6,
              static_cast<unsigned long long>(hash));
  std::printf("a plain loop again: %.0f MB/s\n", plain_read_rate(argv[1]));
  return 0;
}
