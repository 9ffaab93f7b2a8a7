// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/ply.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace episcope::io {
namespace {

/// Focal lengths below this are in image widths, as archive files have them; above it in px.
constexpr double kLargestFocalLengthInWidths = 64;

struct Vertex {
  float place[3];
  std::uint8_t colour[3];
};

/// Puts a pixel with its disparity into space: x to the right, y downwards, z away from the viewer.
class Projection {
 public:
  Projection(const PointCloud& cloud) : camera_(cloud.camera) {
    const auto& map = cloud.disparity.disparity;
    center_x_ = 0.5 * (map.width - 1);
    center_y_ = 0.5 * (map.height - 1);
    focal_length_px_ = camera_.focal_length < kLargestFocalLengthInWidths
                           ? camera_.focal_length * map.width
                           : camera_.focal_length;
    double min = std::numeric_limits<double>::infinity();
    double max = -min;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (!cloud.disparity.is_valid(y, x)) continue;
        min = std::min<double>(min, map.at(y, x));
        max = std::max<double>(max, map.at(y, x));
      }
    }
    stretch_ = max > min ? 0.25 * map.width / (max - min) : 1;
  }

  /// z is NaN where the camera sees no point of that disparity.
  void place(int y, int x, double d, double (&out)[3]) const {
    if (!camera_.is_known()) {
      out[0] = x - center_x_;
      out[1] = y - center_y_;
      out[2] = -stretch_ * d;
      return;
    }
    const double z = camera_.depth_from_disparity(d);
    out[0] = (x - center_x_) * z / focal_length_px_;
    out[1] = (y - center_y_) * z / focal_length_px_;
    out[2] = z;
  }

 private:
  CameraGrid camera_;
  double center_x_ = 0;
  double center_y_ = 0;
  double focal_length_px_ = 1;
  double stretch_ = 1;
};

std::vector<Vertex> collect(const PointCloud& cloud) {
  const Projection projection(cloud);
  std::vector<Vertex> vertices;
  const auto& map = cloud.disparity.disparity;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!cloud.disparity.is_valid(y, x)) continue;
      double place[3];
      projection.place(y, x, map.at(y, x), place);
      if (!std::isfinite(place[2])) continue;
      Vertex vertex{{static_cast<float>(place[0]), static_cast<float>(-place[1]),
                     static_cast<float>(-place[2])},
                    {}};
      for (int c = 0; c < 3; ++c) vertex.colour[c] = cloud.rgb.at(y, x, c % cloud.rgb.channels);
      vertices.push_back(vertex);
    }
  }
  return vertices;
}

std::string header(const PointCloud& cloud, std::size_t count) {
  const char* binary =
      std::endian::native == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  return "ply\nformat " + std::string(cloud.binary ? binary : "ascii") +
         " 1.0\ncomment Episcope, x to the right, y upwards, the viewer looks along -z\n"
         "element vertex " +
         std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
}

void append(std::string& out, const Vertex& vertex, bool is_binary) {
  if (is_binary) {
    out.append(reinterpret_cast<const char*>(vertex.place), sizeof vertex.place);
    out.append(reinterpret_cast<const char*>(vertex.colour), sizeof vertex.colour);
    return;
  }
  char line[128];
  const int length = std::snprintf(line, sizeof line, "%.9g %.9g %.9g %d %d %d\n", vertex.place[0],
                                   vertex.place[1], vertex.place[2], vertex.colour[0],
                                   vertex.colour[1], vertex.colour[2]);
  out.append(line, static_cast<std::size_t>(length));
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud) {
  const auto& map = cloud.disparity.disparity;
  if (cloud.rgb.height != map.height || cloud.rgb.width != map.width ||
      (cloud.rgb.channels != 1 && cloud.rgb.channels != 3)) {
    throw InvalidInput("the colours of a point cloud must have the size of its disparity, " +
                       std::to_string(map.width) + "×" + std::to_string(map.height) +
                       " px, and 1 or 3 channels");
  }
  const std::vector<Vertex> vertices = collect(cloud);
  if (vertices.empty()) {
    throw InvalidInput("no pixel of the disparity is valid, so there is no point to write");
  }
  std::string text = header(cloud, vertices.size());
  text.reserve(text.size() + vertices.size() * (cloud.binary ? 15 : 48));
  for (const Vertex& vertex : vertices) append(text, vertex, cloud.binary);
  write_atomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace episcope::io
