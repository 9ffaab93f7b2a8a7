// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/demo_folder.h"

#include "engine/capture/mesh_file.h"
#include "engine/capture/pixel_surface.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/image_file.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
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
    "episcope-cli calibrate pattern/*.png --board 9x6 --square 25 -o camera.yml\n"
    "episcope-cli rectify photographs --camera camera.yml --step {:g} --picks picks.csv "
    "--pairs pairs.csv -o raw.h5\n"
    "episcope-cli pose raw.h5 --mesh mesh.ply --pairs pairs.csv -o pose.json\n"
    "episcope-cli ground-truth raw.h5 --pose pose.json -o lf.h5\n"
    "episcope lf.h5\n";

constexpr double kMiddleDepth = 850;

// The sum of twelve uniform numbers, because std::normal_distribution differs between libraries.
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

constexpr int kFine = 3;          // samples along a pixel
constexpr double kMargin = 1.08;  // by how much the fine picture is wider than the rays need

PlanePoint turned(const std::array<double, 9>& r, const PlanePoint& ray) {
  const double z = r[6] * ray.x + r[7] * ray.y + r[8];
  return {(r[0] * ray.x + r[1] * ray.y + r[2]) / z, (r[3] * ray.x + r[4] * ray.y + r[5]) / z};
}

/// The fine picture, without lens and rotation, that holds all rays of the camera.
ViewCamera fine_camera(const LensCamera& camera, const Exposure& exposure) {
  double reach_x = 0;
  double reach_y = 0;
  for (int i = 0; i <= 8; ++i) {
    for (int k = 0; k <= 8; ++k) {
      const PlanePoint pixel{camera.width * i / 8.0, camera.height * k / 8.0};
      const PlanePoint ray = turned(exposure.rotation, ray_of_pixel(camera, pixel));
      reach_x = std::max(reach_x, std::abs(ray.x));
      reach_y = std::max(reach_y, std::abs(ray.y));
    }
  }
  ViewCamera fine;
  const double focal = kFine * camera.focal_x;
  fine.width = static_cast<int>(2 * kMargin * reach_x * focal);
  fine.height = static_cast<int>(2 * kMargin * reach_y * focal);
  fine.pinhole = {focal, (fine.width - 1) / 2.0, (fine.height - 1) / 2.0};
  fine.x = exposure.x;
  fine.y = exposure.y;
  return fine;
}

std::array<float, 3> color_at(const Point3& p) {
  const double broad = solid_noise(p, 35, 1);
  const double middle = solid_noise(p, 11, 2);
  const double fine = solid_noise(p, 4.5, 3);
  std::array<float, 3> color;
  constexpr double base[3] = {138, 122, 104};
  for (int c = 0; c < 3; ++c) {
    const double tint = solid_noise(p, 18, 4 + static_cast<unsigned>(c));
    color[c] = static_cast<float>(
        std::clamp(base[c] + 30 * broad + 34 * middle + 32 * fine + 16 * tint, 4.0, 250.0));
  }
  return color;
}

Image<float> colors_of(const ViewSurface& surface, const ViewCamera& camera,
                       const Progress& progress) {
  Image<float> colors(camera.height, camera.width, 3, 20.0F);
  parallel_for(camera.height, progress, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      const double w = surface.inverse_depth.at(y, x);
      if (surface.triangle.at(y, x) == PixelSurface::kNone || !(w > 0)) continue;
      const double scale = 1 / (w * camera.pinhole.focal_px);
      const Point3 place{(x - camera.pinhole.center_x) * scale + camera.x,
                         (y - camera.pinhole.center_y) * scale + camera.y, 1 / w};
      const std::array<float, 3> color = color_at(place);
      std::copy(color.begin(), color.end(), &colors.at(y, x));
    }
  });
  return colors;
}

void add_sample(const Image<float>& fine, const PlanePoint& at, float* sum) {
  const int x = std::clamp(static_cast<int>(at.x), 0, fine.width() - 2);
  const int y = std::clamp(static_cast<int>(at.y), 0, fine.height() - 2);
  const auto tx = static_cast<float>(at.x - x);
  const auto ty = static_cast<float>(at.y - y);
  for (int c = 0; c < 3; ++c) {
    const float top = fine.at(y, x, c) * (1 - tx) + fine.at(y, x + 1, c) * tx;
    const float bottom = fine.at(y + 1, x, c) * (1 - tx) + fine.at(y + 1, x + 1, c) * tx;
    sum[c] += (top * (1 - ty) + bottom * ty) / (kFine * kFine);
  }
}

// Position of sample `i` of a pixel with `along`² samples on a regular grid, row by row.
PlanePoint sample_of_pixel(int y, int x, int along, int i) {
  const int row = i / along, column = i % along;
  return {x + (column + 0.5) / along - 0.5, y + (row + 0.5) / along - 0.5};
}

constexpr int kPixelsPerSquare = 60;
constexpr int kPatternFine = 4;

Image<std::uint8_t> chessboard(const Pattern& pattern, int pixels) {
  const int margin = pixels / 2;
  Image<std::uint8_t> picture((pattern.rows + 1) * pixels + 2 * margin,
                              (pattern.columns + 1) * pixels + 2 * margin, 1, 235);
  for (int y = margin; y < picture.height() - margin; ++y) {
    for (int x = margin; x < picture.width() - margin; ++x) {
      if (((x - margin) / pixels + (y - margin) / pixels) % 2 == 0) picture.at(y, x) = 20;
    }
  }
  return picture;
}

Image<std::uint8_t> circles(const Pattern& pattern, int pixels) {
  Image<std::uint8_t> picture((pattern.rows + 1) * pixels, (pattern.columns + 1) * pixels, 1, 235);
  const double radius = 0.3 * pixels;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double column = std::clamp(std::round((x + 0.5) / pixels), 1.0, 1.0 * pattern.columns);
      const double row = std::clamp(std::round((y + 0.5) / pixels), 1.0, 1.0 * pattern.rows);
      const double off = std::hypot(x + 0.5 - column * pixels, y + 0.5 - row * pixels);
      picture.at(y, x) =
          static_cast<std::uint8_t>(20 + 215 * std::clamp(off - radius + 0.5, 0.0, 1.0));
    }
  }
  return picture;
}

float sample(const Image<std::uint8_t>& picture, double x, double y) {
  const double px = x - 0.5;  // samples are at the centers of their pixels
  const double py = y - 0.5;
  if (px < 0 || py < 0 || px >= picture.width() - 1 || py >= picture.height() - 1) return 110;
  const int ix = static_cast<int>(px);
  const int iy = static_cast<int>(py);
  const auto tx = static_cast<float>(px - ix);
  const auto ty = static_cast<float>(py - iy);
  const auto at = [&](int dy, int dx) { return static_cast<float>(picture.at(iy + dy, ix + dx)); };
  return (at(0, 0) * (1 - tx) + at(0, 1) * tx) * (1 - ty) +
         (at(1, 0) * (1 - tx) + at(1, 1) * tx) * ty;
}

/// Where a ray meets the plane of the pattern, in its unit; false if it does not.
bool meets(const RigidPose& pose, const PlanePoint& ray, PlanePoint& place) {
  const auto& r = pose.rotation;
  const auto& t = pose.translation;
  const double normal[3] = {r[2], r[5], r[8]};
  const double slope = normal[0] * ray.x + normal[1] * ray.y + normal[2];
  const double depth = (normal[0] * t[0] + normal[1] * t[1] + normal[2] * t[2]) / slope;
  if (!(depth > 0) || !std::isfinite(depth)) return false;
  const double from[3] = {ray.x * depth - t[0], ray.y * depth - t[1], depth - t[2]};
  place = {r[0] * from[0] + r[3] * from[1] + r[6] * from[2],
           r[1] * from[0] + r[4] * from[1] + r[7] * from[2]};
  return true;
}

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

Image<std::uint8_t> exposed(const Image<float>& light, const Exposure& exposure) {
  Image<std::uint8_t> samples(light.height(), light.width(), light.channels());
  std::mt19937 random(exposure.seed);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double value = light.data()[i] * exposure.gain + exposure.noise * normal(random);
    samples.data()[i] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return samples;
}

Image<std::uint8_t> photograph(const PlacedScene& scene, const LensCamera& camera,
                               const Exposure& exposure, const Progress& progress) {
  const ViewCamera fine = fine_camera(camera, exposure);
  ViewRaster raster(scene, std::numeric_limits<double>::infinity());
  const ViewSurface surface = raster.view(fine, progress.part(0, 0.5));
  const Image<float> colors = colors_of(surface, fine, progress.part(0.5, 0.9));
  Image<float> light(camera.height, camera.width, 3);
  parallel_for(camera.height, progress.part(0.9, 1), [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      for (int i = 0; i < kFine * kFine; ++i) {
        const PlanePoint ray =
            turned(exposure.rotation, ray_of_pixel(camera, sample_of_pixel(y, x, kFine, i)));
        add_sample(colors,
                   {ray.x * fine.pinhole.focal_px + fine.pinhole.center_x,
                    ray.y * fine.pinhole.focal_px + fine.pinhole.center_y},
                   &light.at(y, x));
      }
    }
  });
  return exposed(light, exposure);
}

Image<std::uint8_t> pattern_picture(const Pattern& pattern, int pixels_per_square) {
  switch (pattern.kind) {
    case PatternKind::Charuco:
      return draw_charuco(pattern, pixels_per_square);
    case PatternKind::Circles:
      return circles(pattern, pixels_per_square);
    case PatternKind::Chessboard:
      break;
  }
  return chessboard(pattern, pixels_per_square);
}

Image<std::uint8_t> pattern_photograph(const Pattern& pattern, const RigidPose& pose,
                                       const LensCamera& camera, const Exposure& exposure) {
  const Image<std::uint8_t> picture = pattern_picture(pattern, kPixelsPerSquare);
  const double scale = kPixelsPerSquare / pattern.square;
  Image<float> light(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      float sum = 0;
      for (int i = 0; i < kPatternFine * kPatternFine; ++i) {
        PlanePoint place;
        const bool hits =
            meets(pose, ray_of_pixel(camera, sample_of_pixel(y, x, kPatternFine, i)), place);
        sum += hits ? sample(picture, place.x * scale, place.y * scale) : 110;
      }
      light.at(y, x) = sum / (kPatternFine * kPatternFine);
    }
  }
  return exposed(light, exposure);
}

std::vector<RigidPose> pattern_poses(const Pattern& pattern, double distance, int count) {
  std::vector<RigidPose> poses;
  const double half_width = pattern.square * (pattern.columns + 2) / 2;
  const double half_height = pattern.square * (pattern.rows + 2) / 2;
  for (int i = 0; i < count; ++i) {
    const double phase = 2.4 * i;
    const double a = 0.5 * std::cos(phase);   // about y,
    const double b = 0.45 * std::sin(phase);  // and about x
    const double ca = std::cos(a);
    const double sa = std::sin(a);
    const double cb = std::cos(b);
    const double sb = std::sin(b);
    RigidPose pose;
    pose.rotation = {ca, sa * sb, sa * cb, 0, cb, -sb, -sa, ca * sb, ca * cb};
    const Point3 middle = pose.apply({half_width, half_height, 0});
    pose.translation = {0.12 * distance * std::sin(1.7 * i) - middle.x,
                        0.09 * distance * std::cos(2.9 * i) - middle.y,
                        distance * (1 + 0.15 * std::sin(0.9 * i)) - middle.z};
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace episcope::capture
