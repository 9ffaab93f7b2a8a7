// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/demo/demo_folder.h"

#include "engine/capture/demo/pattern_photograph.h"
#include "engine/capture/demo/scan_mesh.h"
#include "engine/capture/mesh/mesh_file.h"
#include "engine/capture/pose/pairs_file.h"
#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/grid/image_file.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace episcope::capture {
namespace {

namespace fs = std::filesystem;

constexpr int kPatternPhotographs = 14;
constexpr double kPatternDistance = 620;  // mm

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    throw IoError(folder, "this folder is not empty; name a new one");
  }
  fs::create_directories(folder / "photographs", error);
  fs::create_directories(folder / "pattern", error);
  if (error) throw IoError(folder, "this folder cannot be made (" + error.message() + ")");
}

void blur(Image<std::uint8_t>& picture) {
  const cv::Mat matrix(picture.height(), picture.width(), CV_8U, picture.data());
  cv::GaussianBlur(matrix, matrix, {0, 0}, 3);
}

void write_pattern(const fs::path& folder, const DemoRig& rig, const Progress& progress) {
  const Pattern pattern = demo_pattern();
  const std::vector<RigidPose> poses =
      pattern_poses(pattern, kPatternDistance, kPatternPhotographs);
  parallel_for(kPatternPhotographs, progress, [&](int i) {
    RigidPose pose = poses[i];
    if (i == kPatternPhotographs - 1) pose.translation[0] += 0.3 * kPatternDistance;  // cut off
    Exposure exposure;
    exposure.noise = 2;
    exposure.seed = 500 + static_cast<unsigned>(i);
    Image<std::uint8_t> picture = pattern_photograph(pattern, pose, rig.camera, exposure);
    if (i == kPatternPhotographs - 2) blur(picture);
    io::write_png(folder / fmt::format("{:02}.png", i + 1), picture);
  });
}

constexpr const char* kReadme =
    "From photographs to a light field with ground truth, in this folder:\n\n"
    "episcope-cli calibrate pattern/*.png --pattern 9x6 --square 25 -o camera.yml\n"
    "episcope-cli rectify photographs --camera camera.yml --step {:g} --picks picks.csv "
    "--pairs pairs.csv -o raw.h5\n"
    "episcope-cli pose raw.h5 --mesh mesh.ply --pairs pairs.csv -o pose.json\n"
    "episcope-cli ground-truth raw.h5 --pose pose.json -o lf.h5\n"
    "episcope lf.h5\n";

}  // namespace

Pattern demo_pattern() {
  return {PatternKind::Chessboard, 9, 6, 25};
}

Image<std::uint8_t> demo_photograph(const DemoRig& rig, const TriangleMesh& mesh, ViewIndex view,
                                    const Progress& progress) {
  const PlacedMesh placed{&mesh, rig.pose};
  const PlacedScene scene = place({&placed, 1}, progress.part(0, 0.1));
  const auto& exposure = rig.exposures[static_cast<std::size_t>(view.v) * rig.grid.u + view.u];
  return photograph(scene, rig.camera, exposure, progress.part(0.1, 1));
}

LightField demo_photographs(const DemoRig& rig, const TriangleMesh& mesh,
                            const Progress& progress) {
  const PlacedMesh placed{&mesh, rig.pose};
  const PlacedScene scene = place({&placed, 1}, progress.part(0, 0.01));
  ViewStack<std::uint8_t> samples(rig.grid, rig.camera.height, rig.camera.width, 3);
  for (int i = 0; i < rig.grid.count(); ++i) {
    const ViewIndex view = rig.grid.view_at(i);
    progress.step("photographing view " + view_text(view));
    const double begin = static_cast<double>(i) / rig.grid.count();
    const Image<std::uint8_t> picture = photograph(
        scene, rig.camera, rig.exposures[i], progress.part(begin, begin + 1.0 / rig.grid.count()));
    std::copy(picture.begin(), picture.end(), samples.view(view).data);
  }
  LightFieldInfo info;
  info.name = "gantry";
  return LightField(std::move(samples), info);
}

void write_demo_folder(const fs::path& folder, const DemoOptions& options,
                       const Progress& progress) {
  make_folder(folder);
  const DemoRig rig = demo_rig(options);
  const TriangleMesh mesh = scan_mesh(options.detail);
  progress.step("photographing the pattern");
  write_pattern(folder / "pattern", rig, progress.part(0, 0.2));
  const LightField photographs = demo_photographs(rig, mesh, progress.part(0.2, 0.95));
  for (int i = 0; i < rig.grid.count(); ++i) {
    progress.check();
    const ViewIndex view = rig.grid.view_at(i);
    io::write_png(folder / "photographs" / fmt::format("{:02}_{:02}.png", view.v, view.u),
                  photographs.view<std::uint8_t>(view));
  }
  write_mesh(folder / "mesh.ply", scan_mesh_with_hole(options.detail));
  write_pairs(folder / "picks.csv", demo_picks(rig, mesh, options));
  io::write_atomically(folder / "readme.txt", fmt::format(fmt::runtime(kReadme), rig.step));
  progress.report(1);
}

}  // namespace episcope::capture
