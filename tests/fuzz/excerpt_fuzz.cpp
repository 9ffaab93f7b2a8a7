// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/image_grid.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void prepare(const std::filesystem::path& folder) {
  write_seed("grid", folder / "lf");
  write_bytes(folder / "depth.bin", std::string(6 * 8 * sizeof(float), 'A'));
}

void write_seeds(const std::filesystem::path& folder) {
  write_bytes(folder / "attributes",
              "0.5 //dH\n9.375 //focalLength\n2 //shift\n-1 //min_disp\n1 //max_disp\n");
}

/// The attributes of an excerpt of the 2013 archive.
void read(const std::filesystem::path& file) {
  (void)io::read_excerpt_attributes(file);
  if (!is_read_whole()) return;
  open_light_field(file.parent_path());
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("attributes.dat"); }, read,
                       write_seeds, prepare};

}  // namespace episcope::fuzz
