// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// A disparity map as other programs write it: PFM, 32-bit float TIFF, `.npy` of two or four
/// axes, or an HDF5 file with one 2-D or 4-D dataset of float samples. A 2-D map belongs to the
/// centre view of `grid`. Values that are not finite become invalid pixels. Throws IoError with one
/// sentence.
[[nodiscard]] DisparityField read_disparity_map(const std::filesystem::path& path, GridShape grid);

/// A result of another program: a file as above, or a folder of the 2016 submission form
/// (`disp_maps/<scene>.pfm`, `runtimes/<scene>.txt`), of which `scene` picks the map. Throws
/// IoError.
[[nodiscard]] Estimate read_external_result(const std::filesystem::path& path, GridShape grid,
                                            const std::string& scene);

/// Marks values that are not finite as invalid and sets them to 0.
void mark_invalid(DisparityField& field);

/// A scene of which a submission to the 2016 benchmark holds a map.
struct SubmittedScene {
  std::string name;
  int height = 512;
  int width = 512;
};

/// The twelve scenes of which the benchmark wants maps: four stratified ones, four for training,
/// four whose truth is not published.
[[nodiscard]] std::vector<SubmittedScene> benchmark_scenes();

/// `<folder>/disp_maps/<scene>.pfm`.
[[nodiscard]] std::filesystem::path submitted_map_file(const std::filesystem::path& folder,
                                                       const std::string& scene);
/// `<folder>/runtimes/<scene>.txt`.
[[nodiscard]] std::filesystem::path submitted_runtime_file(const std::filesystem::path& folder,
                                                           const std::string& scene);

/// Writes map and runtime of one scene into a submission, whose folders are made where they are
/// missing. A submission has a value everywhere: a pixel without one gets the farther of the
/// nearest values to its left and right, or that of the row above or below if its row has none.
/// Returns how many pixels were filled so. Each file is atomic. Throws IoError; InvalidInput if
/// the map has no value at all or the seconds are not above 0.
std::size_t write_submitted_scene(const std::filesystem::path& folder, const std::string& scene,
                                  const DisparityView& map, double seconds);

/// What keeps a folder from being accepted for these scenes, a sentence each; empty if nothing
/// does. As the benchmark's own check: every scene has a PFM of one channel and the right size,
/// whose header is one line each for kind, size and scale and whose samples fill the file exactly,
/// and a runtime whose first line is a number. Beyond it: samples are finite and little endian, the
/// runtime is above 0. Source: evaluation toolkit of [HJKG16].
[[nodiscard]] std::vector<std::string> submission_problems(
    const std::filesystem::path& folder, const std::vector<SubmittedScene>& scenes);

}  // namespace episcope::io
