// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace episcope::capture {

/// A corner of triangles, in the unit and the frame of the scan.
using Vertex = std::array<float, 3>;

/// Indices of three vertices, counter-clockwise as seen from outside.
using Face = std::array<std::uint32_t, 3>;

/// A surface of triangles.
struct TriangleMesh {
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
};

}  // namespace episcope::capture
