// SPDX-License-Identifier: BSD-3-Clause
// Compares every method on the GPU with the CPU, or times it; run.sh builds and runs both:
//   episcope_cuda_compare compare --size 256 --methods epi_
//   episcope_cuda_compare compare --methods label --scenes demo
//   episcope_cuda_compare time --size 768 --methods st_ --range -2 2 --center
// `compare` goes through scenes, grids, types of samples and profiles. `label` is compared in its
// parts: votes of a seeded forest, labels from mistaken probabilities. `time` prints the least of
// several runs, the ratio to the CPU, and bytes and operations of every kernel.
#include "engine/core/text_table.h"
#include "engine/cuda/device.h"
#include "tests/cuda/agreement.h"
#include "tests/cuda/label_runs.h"
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
  std::string methods;   ///< What ids begin with,
  std::string scenes;    ///< and the texts of scenes that are compared on.
};

bool is_asked(const Arguments& arguments, const LabelRun& run) {
  return run.title.starts_with(arguments.methods);
}

// Of the bytes of two results, how many are equal.
double equal_share(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  if (a.size() != b.size() || a.empty()) return 0;
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.size(); ++i) equal += a[i] == b[i] ? 1 : 0;
  return static_cast<double>(equal) / static_cast<double>(a.size());
}

bool compare_run(const LabelRun& each, const std::string& scene, TextTable& table) {
  const auto cpu = each.run(Device::Cpu), device = each.run(Device::Cuda);
  const bool is_repeatable = each.run(Device::Cuda) == device;
  const double share = equal_share(cpu, device);
  const bool passes = is_repeatable && share >= each.share;
  table.rows.push_back({each.title, scene, fmt::format("{:.4f} %", 100 * share),
                        is_repeatable ? "yes" : "NO", passes ? "yes" : "NO"});
  return passes;
}

bool compare_labels(const Arguments& arguments) {
  bool passes = true;
  TextTable table{{"labels", "scene", "equal", "repeatable", "passes"}, {}};
  const LabelRun forest = forest_run(arguments.size, 1);
  if (is_asked(arguments, forest)) passes = compare_run(forest, "-", table);
  for (const char* text :
       {"demo", "random?seed=1&kind=room", "random?seed=3&kind=thin", "random?seed=4&grid=1x9",
        "random?seed=4&grid=6x1", "random?seed=7&grid=3x17"}) {
    if (!std::string(text).starts_with(arguments.scenes)) continue;
    const Scene scene = make_scene(text, arguments.size);
    for (const LabelRun& each : label_runs(scene)) {
      if (is_asked(arguments, each)) passes = compare_run(each, text, table) && passes;
    }
  }
  if (!table.rows.empty()) fmt::print("{}\n", table_to_text(table));
  return passes;
}

int compare_all(const Arguments& arguments) {
  bool passes = compare_labels(arguments);
  TextTable table{{"method", "scene", "within limit", "largest", "confidence", "MSE CPU", "MSE GPU",
                   "repeatable", "passes"},
                  {}};
  for (const std::string& text : scene_texts()) {
    if (!text.starts_with(arguments.scenes)) continue;
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
  if (!table.rows.empty()) fmt::print("{}\n", table_to_text(table));
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

void print_timing(const std::string& title, const Timing& timing, const DeviceBounds& bounds) {
  fmt::print("{}: {:.1f} ms, kernels {:.1f} ms", title, 1e3 * timing.seconds,
             1e3 * timing.kernel_seconds);
  if (timing.cpu_seconds > 0) {
    fmt::print(", CPU {:.0f} ms, ratio {:.1f}", 1e3 * timing.cpu_seconds,
               timing.cpu_seconds / timing.seconds);
  }
  fmt::print("\n");
  print_kernels(timing.kernels, bounds);
  std::fflush(stdout);
}

// 9×9 views of 512² pixels, 13 labels.
void time_labels(const Arguments& arguments, const DeviceBounds& bounds) {
  constexpr int kSize = 512, kViews = 81;
  const std::string label = "label";
  if (!label.starts_with(arguments.methods) && !arguments.methods.starts_with(label)) return;
  const Scene scene = make_label_scene(kSize);
  std::vector<LabelRun> runs = label_runs(scene);
  runs.push_back(forest_run(kSize, kViews));
  for (const LabelRun& each : runs) {
    if (!is_asked(arguments, each)) continue;
    const auto run = [&](Device device) { static_cast<void>(each.run(device)); };
    print_timing(each.title, time_runs(run, arguments.with_cpu), bounds);
  }
}

int time_all(const Arguments& arguments) {
  const DeviceBounds bounds = measure_device_bounds();
  fmt::print("copy {:.0f} GB/s, FP32 {:.0f} GFLOP/s\n\n", bounds.bytes / 1e9,
             bounds.operations / 1e9);
  time_labels(arguments, bounds);
  const Scene scene = make_scene("demo", arguments.size);
  for (Case& each : cases(arguments.methods)) {
    if (arguments.range) each.values.emplace_back("range", arguments.range);
    if (arguments.only_center) each.views = ViewSelection::Center;
    print_timing(each.title, time_case(each, scene, arguments.with_cpu), bounds);
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
    if (text == "--scenes" && has_value) arguments.scenes = texts[++i];
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
