// SPDX-License-Identifier: BSD-3-Clause
// Compares every method on the GPU with the CPU, or times it: see README.md.
#include "engine/core/text/text_table.h"
#include "engine/cuda/device/cuda_device.h"
#include "engine/cuda/device/device_bounds.h"
#include "tests/cuda/agreement.h"
#include "tests/cuda/timing.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>

namespace {

using namespace episcope;
using namespace episcope::cuda_tests;

constexpr int kSkipped = 77;

struct Arguments {
  bool times = false;
  bool with_cpu = true;
  bool only_center = false;  ///< When times are taken.
  int size = 192;
  IntervalOrAuto range;  ///< Searched when times are taken; else as methods find it.
  std::string methods;   ///< What ids begin with.
};

int compare_all(const Arguments& arguments) {
  bool passes = true;
  TextTable table{{"method", "scene", "within 1e-4 px", "largest", "confidence", "MSE CPU",
                   "MSE GPU", "repeatable", "passes"},
                  {}};
  for (const std::string& text : scene_texts()) {
    const Scene scene = make_scene(text, arguments.size);
    for (const Case& each : cases(arguments.methods)) {
      const Agreement result = compare(each, scene);
      passes = passes && result.passes;
      table.rows.push_back({each.title, text, fmt::format("{:.4f} %", 100 * result.within),
                            fmt::format("{:.2g}", result.largest),
                            fmt::format("{:.3f} %", 100 * result.confidence),
                            fixed_text(result.cpu_mse, 4), fixed_text(result.device_mse, 4),
                            result.is_repeatable ? "yes" : "NO", result.passes ? "yes" : "NO"});
    }
  }
  fmt::print("{}\n", table_to_text(table));
  return passes ? 0 : 1;
}

void print_kernels(const std::vector<KernelTime>& kernels, const DeviceBounds& bounds) {
  TextTable table{{"  kernel", "launches", "ms", "GB/s", "of copy", "GFLOP/s", "of FP32"}, {}};
  for (const KernelTime& kernel : kernels) {
    const double seconds = kernel.milliseconds / 1e3;
    const double bytes = kernel.bytes / seconds, operations = kernel.operations / seconds;
    table.rows.push_back({"  " + kernel.name, std::to_string(kernel.launches),
                          fixed_text(kernel.milliseconds, 3), fixed_text(bytes / 1e9, 0),
                          fmt::format("{:.0f} %", 100 * bytes / bounds.bytes),
                          fixed_text(operations / 1e9, 0),
                          fmt::format("{:.0f} %", 100 * operations / bounds.operations)});
  }
  fmt::print("{}\n", table_to_text(table));
}

int time_all(const Arguments& arguments) {
  const DeviceBounds bounds = measure_device_bounds();
  fmt::print("copy {:.0f} GB/s, FP32 {:.0f} GFLOP/s\n\n", bounds.bytes / 1e9,
             bounds.operations / 1e9);
  Scene scene = make_scene("demo", arguments.size);
  for (Case& each : cases(arguments.methods)) {
    if (arguments.range) each.values.emplace_back("range", arguments.range);
    if (arguments.only_center) each.views = ViewSelection::Center;
    const Timing timing = time_case(each, scene, arguments.with_cpu);
    fmt::print("{}: {:.1f} ms, kernels {:.1f} ms", each.title, 1e3 * timing.seconds,
               1e3 * timing.kernel_seconds);
    if (arguments.with_cpu) {
      fmt::print(", CPU {:.0f} ms, ratio {:.1f}", 1e3 * timing.cpu_seconds,
                 timing.cpu_seconds / timing.seconds);
    }
    fmt::print("\n");
    print_kernels(timing.kernels, bounds);
    std::fflush(stdout);
  }
  return 0;
}

Arguments read_arguments(int count, char** texts) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string text = texts[i];
    const bool has_value = i + 1 < count;
    if (text == "time") arguments.times = true;
    if (text == "--center") arguments.only_center = true;
    if (text == "--no-cpu") arguments.with_cpu = false;
    if (text == "--size" && has_value) arguments.size = std::stoi(texts[++i]);
    if (text == "--methods" && has_value) arguments.methods = texts[++i];
    if (text == "--range" && i + 2 < count) {
      arguments.range = Interval{std::stod(texts[i + 1]), std::stod(texts[i + 2])};
      i += 2;
    }
  }
  return arguments;
}

}  // namespace

int main(int count, char** texts) {
  const Arguments arguments = read_arguments(count, texts);
  const CudaDevice device = cuda_device();
  if (!device.is_available) {
    fmt::print("skipped: {}\n", device.why_not);
    return kSkipped;
  }
  fmt::print("{}, {:.0f} GiB, driver {}, runtime {}\n", device.name,
             static_cast<double>(device.memory) / (1 << 30), device.driver, device.runtime);
  try {
    return arguments.times ? time_all(arguments) : compare_all(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
