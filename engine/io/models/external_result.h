// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/io/base/hdf5_file.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Forms of disparity maps, for help and errors.
inline constexpr const char* kMapForms =
    "HDF5 or .mat (5 to 7.3) with one map, .npy, .npz, PFM, float TIFF or EXR, .csv, .txt, .dat";

/// Whether a dataset can be a disparity map, of one view or of all: floats, or whole numbers that
/// are named disparity.
[[nodiscard]] bool can_be_map(const Hdf5Dataset& dataset);

/// Reads a disparity map of another program: PFM, 32-bit float TIFF or EXR (the channel of
/// depth, else the first), text (`read_text_map`),
/// `.npy` of two or four axes, an `.npz` or MATLAB file with one such array, or an HDF5 file with
/// one such dataset (`can_be_map`; floats go first), in the order of axes that it states
/// (`stated_map_layout`). Of several arrays, the only one named like disparity is meant. A 2-D map
/// belongs to the center view of `grid`. Values that are not finite, and those that an HDF5 file
/// states as `_FillValue` or `missing_value`, become invalid pixels; `scale_factor` and
/// `add_offset` of such a file are applied (CF conventions). Throws IoError with one
/// sentence, also for an `.npz` or MATLAB file with a light field.
[[nodiscard]] DisparityField read_disparity_map(const std::filesystem::path& path, GridShape grid);

/// Reads a result of another program: a file as above, or a folder of the 2016 submission form
/// (`disp_maps/<scene>.pfm`, `runtimes/<scene>.txt`), of which `scene` picks the map. Beside the
/// disparity of an `.npz`, MATLAB or HDF5 file, arrays of its shape named `confidence` (0 … 1, else
/// left out with a note), `valid` (0 = invalid) and `disparity_second` (NaN = none) are read, too.
/// Throws IoError.
[[nodiscard]] Estimate read_external_result(const std::filesystem::path& path, GridShape grid,
                                            const std::string& scene);

/// Whether an `.npz` file, or a MATLAB file of version 5 to 7, holds maps and no light field. False
/// for other files, and for damaged ones.
[[nodiscard]] bool is_map_archive(const std::filesystem::path& path);

/// The views that the map of such a file or of an `.npy` file covers. Throws IoError.
[[nodiscard]] GridShape grid_of_arrays(const std::filesystem::path& path);

/// Marks values that are not finite as invalid and sets them to 0.
void mark_invalid(DisparityField& field);

/// A scene of which a submission to the 2016 benchmark holds a map.
struct SubmittedScene {
  std::string name;
  int height = 512;
  int width = 512;
};

/// The twelve scenes of the benchmark: four stratified, four for training, four without published
/// truth.
[[nodiscard]] std::vector<SubmittedScene> benchmark_scenes();

/// `<folder>/disp_maps/<scene>.pfm`.
[[nodiscard]] std::filesystem::path submitted_map_file(const std::filesystem::path& folder,
                                                       const std::string& scene);
/// `<folder>/runtimes/<scene>.txt`.
[[nodiscard]] std::filesystem::path submitted_runtime_file(const std::filesystem::path& folder,
                                                           const std::string& scene);

/// Writes map and runtime of one scene into a submission; creates missing folders. A submission has
/// a value everywhere. A pixel without one gets the farther of the nearest values to its left and
/// right, or a value of the row above or below if its row has none. Returns the number of pixels
/// filled. Each file is atomic. Throws IoError; InvalidInput if the map has no value at all or the
/// seconds are not above 0.
std::size_t write_submitted_scene(const std::filesystem::path& folder, const std::string& scene,
                                  const DisparityView& map, double seconds);

/// Lists why the benchmark would reject a submission of these scenes, a sentence each; empty if it
/// would not. As in its own check, every scene needs a PFM of one channel and the right size, and a
/// runtime whose first line is a number. The PFM header has a line each for kind, size and scale;
/// samples fill the rest exactly. In addition, samples must be finite and little endian, runtimes
/// above 0. Source: evaluation toolkit of [HJKG16].
[[nodiscard]] std::vector<std::string> submission_problems(
    const std::filesystem::path& folder, const std::vector<SubmittedScene>& scenes);

}  // namespace episcope::io
