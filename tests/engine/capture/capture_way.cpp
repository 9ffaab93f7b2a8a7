// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/capture/capture_way.h"

#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"
#include "engine/capture/mesh_file.h"

#include "tests/engine/capture/exact_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace episcope::accuracy {

using namespace capture;

namespace {

constexpr int kPatterns = 12;
constexpr double kPatternDistance = 620;  // mm
constexpr int kEdgeWidth = 5;             // px
constexpr double kJump_px = 0.5;
constexpr int kBorder = 5;
constexpr int kRowStep = 9;

Calibration calibrated(const DemoRig& rig, const DemoOptions& options) {
  std::vector<PatternPhotograph> photographs;
  for (const RigidPose& pose : pattern_poses(demo_pattern(), kPatternDistance, kPatterns)) {
    Exposure exposure;
    exposure.noise = options.noise;
    exposure.seed = 40 + 100 * options.seed + static_cast<unsigned>(photographs.size());
    const Image<std::uint8_t> picture =
        pattern_photograph(demo_pattern(), pose, rig.camera, exposure);
    PatternPhotograph photograph;
    photograph.found = find_pattern(picture, demo_pattern());
    photograph.sharpness = sharpness(picture, photograph.found.pixels, kEdgeWidth);
    photographs.push_back(photograph);
  }
  return calibrate(photographs, rig.camera.height, rig.camera.width);
}

const Exposure& center_exposure(const DemoRig& rig) {
  const ViewIndex middle = rig.grid.center();
  return rig.exposures[static_cast<std::size_t>(middle.v) * rig.grid.u + middle.u];
}

/// |disparity − exact| of unmasked pixels at random places, in increasing order.
std::vector<double> disparity_errors(const CaptureWay& way, const ExactCenter& exact, int samples) {
  const DisparityView map = way.truth.field.view(way.rig.grid.center());
  std::mt19937 random(9);
  std::vector<double> errors;
  while (static_cast<int>(errors.size()) < samples) {
    const int y = static_cast<int>(random() % static_cast<unsigned>(map.disparity.height));
    const int x = static_cast<int>(random() % static_cast<unsigned>(map.disparity.width));
    if (!map.is_valid(y, x)) continue;
    const auto point = exact.point(x, y);
    errors.push_back(point ? std::abs(map.disparity.at(y, x) - exact.disparity(*point))
                           : std::numeric_limits<double>::infinity());
  }
  std::ranges::sort(errors);
  return errors;
}

void count_jumps(const CaptureWay& way, const ExactCenter& exact, CaptureErrors& errors) {
  const DisparityView map = way.truth.field.view(way.rig.grid.center());
  for (int y = kBorder; y < map.disparity.height - kBorder; y += kRowStep) {
    std::optional<Point3> last;
    for (int x = kBorder; x < map.disparity.width - kBorder; ++x) {
      const auto point = exact.point(x, y);
      const bool jumps =
          point && last && std::abs(exact.disparity(*point) - exact.disparity(*last)) > kJump_px;
      last = point;
      if (!jumps) continue;
      ++errors.jumps;
      errors.missed += map.is_valid(y, x) && map.is_valid(y, x - 1) ? 1 : 0;
    }
  }
}

}  // namespace

CaptureWay go_capture_way(const DemoOptions& options, const Progress& progress) {
  CaptureWay way;
  way.options = options;
  way.rig = demo_rig(options);
  way.mesh = scan_mesh(options.detail);
  way.calibration = calibrated(way.rig, options);
  const LightField photographs = demo_photographs(way.rig, way.mesh, progress.part(0, 0.5));
  way.rectified =
      rectify(photographs, way.calibration.camera, {way.rig.step, true}, progress.part(0.5, 0.9));
  std::vector<PointPair> pairs = demo_picks(way.rig, way.mesh, options);
  for (PointPair& pair : pairs) {
    const PlanePoint place =
        way.rectified.center_pixel(way.calibration.camera, {pair.x_px, pair.y_px});
    pair.x_px = place.x;
    pair.y_px = place.y;
  }
  const LightField& field = *way.rectified.light_field;
  way.pose = solve_pose(pairs, field.info().camera);
  way.cameras = {field.grid(), field.height(), field.width(), field.info().camera};
  const PlacedMesh placed{&way.mesh, way.pose.pose};
  way.truth = visible_depth({&placed, 1}, way.cameras, {}, progress.part(0.9, 1));
  return way;
}

ExactCenter::ExactCenter(const CaptureWay& way)
    : way_(way),
      map_(way.rectified.alignment, way.calibration.camera, way.rig.grid, way.rectified.crop,
           way.cameras.camera.shift),
      exposure_(center_exposure(way.rig)) {
  const PlacedMesh placed{&way.mesh, way.rig.pose};
  scene_ = place({&placed, 1}, Progress(1));
}

std::optional<Point3> ExactCenter::point(double x, double y) const {
  const PlanePoint pixel = map_.photograph(way_.rig.grid.center(), x, y);
  const PlanePoint ray = ray_of_pixel(way_.rig.camera, pixel);
  const auto& r = exposure_.rotation;
  const double z = r[6] * ray.x + r[7] * ray.y + r[8];
  const double dx = (r[0] * ray.x + r[1] * ray.y + r[2]) / z;
  const double dy = (r[3] * ray.x + r[4] * ray.y + r[5]) / z;
  const auto depth = exact_depth(scene_, exposure_.x, exposure_.y, dx, dy);
  if (!depth) return {};
  return Point3{exposure_.x + dx * *depth, exposure_.y + dy * *depth, *depth};
}

double ExactCenter::disparity(const Point3& point) const {
  double x[2];
  for (int side = 0; side < 2; ++side) {
    Exposure moved = exposure_;
    moved.x += (side == 0 ? -1 : 1) * way_.rig.step;
    const auto& r = moved.rotation;
    const double from_x = point.x - moved.x;
    const double from_y = point.y - moved.y;
    const double z = r[2] * from_x + r[5] * from_y + r[8] * point.z;
    const PlanePoint ray{(r[0] * from_x + r[3] * from_y + r[6] * point.z) / z,
                         (r[1] * from_x + r[4] * from_y + r[7] * point.z) / z};
    x[side] = map_.rectified(way_.rig.grid.center(), pixel_of_ray(way_.rig.camera, ray)).x;
  }
  return (x[0] - x[1]) / 2 - way_.cameras.camera.shift;
}

CaptureErrors capture_errors(const CaptureWay& way, int samples) {
  CaptureErrors errors;
  errors.rows_before = way.rectified.before;
  errors.rows_after = way.rectified.after;
  const double own = center_exposure(way.rig).gain;
  for (std::size_t i = 0; i < way.rectified.gains.size(); ++i) {
    errors.gain =
        std::max(errors.gain, std::abs(way.rectified.gains[i] - way.rig.exposures[i].gain / own));
  }
  errors.tz = std::abs(way.pose.pose.translation[2] - way.rig.pose.translation[2]);
  errors.delta_tz = way.pose.delta_tz;
  const ExactCenter exact(way);
  const std::vector<double> off = disparity_errors(way, exact, samples);
  errors.disparity_median = off[off.size() / 2];
  errors.disparity_99 = off[off.size() * 99 / 100];
  count_jumps(way, exact, errors);
  return errors;
}

}  // namespace episcope::accuracy
