// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh_file.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>

namespace episcope::capture {
namespace {

constexpr int kMostTries = 12;
constexpr double kFacesOfCube = 2.5;  // that a cube on a smooth surface leaves

double area_of(const TriangleMesh& mesh) {
  double twice = 0;
  for (const Face& face : mesh.faces) {
    double a[3];
    double b[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = static_cast<double>(mesh.vertices[face[1]][i]) - mesh.vertices[face[0]][i];
      b[i] = static_cast<double>(mesh.vertices[face[2]][i]) - mesh.vertices[face[0]][i];
    }
    const double area =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    if (std::isfinite(area)) twice += area;
  }
  return twice / 2;
}

Vertex low_corner(const TriangleMesh& mesh) {
  Vertex low;
  low.fill(std::numeric_limits<float>::infinity());
  for (const Vertex& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], vertex[i]);
  }
  return low;
}

std::uint64_t cube_of(const Vertex& vertex, const Vertex& low, double side) {
  std::uint64_t cube = 0;
  for (int i = 0; i < 3; ++i) {
    constexpr double kMost = (1 << 21) - 1;
    const double at = std::clamp((static_cast<double>(vertex[i]) - low[i]) / side, 0.0, kMost);
    cube = cube << 21 | static_cast<std::uint64_t>(at);
  }
  return cube;
}

/// Begins with the smallest index, in the same sense.
Face rotated(Face face) {
  std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  return face;
}

TriangleMesh clustered(const TriangleMesh& mesh, const Vertex& low, double side) {
  struct Cube {
    double sum[3]{};
    std::uint32_t count = 0;
  };
  std::unordered_map<std::uint64_t, std::uint32_t> index_of;
  std::vector<Cube> cubes;
  std::vector<std::uint32_t> cube_of_vertex;
  cube_of_vertex.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    const auto next = static_cast<std::uint32_t>(cubes.size());
    const auto [found, is_new] = index_of.try_emplace(cube_of(vertex, low, side), next);
    if (is_new) cubes.emplace_back();
    Cube& cube = cubes[found->second];
    for (int i = 0; i < 3; ++i) cube.sum[i] += vertex[i];
    ++cube.count;
    cube_of_vertex.push_back(found->second);
  }
  TriangleMesh coarse;
  for (const Face& face : mesh.faces) {
    const Face merged{cube_of_vertex[face[0]], cube_of_vertex[face[1]], cube_of_vertex[face[2]]};
    const bool is_flat = merged[0] == merged[1] || merged[1] == merged[2] || merged[2] == merged[0];
    if (!is_flat) coarse.faces.push_back(rotated(merged));
  }
  std::ranges::sort(coarse.faces);
  coarse.faces.erase(std::unique(coarse.faces.begin(), coarse.faces.end()), coarse.faces.end());
  for (const Cube& cube : cubes) {
    Vertex& mean = coarse.vertices.emplace_back();
    for (int i = 0; i < 3; ++i) mean[i] = static_cast<float>(cube.sum[i] / cube.count);
  }
  return coarse;
}

constexpr int kMostHeaderLines = 10'000;

// Bytes of a type of PLY; 0 = there is no such type.
int size_of(const std::string& type) {
  static const std::map<std::string, int> sizes{
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

bool is_known(const std::string& word) {
  static constexpr std::array<const char*, 7> kWords{
      {"ply", "format", "comment", "obj_info", "element", "property", "end_header"}};
  return word.empty() || std::ranges::find(kWords, word) != kWords.end();
}

struct Property {
  int size = 0;        // of a value
  int count_size = 0;  // of the length of a list; 0 = it is no list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::uint64_t fixed_size = 0;  // of one without lists
  bool has_list = false;
};

enum class Format { Unknown, Ascii, LittleEndian, BigEndian };

struct Header {
  Format format = Format::Unknown;
  std::vector<Element> elements;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), file_(path, std::ios::binary), end_(std::filesystem::file_size(path)) {
    if (!file_) throw IoError(path, "this mesh cannot be opened");
  }

  void check() {
    const Header header = read_header();
    for (const Element& element : header.elements) {
      if (header.format == Format::Ascii) {
        pass_lines(element);
      } else if (!element.has_list) {
        pass(element.count * element.fixed_size);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) pass_one(element, header.format);
      }
    }
  }

 private:
  [[nodiscard]] IoError damaged(const std::string& how) const {
    return {path_, "this mesh cannot be read (" + how + "); export it again"};
  }

  Header read_header() {
    Header header;
    std::string line;
    for (int i = 0; i < kMostHeaderLines && std::getline(file_, line); ++i) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (i == 0 && word != "ply") throw damaged("it does not begin with \"ply\"");
      if (word == "format") header.format = read_format(words);
      if (word == "element") add_element(words, header);
      if (word == "property") read_property(words, header);
      if (!is_known(word)) throw damaged("its header has the line \"" + line.substr(0, 40) + "\"");
      if (word != "end_header") continue;
      if (header.format == Format::Unknown) throw damaged("its header tells no format");
      return header;
    }
    throw damaged("its header has no end");
  }

  Format read_format(std::istringstream& words) const {
    std::string name;
    words >> name;
    if (name == "ascii") return Format::Ascii;
    if (name == "binary_little_endian") return Format::LittleEndian;
    if (name == "binary_big_endian") return Format::BigEndian;
    throw damaged("its format is unknown");
  }

  // Of a second list of vertices or faces assimp writes beyond the memory that it took for the
  // first.
  void add_element(std::istringstream& words, Header& header) const {
    Element element = read_element(words);
    const auto is_of_mesh = [&](const Element& other) {
      const auto is_face = [](const std::string& name) {
        return name == "face" || name == "tristrips";
      };
      return (other.name == "vertex" && element.name == "vertex") ||
             (is_face(other.name) && is_face(element.name));
    };
    if (std::ranges::any_of(header.elements, is_of_mesh)) {
      throw damaged("it has more than one list \"" + element.name + "\"");
    }
    header.elements.push_back(std::move(element));
  }

  Element read_element(std::istringstream& words) const {
    Element element;
    std::string& name = element.name;
    std::int64_t count = -1;
    words >> name >> count;
    // Less than one bit an element cannot be: what is announced is not there.
    if (count < 0 || static_cast<std::uint64_t>(count) > 8 * end_) {
      throw damaged("it has no " + std::to_string(count) + " elements \"" + name + "\"");
    }
    element.count = static_cast<std::uint64_t>(count);
    return element;
  }

  void read_property(std::istringstream& words, Header& header) const {
    if (header.elements.empty()) throw damaged("a property belongs to no element");
    Element& element = header.elements.back();
    std::string type, count_type;
    words >> type;
    if (type == "list") {
      words >> count_type >> type;
      element.has_list = true;
    }
    const Property property{size_of(type), count_type.empty() ? 0 : size_of(count_type)};
    if (property.size == 0 || (!count_type.empty() && property.count_size == 0)) {
      throw damaged("a property has the unknown type \"" + type + "\"");
    }
    element.fixed_size += property.size;
    element.properties.push_back(property);
  }

  // One line an element, as all writers do.
  void pass_lines(const Element& element) {
    std::string line;
    for (std::uint64_t i = 0; i < element.count;) {
      if (!std::getline(file_, line)) throw damaged("it ends in the middle");
      std::istringstream words(line);
      std::string word;
      std::size_t count = 0;
      while (words >> word) ++count;
      if (count == 0) continue;
      if (count < element.properties.size()) throw damaged("a line of it is too short");
      ++i;
    }
  }

  void pass(std::uint64_t bytes) {
    const std::streamoff here = file_.tellg();
    if (here < 0 || static_cast<std::uint64_t>(here) + bytes > end_) {
      throw damaged("it ends in the middle");
    }
    file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
  }

  // An element with a list, at the place of the file.
  void pass_one(const Element& element, Format format) {
    for (const Property& property : element.properties) {
      std::uint64_t count = 1;
      if (property.count_size > 0) count = read_count(property.count_size, format);
      skip(count * property.size);
    }
  }

  std::uint64_t read_count(int size, Format format) {
    std::uint64_t count = 0;
    for (int i = 0; i < size; ++i) {
      const int byte = next();
      count |= static_cast<std::uint64_t>(byte)
               << (8 * (format == Format::BigEndian ? size - 1 - i : i));
    }
    if (count > end_) throw damaged("a list of it has an impossible length");
    return count;
  }

  int next() {
    const int byte = file_.rdbuf()->sbumpc();
    if (byte == std::char_traits<char>::eof()) throw damaged("it ends in the middle");
    return byte;
  }

  // Short ways within the buffer; a seek would empty it.
  void skip(std::uint64_t bytes) {
    if (bytes > 4096) return pass(bytes);
    for (std::uint64_t i = 0; i < bytes; ++i) (void)next();
  }

  const std::filesystem::path& path_;
  std::ifstream file_;
  std::uint64_t end_;
};

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

constexpr double kHead = 75;  // mm
constexpr Vertex kBox{105, 65, -40};
constexpr float kBoxSide = 38;  // half
constexpr float kBoxTurn = 0.45F;

/// Adds the surface place(s, t), s and t in [0, 1], of `steps` × `steps` quads; its outside is
/// where the place turns clockwise as s and t grow, in a frame with y downwards and z forwards.
template <class Place>
void add_surface(TriangleMesh& mesh, int steps, const Place& place) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto across = static_cast<std::uint32_t>(steps + 1);
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      mesh.vertices.push_back(
          place(static_cast<double>(k) / steps, static_cast<double>(i) / steps));
    }
  }
  for (std::uint32_t i = 0; i + 1 < across; ++i) {
    for (std::uint32_t k = 0; k + 1 < across; ++k) {
      const std::uint32_t a = first + i * across + k;
      mesh.faces.push_back({a, a + across, a + 1});
      mesh.faces.push_back({a + 1, a + across, a + across + 1});
    }
  }
}

Vertex vertex(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// A point of the head: a sphere with broad features and fine roughness.
Vertex head(double s, double t) {
  const double around = 2 * std::numbers::pi * (0.75 + s);
  const double down = std::numbers::pi * (0.002 + 0.996 * t);
  const double x = std::sin(down) * std::cos(around);
  const double y = -std::cos(down);
  const double z = std::sin(down) * std::sin(around);
  const Point3 direction{x, y, z};
  const double radius = kHead * (1 + 0.10 * solid_noise(direction, 0.6, 11) +
                                 0.012 * solid_noise(direction, 0.15, 12));
  return vertex(radius * x - 45, radius * y * 1.2, radius * z);
}

Vertex box_place(double x, double y, double z) {
  const double c = std::cos(kBoxTurn);
  const double s = std::sin(kBoxTurn);
  return vertex(kBox[0] + kBoxSide * (c * x + s * z), kBox[1] + kBoxSide * y,
                kBox[2] + kBoxSide * (-s * x + c * z));
}

void add_box(TriangleMesh& mesh, int steps) {
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, 2 * t - 1, -1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(1 - 2 * s, 2 * t - 1, 1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(-1, 2 * t - 1, 1 - 2 * s); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(1, 2 * t - 1, 2 * s - 1); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, -1, 1 - 2 * t); });
  add_surface(mesh, steps, [](double s, double t) { return box_place(2 * s - 1, 1, 2 * t - 1); });
}

}  // namespace

TriangleMesh cluster_vertices(const TriangleMesh& mesh, std::size_t most_faces) {
  if (mesh.faces.size() <= most_faces) return mesh;
  const double area = area_of(mesh);
  if (!(area > 0) || most_faces == 0) return {};
  const Vertex low = low_corner(mesh);
  double side = std::sqrt(kFacesOfCube * area / static_cast<double>(most_faces));
  TriangleMesh coarse = clustered(mesh, low, side);
  for (int i = 1; i < kMostTries && coarse.faces.size() > most_faces; ++i) {
    const double excess =
        static_cast<double>(coarse.faces.size()) / static_cast<double>(most_faces);
    side *= std::max(1.1, std::sqrt(excess));
    coarse = clustered(mesh, low, side);
  }
  return coarse;
}

TriangleMesh read_mesh(const std::filesystem::path& path, const Progress& progress) {
  require_readable(path);
  progress.step("reading " + path.filename().string());
  progress.check();
  if (suffix_of(path) == ".ply") Reader(path).check();
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
    throw IoError(path, kNotEnoughMemory);
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

TriangleMesh scan_mesh(int detail) {
  TriangleMesh mesh;
  add_surface(mesh, 2 * detail, head);
  add_box(mesh, detail / 2);
  add_surface(mesh, detail, [](double s, double t) {  // the wall
    return vertex(-480 + 960 * s, -420 + 560 * t, 170);
  });
  add_surface(mesh, detail, [](double s, double t) {  // the table
    return vertex(-480 + 960 * s, 60 + 200 * t, 200 - 330 * t);
  });
  return mesh;
}

TriangleMesh scan_mesh_with_hole(int detail) {
  TriangleMesh mesh = scan_mesh(detail);
  const Vertex middle = head(0.06, 0.55);
  std::erase_if(mesh.faces, [&](const Face& face) {
    double squares = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = mesh.vertices[face[0]][k] - middle[k];
      squares += off * off;
    }
    return squares < 64;
  });
  return mesh;
}

std::vector<Vertex> scan_landmarks() {
  std::vector<Vertex> marks;
  for (const double y : {-1.0, 1.0}) {
    for (const double x : {-1.0, 1.0}) marks.push_back(box_place(x, y, -1));
  }
  marks.push_back(box_place(1, -1, 1));
  for (const double x : {-230.0, -110.0, 60.0, 240.0}) {
    for (const double y : {-170.0, -110.0}) marks.push_back(vertex(x, y, 170));
  }
  for (const auto& [s, t] : {std::array{0.02, 0.35}, {0.95, 0.4}, {0.05, 0.7}, {0.9, 0.6}}) {
    marks.push_back(head(s, t));
  }
  marks.push_back(vertex(-200, 60 + 200 * 0.4, 200 - 330 * 0.4));
  marks.push_back(vertex(40, 60 + 200 * 0.45, 200 - 330 * 0.45));
  marks.push_back(vertex(230, 60 + 200 * 0.4, 200 - 330 * 0.4));
  return marks;
}

}  // namespace episcope::capture
