// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/external_result.h"
#include "engine/io/models/result_file.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  const Scene& scene = seed_scene();
  Estimate estimate;
  estimate.field.disparity = scene.truth->field.disparity.clone();
  estimate.method = "test";
  estimate.parameters = {{"smoothing", 0.5}, {"labels", 16}};
  io::write_result(folder / "result.h5", estimate, Progress(1));
  estimate.layered.foreground.disparity = scene.truth->field.disparity.clone();
  estimate.layered.background.disparity = scene.truth->field.disparity.clone();
  io::write_result(folder / "layered.h5", estimate, Progress(1));
}

/// A result of this or another program, in HDF5.
void read(const std::filesystem::path& file) {
  tolerate([&] { (void)io::read_reading(file); });
  (void)io::read_result(file, seed_scene().light_field->grid(), {});
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("result.h5"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
