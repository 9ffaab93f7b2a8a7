// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/archive_files.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/hdf5_seeds.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  write_seed("archive", folder / "written.h5");
  test::write_raw_archive(folder / "raw.h5", seed_scene(), {.is_center_only = true});
  write_hdf5_seeds(folder);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("lf.h5"); }, open_light_field,
                       write_seeds};

}  // namespace episcope::fuzz
