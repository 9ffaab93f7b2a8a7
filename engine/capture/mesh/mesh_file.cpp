// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh/mesh_file.h"

#include "engine/capture/mesh/ply_header.h"
#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/durable/atomic_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

namespace episcope::capture {
namespace {

/// Ends the reading on a stop request.
class StopHandler : public Assimp::ProgressHandler {
 public:
  explicit StopHandler(const Progress& progress) : progress_(progress) {}
  bool Update(float) override { return !progress_.stop_requested(); }

 private:
  Progress progress_;
};

/// Opens nothing but the mesh: files that it names, its materials, may be anywhere.
class MeshAlone : public Assimp::DefaultIOSystem {
 public:
  explicit MeshAlone(std::string file) : file_(std::move(file)) {}
  bool Exists(const char* file) const override {
    return file == file_ && DefaultIOSystem::Exists(file);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return file == file_ ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string file_;
};

void require_readable(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw IoError(path, "there is no such file; name the mesh, as PLY, OBJ or STL");
  }
  const std::string suffix = suffix_of(path);
  if (suffix != ".ply" && suffix != ".obj" && suffix != ".stl") {
    throw IoError(path, "meshes are read as .ply, .obj or .stl; convert this one");
  }
}

void append_vertices(const std::filesystem::path& path, const aiMesh& part, TriangleMesh& mesh) {
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw IoError(path, "vertex " + std::to_string(mesh.vertices.size()) +
                              " has a coordinate that is no number; repair the mesh");
    }
    mesh.vertices.push_back({p.x, p.y, p.z});
  }
}

void require_valid(const std::filesystem::path& path, const aiFace& face, std::size_t number,
                   unsigned vertices) {
  for (unsigned k = 0; k < face.mNumIndices; ++k) {
    if (face.mIndices[k] < vertices) continue;
    throw IoError(path, "face " + std::to_string(number) + " refers to vertex " +
                            std::to_string(face.mIndices[k]) + " of " + std::to_string(vertices) +
                            "; repair the mesh");
  }
}

// Points and lines are left out; polygons that were not cut into triangles become fans.
void append_faces(const aiMesh& part, std::uint32_t first, TriangleMesh& mesh) {
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    for (unsigned k = 2; k < face.mNumIndices; ++k) {
      mesh.faces.push_back(
          {first + face.mIndices[0], first + face.mIndices[k - 1], first + face.mIndices[k]});
    }
  }
}

// assimp's triangulation stops the program at faces that are none, so it sees whole polygons alone.
bool needs_triangulation(const std::filesystem::path& path, const aiScene& scene) {
  bool has_polygon = false, has_less = false;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      require_valid(path, part.mFaces[i], i, part.mNumVertices);
      has_polygon |= part.mFaces[i].mNumIndices > 3;
      has_less |= part.mFaces[i].mNumIndices < 3;
    }
  }
  return has_polygon && !has_less;
}

TriangleMesh mesh_of(const std::filesystem::path& path, const aiScene& scene,
                     const Progress& progress) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    vertices += scene.mMeshes[i]->mNumVertices;
    faces += scene.mMeshes[i]->mNumFaces;
  }
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / 4;
  if (vertices > most || faces > most) {
    throw IoError(
        path, "this mesh has more than " + std::to_string(most) + " vertices or faces; reduce it");
  }
  TriangleMesh mesh;
  mesh.vertices.reserve(vertices);
  mesh.faces.reserve(faces);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    progress.check();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    append_vertices(path, *scene.mMeshes[i], mesh);
    append_faces(*scene.mMeshes[i], first, mesh);
  }
  return mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, const Progress& progress) {
  require_readable(path);
  progress.step("reading " + path.filename().string());
  progress.check();
  if (suffix_of(path) == ".ply") require_whole_ply(path);
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshAlone(path.string()));     // owned by the importer
  importer.SetProgressHandler(new StopHandler(progress));  // likewise
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(path.string(), 0);
    if (scene != nullptr && needs_triangulation(path, *scene)) {
      scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    }
  } catch (const std::bad_alloc&) {
    throw IoError(path, "not enough memory for this mesh; reduce it");
  }
  progress.check();
  if (scene == nullptr) {
    throw IoError(path, std::string("this mesh cannot be read (") + importer.GetErrorString() +
                            "); export it again");
  }
  TriangleMesh mesh = mesh_of(path, *scene, progress);
  if (mesh.faces.empty()) {
    throw IoError(path, "this mesh has no faces, only " + std::to_string(mesh.vertices.size()) +
                            " points; reconstruct its surface first");
  }
  progress.report(1);
  return mesh;
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " +
      std::to_string(mesh.vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  constexpr std::size_t face_bytes = 1 + sizeof(Face);
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  const std::size_t vertex_bytes = mesh.vertices.size() * sizeof(Vertex);
  bytes.resize(header.size() + vertex_bytes + mesh.faces.size() * face_bytes);
  std::memcpy(bytes.data() + header.size(), mesh.vertices.data(), vertex_bytes);
  std::uint8_t* at = bytes.data() + header.size() + vertex_bytes;
  for (const Face& face : mesh.faces) {
    *at = 3;
    std::memcpy(at + 1, face.data(), sizeof(Face));
    at += face_bytes;
  }
  io::write_atomically(path, bytes);
}

}  // namespace episcope::capture
