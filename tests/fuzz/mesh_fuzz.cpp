// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh_file.h"
#include "tests/fuzz/harness.h"

namespace episcope::fuzz {
namespace {

constexpr const char* kAscii =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
constexpr const char* kObj =
    "mtllib a.mtl\no mesh\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\n"
    "f 1/1/1 2/1/1 3/1/1\n";
constexpr const char* kStl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid a\n";

void write_seeds(const std::filesystem::path& folder) {
  capture::write_mesh(folder / "binary", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  write_bytes(folder / "ascii", kAscii);
  write_bytes(folder / "obj", kObj);
  write_bytes(folder / "stl", kStl);
  std::string binary_stl(84, '\0');
  binary_stl[80] = 1;
  write_bytes(folder / "binary_stl", binary_stl + std::string(50, '\1'));
}

/// What has lost its beginning is read as STL: for each OBJ file Assimp fills 16 MB.
std::string name_of(std::string_view bytes) {
  if (bytes.starts_with("ply")) return "mesh.ply";
  const bool is_obj = !bytes.empty() && std::string_view("mvof#").find(bytes[0]) != bytes.npos;
  return is_obj ? "mesh.obj" : "mesh.stl";
}

void read(const std::filesystem::path& file) {
  (void)capture::read_mesh(file, Progress(1));
}

}  // namespace

const Harness kHarness{name_of, read, write_seeds};

}  // namespace episcope::fuzz
