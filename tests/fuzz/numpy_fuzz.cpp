// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/npy.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <fmt/format.h>

#include <vector>

namespace episcope::fuzz {
namespace {

/// An array a view.
void write_joined(const std::filesystem::path& folder) {
  const ViewStack<std::uint8_t>& views = test::bytes_of(seed_scene());
  std::vector<test::ZippedFile> files;
  for (int i = 0; i < views.grid().count(); ++i) {
    const ViewIndex view = views.view_at(i);
    const std::filesystem::path file = folder / "view.npy";
    io::write_npy<std::uint8_t>(file, test::lengths_of(views, "yxc"),
                                {views.view(view).data, views.view_size()});
    files.push_back({fmt::format("{}_{}.npy", view.v, view.u), test::bytes_of_file(file)});
  }
  test::write_deflated_zip(folder / "views.npz", files);
}

/// A light field of 10 bits with disparity that is named like labels.
void write_fractions(const std::filesystem::path& folder) {
  const ViewStack<std::uint8_t>& views = test::bytes_of(seed_scene());
  std::vector<std::uint16_t> samples(views.data(), views.data() + views.size());
  for (std::uint16_t& sample : samples) sample *= 4;
  io::write_npy<std::uint16_t>(folder / "ten_bits.npy", test::lengths_of(views, "vuyxc"), samples);
  const ViewStack<float>& disparity = seed_scene().truth->field.disparity;
  io::write_npy<float>(folder / "label.npy", test::lengths_of(views, "vuyx"),
                       {disparity.data(), disparity.size()});
  test::write_deflated_zip(folder / "label.npz",
                           {{"lf.npy", test::bytes_of_file(folder / "lf.npy")},
                            {"label.npy", test::bytes_of_file(folder / "label.npy")}});
}

void write_seeds(const std::filesystem::path& folder) {
  write_seed("npy", folder / "lf.npy");
  write_seed("npz", folder / "lf.npz");
  test::write_deflated_zip(folder / "deflated.npz",
                           {{"lf.npy", test::bytes_of_file(folder / "lf.npy")}});
  write_joined(folder);
  write_fractions(folder);
}

std::string name_of(std::string_view bytes) {
  return bytes.starts_with("PK") ? "lf.npz" : "lf.npy";
}

}  // namespace

const Harness kHarness{name_of, open_light_field, write_seeds};

}  // namespace episcope::fuzz
