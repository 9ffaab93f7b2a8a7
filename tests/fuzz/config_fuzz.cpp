// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/benchmark_reader.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/sidecar_maps/map_places.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

constexpr const char* kConfig = "parameters.cfg";

void prepare(const std::filesystem::path& folder) {
  write_seed("benchmark", folder / "scene");
}

void write_seeds(const std::filesystem::path& folder) {
  prepare(folder);
  write_bytes(folder / "written.cfg", test::bytes_of_file(folder / "scene" / kConfig));
  std::filesystem::remove_all(folder / "scene");
  write_bytes(folder / "param.txt", "base_x = 0.05\nbase_y = 0.05\n");
}

/// The parameters of a scene of the 2016 benchmark, and those of a folder with a baseline.
void read(const std::filesystem::path& file) {
  const io::ConfigFile config(file);
  for (const char* key : {"num_cams_x", "baseline_mm", "focal_length_mm", "disp_min"}) {
    (void)config.number(key);
  }
  io::FileUsage account(file.parent_path());
  (void)io::stated_unit(file.parent_path(), account);
  if (!is_read_whole()) return;
  const std::filesystem::path scene = file.parent_path() / "scene";
  std::filesystem::copy_file(file, scene / kConfig,
                             std::filesystem::copy_options::overwrite_existing);
  open_light_field(scene);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string(io::kBaselineFile); }, read,
                       write_seeds, prepare};

}  // namespace episcope::fuzz
