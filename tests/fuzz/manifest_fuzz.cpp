// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/blender_reader.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <vector>

namespace episcope::fuzz {
namespace {

constexpr const char* kManifest =
    R"({"format": "episcope light field", "version": 1, "blender": "3.4.1",
 "grid": {"rows": 1, "columns": 2}, "size": {"width": 3, "height": 2},
 "camera": {"baseline": 0.5, "focal_length_px": 120, "zero_plane": 7.5},
 "disparity_range": [-0.5, 1.5], "labels": [{"value": 2, "name": "square"}],
 "files": {"views": "{row:02}_{column:02}.png", "depth": "{row:02}_{column:02}.npy",
  "labels": "{row:02}_{column:02}.npy"}, "complete": [[0, 0], [0, 1]]})";

/// Views and maps that the manifest names.
void prepare(const std::filesystem::path& folder) {
  const std::vector<float> depth(6, 8.0F);
  for (const char* view : {"00_00", "00_01"}) {
    io::write_png(folder / (std::string(view) + ".png"), Image<std::uint8_t>(2, 3, 3).view());
    io::write_npy<float>(folder / (std::string(view) + ".npy"), {2, 3}, depth);
  }
}

void write_seeds(const std::filesystem::path& folder) {
  write_bytes(folder / "manifest", kManifest);
}

void read(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  if (!io::has_render_manifest(folder)) return;
  const io::RenderManifest manifest = io::read_render_manifest(folder);
  if (manifest.has("views")) (void)manifest.file("views", manifest.grid.center());
  if (!is_read_whole()) return;
  open_light_field(folder);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string(io::kRenderManifest); }, read,
                       write_seeds, prepare};

}  // namespace episcope::fuzz
