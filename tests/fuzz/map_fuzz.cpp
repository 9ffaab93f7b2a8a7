// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  const Image<float> map(5, 7);
  io::write_pfm(folder / "map.pfm", map.view());
  io::write_pfm(folder / "color.pfm", Image<float>(2, 3, 3).view());
  io::write_tiff(folder / "map.tif", map.view());
  test::write_mat5_map(folder / "map.mat", "disparity", map.view());
}

std::string name_of(std::string_view bytes) {
  if (bytes.starts_with("P")) return "map.pfm";
  if (bytes.starts_with("\x93")) return "map.npy";
  if (bytes.starts_with("MATLAB")) return "map.mat";
  return bytes.starts_with("\x89HDF") ? "map.h5" : "map.tif";
}

/// Disparity or labels beside views, of any form.
void read(const std::filesystem::path& file) {
  tolerate([&] { (void)io::read_stored_labels(file, {3, 3}); });
  (void)io::read_values(file, {3, 3});
}

}  // namespace

const Harness kHarness{name_of, read, write_seeds};

}  // namespace episcope::fuzz
