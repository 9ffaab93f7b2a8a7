// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/ply.h"

#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>

namespace episcope::io {
namespace {

using Position = std::array<float, 3>;
using Color = std::array<std::uint8_t, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint8_t kCorners = 3;

std::string header(const PointCloud& cloud, PlyForm form) {
  const char* binary =
      std::endian::native == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  std::string text =
      "ply\nformat " + std::string(form == PlyForm::Binary ? binary : "ascii") +
      " 1.0\ncomment Episcope, x to the right, y upwards, the viewer looks along -z\n"
      "element vertex " +
      std::to_string(cloud.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!cloud.triangles.empty()) {
    text += "element face " + std::to_string(cloud.triangles.size()) +
            "\nproperty list uchar int vertex_indices\n";
  }
  return text + "end_header\n";
}

template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& out, const Position& place, const Color& color, PlyForm form) {
  if (form == PlyForm::Binary) {
    append_bytes(out, place);
    append_bytes(out, color);
    return;
  }
  char line[128];
  const int length = std::snprintf(line, sizeof line, "%.9g %.9g %.9g %d %d %d\n", place[0],
                                   place[1], place[2], color[0], color[1], color[2]);
  out.append(line, static_cast<std::size_t>(length));
}

void append(std::string& out, const Triangle& triangle, PlyForm form) {
  if (form == PlyForm::Binary) {
    append_bytes(out, kCorners);
    append_bytes(out, triangle);
    return;
  }
  char line[64];
  const int length =
      std::snprintf(line, sizeof line, "3 %u %u %u\n", triangle[0], triangle[1], triangle[2]);
  out.append(line, static_cast<std::size_t>(length));
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud, PlyForm form) {
  if (cloud.positions.empty()) {
    throw InvalidInput("no pixel of the disparity is valid, so there is no point to write");
  }
  std::string text = header(cloud, form);
  const bool is_binary = form == PlyForm::Binary;
  text.reserve(text.size() + cloud.positions.size() * (is_binary ? 15 : 48) +
               cloud.triangles.size() * (is_binary ? 13 : 24));
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    append(text, cloud.positions[i], cloud.colors[i], form);
  }
  for (const Triangle& triangle : cloud.triangles) append(text, triangle, form);
  write_atomically(path, text);
}

}  // namespace episcope::io
