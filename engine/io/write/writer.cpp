// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/write/writer.h"

#include "engine/core/text/suffix.h"
#include "engine/io/archive/write_scene.h"
#include "engine/io/arrays/write_arrays.h"
#include "engine/io/mosaic/write_eslf.h"
#include "engine/io/write/write_grid.h"

#include <algorithm>

namespace episcope::io {
namespace {

constexpr const char* kHdf5[] = {".h5", ".hdf5"};
constexpr const char* kNpy[] = {".npy"};
constexpr const char* kNpz[] = {".npz"};
constexpr const char* kMat[] = {".mat"};
constexpr const char* kEslf[] = {"_eslf.png", ".png"};

constexpr FormContents kArchive{.floats = FloatsHeld::Exactly,
                                .disparity = MapsHeld::All,
                                .is_depth = true,
                                .has_layers = true,
                                .labels = MapsHeld::All,
                                .has_scribbles = true,
                                .has_regions = true,
                                .has_valid = true,
                                .camera = CamerasHeld::All,
                                .has_range = true,
                                .has_positions = true};
constexpr FormContents kBenchmark{.floats = FloatsHeld::Rounded,
                                  .disparity = MapsHeld::All,
                                  .labels = MapsHeld::Center,
                                  .has_regions = true,
                                  .camera = CamerasHeld::Converging,
                                  .has_range = true};
constexpr FormContents kGrid{.floats = FloatsHeld::Exactly,
                             .disparity = MapsHeld::All,
                             .labels = MapsHeld::All,
                             .has_regions = true};

constexpr FormContents kArray{.floats = FloatsHeld::Exactly};
constexpr FormContents kArrays{.floats = FloatsHeld::Exactly,
                               .disparity = MapsHeld::All,
                               .labels = MapsHeld::All,
                               .has_valid = true};

constexpr FormContents kPicture{};

constexpr Writer kWriters[] = {
    {"archive", "the archive form", kHdf5, kArchive, write_archive},
    {"benchmark", "the benchmark form", {}, kBenchmark, write_benchmark_folder},
    {"grid", "a grid of images", {}, kGrid, write_grid_folder},
    {"npy", "the .npy form", kNpy, kArray, write_npy},
    {"npz", "the .npz form", kNpz, kArrays, write_npz},
    {"mat", "the .mat form", kMat, kArrays, write_mat},
    {"eslf", "a picture of lenslets", kEslf, kPicture, write_eslf},
};

}  // namespace

bool Writer::has_suffix_of(const std::filesystem::path& path) const {
  const std::string file = lower_case(path.filename().string());
  return std::ranges::any_of(suffixes, [&](const char* suffix) { return file.ends_with(suffix); });
}

std::span<const Writer> writers() {
  return kWriters;
}

const Writer* writer_named(const std::string& id) {
  const auto found = std::ranges::find(kWriters, id, &Writer::id);
  return found == std::end(kWriters) ? nullptr : found;
}

const Writer* writer_of(const std::filesystem::path& path) {
  const auto found = std::ranges::find_if(
      kWriters, [&](const Writer& writer) { return writer.has_suffix_of(path); });
  return found == std::end(kWriters) ? nullptr : found;
}

}  // namespace episcope::io
