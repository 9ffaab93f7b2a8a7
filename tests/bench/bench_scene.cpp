// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/bench_scene.h"

#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace episcope::bench {

const LightField& demo_768() {
  static const LightFieldPtr light_field = [] {
    scenes::RenderOptions options;
    options.height = 768;
    options.width = 768;
    return scenes::render_builtin("demo", options, Progress()).light_field;
  }();
  return *light_field;
}

double copied_bytes_per_second() {
  constexpr std::size_t size = std::size_t{1} << 28;
  constexpr int parts = 64;
  const auto from = make_large<char>(size);
  const auto to = make_large<char>(size);
  std::memset(from.get(), 1, size);
  std::memset(to.get(), 2, size);
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const double start = now();
    parallel_for(parts, Progress(), [&](int part) {
      const std::size_t begin = size / parts * part;
      std::memcpy(to.get() + begin, from.get() + begin, size / parts);
    });
    best = std::min(best, now() - start);
  }
  return 2.0 * static_cast<double>(size) / best;
}

bool reset_peak_memory() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

std::size_t peak_memory() {
  std::ifstream file("/proc/self/status");
  const std::string key = "VmHWM:";
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    std::size_t kilobytes = 0;
    std::istringstream(line.substr(key.size())) >> kilobytes;
    return kilobytes * 1024;
  }
  return 0;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace episcope::bench
