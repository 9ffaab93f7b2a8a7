// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/arrays/array_files.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  write_seed("npy", folder / "lf.npy");
  write_seed("npz", folder / "lf.npz");
  test::write_deflated_zip(folder / "deflated.npz",
                           {{"lf.npy", test::bytes_of_file(folder / "lf.npy")}});
}

std::string name_of(std::string_view bytes) {
  return bytes.starts_with("PK") ? "lf.npz" : "lf.npy";
}

}  // namespace

const Harness kHarness{name_of, open_light_field, write_seeds};

}  // namespace episcope::fuzz
