// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  const ViewStack<std::uint8_t>& views = test::bytes_of(seed_scene());
  write_seed("mat", folder / "version_7.mat");
  test::write_mat5(folder / "plain.mat", views, {});
  test::write_mat5(folder / "compressed.mat", views, {.is_compressed = true, .has_other = true});
  for (const bool is_compressed : {false, true}) {
    const char* name = is_compressed ? "packed_cells.mat" : "cells.mat";
    test::write_mat5_cells(folder / name, views, is_compressed);
  }
  test::write_mat5(folder / "map.mat", views,
                   {.label = seed_scene().truth->field.disparity.view({1, 1})});
  test::write_mat5(folder / "struct.mat", views, {.is_double = true, .structure = "s"});
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("lf.mat"); }, open_light_field,
                       write_seeds};

}  // namespace episcope::fuzz
