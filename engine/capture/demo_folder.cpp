// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/demo_folder.h"

#include "engine/capture/mesh_file.h"
#include "engine/capture/photograph.h"
#include "engine/capture/pose_file.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/image_file.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

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

namespace {

constexpr double kMiddleDepth = 850;

double normal(std::mt19937& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random() * 0x1p-32;
  return sum;
}

/// Small angles in degrees about x, y and z.
std::array<double, 9> turn(double about_x, double about_y, double about_z) {
  constexpr double degree = std::numbers::pi / 180;
  const double cx = std::cos(about_x * degree);
  const double sx = std::sin(about_x * degree);
  const double cy = std::cos(about_y * degree);
  const double sy = std::sin(about_y * degree);
  const double cz = std::cos(about_z * degree);
  const double sz = std::sin(about_z * degree);
  return {cz * cy,
          cz * sy * sx - sz * cx,
          cz * sy * cx + sz * sx,
          sz * cy,
          sz * sy * sx + cz * cx,
          sz * sy * cx - cz * sx,
          -sy,
          cy * sx,
          cy * cx};
}

}  // namespace

DemoRig demo_rig(const DemoOptions& options) {
  DemoRig rig;
  rig.grid = options.grid;
  rig.camera.width = options.width;
  rig.camera.height = options.height;
  rig.camera.focal_x = rig.camera.focal_y = options.width * 680.0 / 480;
  rig.camera.center_x = options.width / 2.0 + 4;
  rig.camera.center_y = options.height / 2.0 - 3;
  rig.camera.distortion = {-0.1, 0.01, 0, 0, 0};
  rig.pose.rotation = turn(2, -6, 1);
  rig.pose.translation = {5, -8, kMiddleDepth};
  std::mt19937 random(options.seed);
  const double millimetres = kMiddleDepth / rig.camera.focal_x;  // of a px, at the middle depth
  const ViewIndex middle = options.grid.center();
  for (int i = 0; i < options.grid.count(); ++i) {
    const ViewIndex view = options.grid.view_at(i);
    Exposure exposure;
    exposure.x = (view.u - middle.u) * rig.step + options.jitter_px * millimetres * normal(random);
    exposure.y = (view.v - middle.v) * rig.step + options.jitter_px * millimetres * normal(random);
    exposure.rotation = turn(0.05, -0.08, 0.4);
    exposure.gain = 1 + options.gain * normal(random);
    exposure.noise = options.noise;
    exposure.seed = options.seed * 1000 + static_cast<unsigned>(i);
    rig.exposures.push_back(exposure);
  }
  return rig;
}

PlanePoint photographed(const DemoRig& rig, const Exposure& exposure, const Point3& on_scan) {
  const Point3 p = rig.pose.apply(on_scan);
  const double x = p.x - exposure.x;
  const double y = p.y - exposure.y;
  const auto& r = exposure.rotation;  // its transpose turns the gantry's axes into the camera's
  const double z = r[2] * x + r[5] * y + r[8] * p.z;
  return pixel_of_ray(
      rig.camera, {(r[0] * x + r[3] * y + r[6] * p.z) / z, (r[1] * x + r[4] * y + r[7] * p.z) / z});
}

std::vector<PointPair> demo_picks(const DemoRig& rig, const TriangleMesh& mesh,
                                  const DemoOptions& options) {
  const ViewIndex middle = rig.grid.center();
  const Exposure& exposure =
      rig.exposures[static_cast<std::size_t>(middle.v) * rig.grid.u + middle.u];
  const PlacedMesh placed{&mesh, rig.pose};
  const PlacedScene scene = place({&placed, 1}, Progress(1));
  ViewCamera camera{{rig.camera.focal_x, options.width * 1.0, options.height * 1.0},
                    exposure.x,
                    exposure.y,
                    0,
                    0,
                    2 * options.height,
                    2 * options.width};
  const ViewSurface surface = ViewRaster(scene, 1).view(camera, Progress());
  std::mt19937 random(options.seed + 77);
  std::vector<PointPair> picks;
  for (const Vertex& mark : scan_landmarks()) {
    const Point3 on_scan{mark[0], mark[1], mark[2]};
    const Point3 p = rig.pose.apply(on_scan);
    const int x = static_cast<int>(
        std::lround(camera.pinhole.focal_px * (p.x - camera.x) / p.z + camera.pinhole.center_x));
    const int y = static_cast<int>(
        std::lround(camera.pinhole.focal_px * (p.y - camera.y) / p.z + camera.pinhole.center_y));
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
    if (surface.inverse_depth.at(y, x) > 1.01 / p.z) continue;  // hidden
    const PlanePoint pixel = photographed(rig, exposure, on_scan);
    const bool is_inside = pixel.x > 30 && pixel.y > 30 && pixel.x < options.width - 30 &&
                           pixel.y < options.height - 30;
    if (!is_inside) continue;
    picks.push_back({fmt::format("p{}", picks.size() + 1),
                     pixel.x + options.pick_px * normal(random),
                     pixel.y + options.pick_px * normal(random), on_scan});
  }
  return picks;
}

}  // namespace episcope::capture
