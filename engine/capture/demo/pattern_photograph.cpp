// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/demo/pattern_photograph.h"

#include "engine/capture/calibrate/find_charuco.h"

#include <algorithm>
#include <cmath>

namespace episcope::capture {
namespace {

constexpr int kPixelsPerSquare = 60;
constexpr int kFine = 4;

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
  const double px = x - 0.5;  // samples are at the centres of their pixels
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
      for (int i = 0; i < kFine * kFine; ++i) {
        PlanePoint place;
        const bool hits = meets(pose, ray_of_pixel(camera, sample_of_pixel(y, x, kFine, i)), place);
        sum += hits ? sample(picture, place.x * scale, place.y * scale) : 110;
      }
      light.at(y, x) = sum / (kFine * kFine);
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
