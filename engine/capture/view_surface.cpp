// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/view_surface.h"

#include "engine/capture/pixel_surface.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace episcope::capture {

namespace {

/// Whether the surface jumps between (y, x) and its neighbor to the right or, if `is_down`, below.
bool is_crack(const ViewSurface& view, int y, int x, bool is_down, float jump) {
  const int ny = is_down ? y + 1 : y;
  const int nx = is_down ? x : x + 1;
  if (ny >= view.state.height() || nx >= view.state.width()) return false;
  if (view.state.at(y, x) != ViewSurface::Seen || view.state.at(ny, nx) != ViewSurface::Seen) {
    return false;
  }
  const Image<float>& slope = is_down ? view.by_y : view.by_x;
  const float own = view.inverse_depth.at(y, x) + slope.at(y, x) / 2;
  const float other = view.inverse_depth.at(ny, nx) - slope.at(ny, nx) / 2;
  return std::abs(own - other) >= jump;
}

// Discontinuities that run between pixels: where the planes of two neighbors that are Seen differ
// by `jump` in 1/Z half way between them, both become Unsure. Slopes, however steep, do not.
// Throws Cancelled.
void mark_cracks(ViewSurface& view, double jump, const Progress& progress) {
  const int height = view.state.height();
  const int width = view.state.width();
  const auto least = static_cast<float>(jump);
  Image<std::uint8_t> cracked(height, width);
  const auto crack = [&](int y, int x, bool is_down) {
    return y >= 0 && x >= 0 && is_crack(view, y, x, is_down, least);
  };
  parallel_for(height, progress, [&](int y) {
    for (int x = 0; x < width; ++x) {
      cracked.at(y, x) = crack(y, x, false) || crack(y, x, true) || crack(y, x - 1, false) ||
                         crack(y - 1, x, true);
    }
  });
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (cracked.at(y, x) != 0) view.state.at(y, x) = ViewSurface::Unsure;
    }
  }
}

}  // namespace

/// Side of a tile in px.
constexpr int kTile = 64;

/// Which triangles reach into which tile of a view, those seen from outside apart.
class TileBins {
 public:
  /// Keeps its memory from view to view. Throws Cancelled.
  void fill(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int height,
            int width, bool both_sides, const Progress& progress);

  [[nodiscard]] int tiles_across() const { return across_; }
  [[nodiscard]] int tile_count() const { return across_ * down_; }
  [[nodiscard]] int chunk_count() const { return static_cast<int>(chunks_.size()); }
  /// Triangles of the tile, in the order of the mesh, chunk after chunk.
  [[nodiscard]] std::span<const std::uint32_t> faces(int chunk, int tile, bool is_front) const;

 private:
  struct Entry {
    std::uint32_t face;
    std::uint32_t bin;
  };
  struct Chunk {
    std::vector<Entry> entries;
    std::vector<std::uint32_t> starts;  ///< Of bin after bin, and the end.
    std::vector<std::uint32_t> sorted;
  };
  void bin_face(std::uint32_t face, const std::array<ScreenVertex, 3>& v, Chunk& chunk) const;
  void sort(Chunk& chunk) const;

  std::vector<Chunk> chunks_;
  int across_ = 0;
  int down_ = 0;
  int height_ = 0;
  int width_ = 0;
  bool both_sides_ = false;
};

constexpr std::size_t kChunkFaces = 1 << 16;

void TileBins::bin_face(std::uint32_t face, const std::array<ScreenVertex, 3>& v,
                        Chunk& chunk) const {
  if (!(v[0].w > 0 && v[1].w > 0 && v[2].w > 0)) return;
  const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
  if (right < -0.5F || bottom < -0.5F || left > static_cast<float>(width_) - 0.5F ||
      top > static_cast<float>(height_) - 0.5F) {
    return;
  }
  const double turn = turn_of(v);
  if (turn == 0) return;
  const std::uint32_t side = turn < 0 || both_sides_ ? 0 : 1;
  const auto tile_of = [](float at, int most) {
    return std::clamp(static_cast<int>(std::clamp(at + 0.5F, 0.0F, 1e6F)), 0, most - 1) / kTile;
  };
  for (int ty = tile_of(top, height_); ty <= tile_of(bottom, height_); ++ty) {
    for (int tx = tile_of(left, width_); tx <= tile_of(right, width_); ++tx) {
      chunk.entries.push_back({face, static_cast<std::uint32_t>(ty * across_ + tx) * 2 + side});
    }
  }
}

void TileBins::sort(Chunk& chunk) const {
  chunk.starts.assign(static_cast<std::size_t>(tile_count()) * 2 + 1, 0);
  for (const Entry& entry : chunk.entries) ++chunk.starts[entry.bin + 1];
  for (std::size_t i = 1; i < chunk.starts.size(); ++i) chunk.starts[i] += chunk.starts[i - 1];
  chunk.sorted.resize(chunk.entries.size());
  std::vector<std::uint32_t> next(chunk.starts.begin(), chunk.starts.end() - 1);
  for (const Entry& entry : chunk.entries) chunk.sorted[next[entry.bin]++] = entry.face;
  chunk.entries.clear();
}

void TileBins::fill(std::span<const Face> faces, std::span<const ScreenVertex> vertices, int height,
                    int width, bool both_sides, const Progress& progress) {
  height_ = height;
  width_ = width;
  both_sides_ = both_sides;
  across_ = (width + kTile - 1) / kTile;
  down_ = (height + kTile - 1) / kTile;
  chunks_.resize((faces.size() + kChunkFaces - 1) / kChunkFaces);
  parallel_for(chunk_count(), progress, [&](int index) {
    Chunk& chunk = chunks_[index];
    chunk.entries.clear();
    const std::size_t first = index * kChunkFaces;
    const std::size_t end = std::min(first + kChunkFaces, faces.size());
    for (std::size_t i = first; i < end; ++i) {
      const Face& f = faces[i];
      bin_face(static_cast<std::uint32_t>(i), {vertices[f[0]], vertices[f[1]], vertices[f[2]]},
               chunk);
    }
    sort(chunk);
    // Entries of all chunks at once would take twice the memory of the mesh.
    std::vector<Entry>().swap(chunk.entries);
  });
}

std::span<const std::uint32_t> TileBins::faces(int chunk, int tile, bool is_front) const {
  const Chunk& of = chunks_[chunk];
  const std::size_t bin = static_cast<std::size_t>(tile) * 2 + (is_front ? 0 : 1);
  return {of.sorted.data() + of.starts[bin], of.starts[bin + 1] - of.starts[bin]};
}

namespace {

/// What all tiles of a view share.
struct RasterInput {
  std::span<const Face> faces;
  std::span<const ScreenVertex> vertices;
  const TileBins* bins = nullptr;
  int height = 0;
  int width = 0;
  double jump = 0;
  bool both_sides = false;

  [[nodiscard]] std::array<ScreenVertex, 3> corners(std::uint32_t face) const {
    const Face& f = faces[face];
    return {vertices[f[0]], vertices[f[1]], vertices[f[2]]};
  }
};

/// Resolves the pixels of one tile after another.
class TileRaster {
 public:
  explicit TileRaster(const RasterInput& input);

  /// Calls `put(y, x, surface)` for every pixel of the tile that triangles reach.
  template <class Put>
  void run(int tile, const Put& put) {
    gather(tile);
    sort();
    for (int p = 0; p < kTile * kTile; ++p) {
      if (starts_[p] == starts_[p + 1]) continue;
      const int y = top_ + p / kTile;
      const int x = left_ + p % kTile;
      put(y, x,
          resolver_.resolve({sorted_.data() + starts_[p], starts_[p + 1] - starts_[p]},
                            [&](std::uint32_t id) { return triangle(id, x, y); }));
    }
  }

 private:
  [[nodiscard]] ScreenTriangle triangle(std::uint32_t face, int x, int y) const;
  void gather(int tile);
  void add_face(std::uint32_t face, bool is_front);
  void add_fragment(Fragment fragment);
  [[nodiscard]] bool is_hidden(int pixel, float near) const {
    return cover_[pixel] >= kWhole && near < far_[pixel];
  }
  void sort();

  static constexpr float kWhole = 1 - 1e-4F;

  const RasterInput& input_;
  PixelResolver resolver_;
  int left_ = 0;  ///< Of the tile,
  int top_ = 0;
  int right_ = 0;  ///< and its last pixels.
  int bottom_ = 0;
  std::vector<Fragment> fragments_;
  std::vector<Fragment> sorted_;
  std::vector<std::uint32_t> starts_;
  std::vector<float> cover_;  ///< Sum of the areas of triangles seen from outside,
  std::vector<float> far_;    ///< and their smallest 1/Z.
};

constexpr int kPixels = kTile * kTile;

int pixel_of(float at) {
  return static_cast<int>(std::floor(std::clamp(at, -1e6F, 1e6F) + 0.5F));
}

/// The edges of a triangle: positive inside, and how much they change within a pixel.
struct Edges {
  HalfPlane edge[3];
  double margin[3];

  explicit Edges(const Polygon& polygon) {
    const double turn = twice_area(polygon) > 0 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
      const Corner& p = polygon.corners[i];
      const Corner& q = polygon.corners[(i + 1) % 3];
      const double a = turn * (p.y - q.y);
      const double b = turn * (q.x - p.x);
      edge[i] = {a, b, -a * p.x - b * p.y};
      margin[i] = (std::abs(a) + std::abs(b)) / 2;
    }
  }
  enum class Pixel { Outside, Crossed, Inside };
  [[nodiscard]] Pixel pixel(const Corner& center) const {
    bool is_inside = true;
    for (int i = 0; i < 3; ++i) {
      const double at = edge[i].at(center);
      if (at <= -margin[i]) return Pixel::Outside;
      is_inside = is_inside && at >= margin[i];
    }
    return is_inside ? Pixel::Inside : Pixel::Crossed;
  }
};

void set_range(const Polygon& polygon, const InversePlane& plane, Fragment& fragment) {
  fragment.near = 0;
  fragment.far = 2e38F;
  for (int i = 0; i < polygon.count; ++i) {
    const auto w = static_cast<float>(plane.at(polygon.corners[i]));
    fragment.near = std::max(fragment.near, w);
    fragment.far = std::min(fragment.far, w);
  }
}

/// The triangle within a pixel at `center`, both relative to the same origin.
void cut_to_pixel(const ScreenTriangle& triangle, const Corner& center, Fragment& fragment) {
  Polygon polygon = triangle.polygon;
  for (int i = 0; i < polygon.count; ++i) {
    polygon.corners[i].x -= center.x;
    polygon.corners[i].y -= center.y;
  }
  polygon = clipped_to_pixel(polygon);
  fragment.area = static_cast<float>(std::abs(twice_area(polygon)) / 2);
  InversePlane plane = triangle.plane;
  plane.at_zero = plane.at(center);
  set_range(polygon, plane, fragment);
}

void fill_pixel(const InversePlane& plane, const Corner& center, Fragment& fragment) {
  const double reach = (std::abs(plane.by_x) + std::abs(plane.by_y)) / 2;
  const double middle = plane.at(center);
  fragment.area = 1;
  fragment.near = static_cast<float>(middle + reach);
  fragment.far = static_cast<float>(middle - reach);
}

TileRaster::TileRaster(const RasterInput& input)
    : input_(input), resolver_(input.jump), starts_(kPixels + 1), cover_(kPixels), far_(kPixels) {}

ScreenTriangle TileRaster::triangle(std::uint32_t face, int x, int y) const {
  ScreenTriangle triangle = around_pixel(input_.corners(face), x, y);
  triangle.is_front = triangle.is_front || input_.both_sides;
  return triangle;
}

void TileRaster::gather(int tile) {
  const TileBins& bins = *input_.bins;
  left_ = tile % bins.tiles_across() * kTile;
  top_ = tile / bins.tiles_across() * kTile;
  right_ = std::min(left_ + kTile, input_.width) - 1;
  bottom_ = std::min(top_ + kTile, input_.height) - 1;
  fragments_.clear();
  std::ranges::fill(cover_, 0.0F);
  std::ranges::fill(far_, 2e38F);
  for (const bool is_front : {true, false}) {
    for (int chunk = 0; chunk < bins.chunk_count(); ++chunk) {
      for (const std::uint32_t face : bins.faces(chunk, tile, is_front)) add_face(face, is_front);
    }
  }
}

void TileRaster::add_fragment(Fragment fragment) {
  if (!(fragment.area > 0)) return;
  if (fragment.is_front) {
    cover_[fragment.pixel] += fragment.area;
    far_[fragment.pixel] = std::min(far_[fragment.pixel], fragment.far);
  }
  fragments_.push_back(fragment);
}

void TileRaster::add_face(std::uint32_t face, bool is_front) {
  const std::array<ScreenVertex, 3> v = input_.corners(face);
  const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
  const auto [far, near] = std::minmax({v[0].w, v[1].w, v[2].w});
  const int x0 = pixel_of(low_x);
  const int x1 = pixel_of(high_x);
  const int y0 = pixel_of(low_y);
  const int y1 = pixel_of(high_y);
  const auto local = [&](int y, int x) { return (y - top_) * kTile + x - left_; };
  Fragment fragment{face, 0, near, far, 0, is_front};
  if (x0 == x1 && y0 == y1) {
    if (x0 < left_ || x0 > right_ || y0 < top_ || y0 > bottom_) return;
    fragment.pixel = static_cast<std::uint16_t>(local(y0, x0));
    if (!is_front && is_hidden(fragment.pixel, near)) return;
    fragment.area = static_cast<float>(std::abs(turn_of(v)) / 2);
    return add_fragment(fragment);
  }
  const ScreenTriangle whole = around_pixel(v, x0, y0);
  const Edges edges(whole.polygon);
  for (int y = std::max(y0, top_); y <= std::min(y1, bottom_); ++y) {
    for (int x = std::max(x0, left_); x <= std::min(x1, right_); ++x) {
      fragment.pixel = static_cast<std::uint16_t>(local(y, x));
      if (!is_front && is_hidden(fragment.pixel, near)) continue;
      const Corner center{static_cast<double>(x - x0), static_cast<double>(y - y0)};
      const Edges::Pixel pixel = edges.pixel(center);
      if (pixel == Edges::Pixel::Outside) continue;
      if (pixel == Edges::Pixel::Inside) {
        fill_pixel(whole.plane, center, fragment);
      } else {
        cut_to_pixel(whole, center, fragment);
      }
      add_fragment(fragment);
    }
  }
}

void TileRaster::sort() {
  std::ranges::fill(starts_, 0U);
  for (const Fragment& f : fragments_) ++starts_[f.pixel + 1];
  for (int p = 0; p < kPixels; ++p) starts_[p + 1] += starts_[p];
  sorted_.resize(fragments_.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Fragment& f : fragments_) sorted_[next[f.pixel]++] = f;
}

constexpr std::size_t kChunk = 1 << 16;

int chunks_of(std::size_t count) {
  return static_cast<int>((count + kChunk - 1) / kChunk);
}

template <class Body>
void for_each_chunked(std::size_t count, const Progress& progress, const Body& body) {
  parallel_for(chunks_of(count), progress, [&](int chunk) {
    const std::size_t first = chunk * kChunk;
    for (std::size_t i = first; i < std::min(first + kChunk, count); ++i) body(i);
  });
}

ScreenVertex project(const Vertex& vertex, const ViewCamera& camera) {
  const double z = vertex[2];
  if (!(z > 0)) return {};
  const double w = 1 / z;
  const Pinhole& pinhole = camera.pinhole;
  const double x = pinhole.focal_px * (vertex[0] - camera.x) * w + pinhole.center_x;
  const double y = pinhole.focal_px * (vertex[1] - camera.y) * w + pinhole.center_y;
  return {static_cast<float>(x + camera.shift_x), static_cast<float>(y + camera.shift_y),
          static_cast<float>(w)};
}

ViewSurface blank(const ViewCamera& camera) {
  const int h = camera.height;
  const int w = camera.width;
  return {Image<std::uint32_t>(h, w, 1, PixelSurface::kNone), Image<float>(h, w),
          Image<float>(h, w), Image<float>(h, w), Image<std::uint8_t>(h, w)};
}

void put(int y, int x, const PixelSurface& surface, ViewSurface& view) {
  if (surface.triangle == PixelSurface::kNone) return;
  constexpr float whole = 1 - 1e-4F;
  const bool is_seen =
      surface.is_front && !surface.is_edge && surface.covered >= whole && surface.plane.at_zero > 0;
  view.triangle.at(y, x) = surface.triangle;
  view.inverse_depth.at(y, x) = static_cast<float>(surface.plane.at_zero);
  view.by_x.at(y, x) = static_cast<float>(surface.plane.by_x);
  view.by_y.at(y, x) = static_cast<float>(surface.plane.by_y);
  view.state.at(y, x) = is_seen ? ViewSurface::Seen : ViewSurface::Unsure;
}

}  // namespace

int PlacedScene::mesh_of(std::uint32_t face) const {
  return static_cast<int>(std::ranges::upper_bound(first_face, face) - first_face.begin()) - 1;
}

PlacedScene place(std::span<const PlacedMesh> meshes, const Progress& progress) {
  PlacedScene scene;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const PlacedMesh& placed : meshes) {
    vertices += placed.mesh->vertices.size();
    faces += placed.mesh->faces.size();
  }
  if (vertices >= PixelSurface::kNone || faces >= PixelSurface::kNone) {
    throw InvalidInput("the meshes have more than 4 billion vertices or faces; reduce them");
  }
  scene.vertices.resize(vertices);
  scene.faces.resize(faces);
  std::uint32_t first_vertex = 0;
  std::uint32_t first_face = 0;
  for (const auto& placed : meshes) {
    const TriangleMesh& mesh = *placed.mesh;
    scene.first_face.push_back(first_face);
    for_each_chunked(mesh.vertices.size(), progress, [&](std::size_t i) {
      const Vertex& v = mesh.vertices[i];
      const Point3 p = placed.pose.apply({v[0], v[1], v[2]});
      scene.vertices[first_vertex + i] = {static_cast<float>(p.x), static_cast<float>(p.y),
                                          static_cast<float>(p.z)};
    });
    for_each_chunked(mesh.faces.size(), progress, [&](std::size_t i) {
      for (int k = 0; k < 3; ++k) {
        scene.faces[first_face + i][k] = first_vertex + mesh.faces[i][k];
      }
    });
    first_vertex += static_cast<std::uint32_t>(mesh.vertices.size());
    first_face += static_cast<std::uint32_t>(mesh.faces.size());
  }
  return scene;
}

struct ViewRaster::State {
  const PlacedScene& scene;
  double jump;
  bool both_sides;
  std::vector<ScreenVertex> vertices{};
  TileBins bins{};
};

ViewRaster::ViewRaster(const PlacedScene& scene, double jump, bool both_sides)
    : state_(new State{scene, jump, both_sides}) {}
ViewRaster::~ViewRaster() = default;

ViewSurface ViewRaster::view(const ViewCamera& camera, const Progress& progress) {
  State& s = *state_;
  s.vertices.resize(s.scene.vertices.size());
  for_each_chunked(s.vertices.size(), progress.part(0, 0.1),
                   [&](std::size_t i) { s.vertices[i] = project(s.scene.vertices[i], camera); });
  s.bins.fill(s.scene.faces, s.vertices, camera.height, camera.width, s.both_sides,
              progress.part(0.1, 0.3));
  ViewSurface view = blank(camera);
  const RasterInput input{s.scene.faces, s.vertices, &s.bins,     camera.height,
                          camera.width,  s.jump,     s.both_sides};
  parallel_for_workers(s.bins.tile_count(), progress.part(0.3, 0.95), [&] {
    return [&, raster = TileRaster(input)](int tile) mutable {
      raster.run(tile,
                 [&](int y, int x, const PixelSurface& surface) { put(y, x, surface, view); });
    };
  });
  mark_cracks(view, s.jump, progress.part(0.95, 1));
  return view;
}

namespace {

void write_view(const ViewSurface& surface, const PlacedScene& scene, const CameraGrid& camera,
                ViewIndex view, GroundTruth& truth) {
  const ImageView<float> disparity = truth.field.disparity.view(view);
  const ImageView<std::uint8_t> valid = truth.field.valid.view(view);
  const ImageView<std::int32_t> labels = truth.labels.view(view);
  const double scale = camera.baseline * camera.focal_length;
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      const std::uint32_t face = surface.triangle.at(y, x);
      const double w = surface.inverse_depth.at(y, x);
      const bool is_seen = surface.state.at(y, x) == ViewSurface::Seen;
      disparity.at(y, x) = is_seen ? static_cast<float>(scale * w - camera.shift) : 0.0F;
      valid.at(y, x) = is_seen ? 1 : 0;
      labels.at(y, x) = face == PixelSurface::kNone ? 0 : scene.mesh_of(face) + 1;
    }
  }
}

/// Wrong poses and wrong orientation are told from the center view.
void require_seen(const ViewSurface& surface) {
  const auto count = [&](ViewSurface::State state) {
    return std::ranges::count(surface.state, static_cast<std::uint8_t>(state));
  };
  const auto seen = count(ViewSurface::Seen);
  const auto unsure = count(ViewSurface::Unsure);
  if (seen + unsure == 0) {
    throw InvalidInput(
        "the meshes are not in the picture of the center view; check their poses, and that pose "
        "and light field are in the same unit");
  }
  if (unsure > 3 * seen) {
    throw InvalidInput(
        "the center view sees the meshes from inside (" + std::to_string(unsure) + " of " +
        std::to_string(seen + unsure) +
        " pixels): their faces are wound the wrong way; turn them, or use --both-sides");
  }
}

}  // namespace

ViewCamera view_camera(const DepthGrid& grid, ViewIndex view) {
  const ViewIndex center = grid.grid.center();
  const double u = view.u - center.u;
  const double v = view.v - center.v;
  const CameraGrid& camera = grid.camera;
  return {*camera.pinhole,  camera.baseline * u, camera.baseline * v, camera.shift * u,
          camera.shift * v, grid.height,         grid.width};
}

GroundTruth visible_depth(std::span<const PlacedMesh> meshes, const DepthGrid& grid,
                          const DepthOptions& options, const Progress& progress) {
  const CameraGrid& camera = grid.camera;
  if (!camera.pinhole || !camera.is_known()) {
    throw InvalidInput(
        "the pinhole of this light field and the step of its grid are not known; make it with "
        "episcope-cli rectify --step");
  }
  const PlacedScene scene = place(meshes, progress.part(0, 0.02));
  ViewRaster raster(scene, options.jump_px / (camera.baseline * camera.focal_length),
                    options.both_sides);
  const ViewIndex center = grid.grid.center();
  const GridShape shape = grid.grid;
  GroundTruth truth;
  truth.field.disparity = ViewStack<float>(shape, grid.height, grid.width);
  truth.field.valid = ViewStack<std::uint8_t>(shape, grid.height, grid.width);
  truth.labels = ViewStack<std::int32_t>(shape, grid.height, grid.width);
  require_seen(raster.view(view_camera(grid, center), progress.part(0.02, 0.03)));
  for (int i = 0; i < shape.count(); ++i) {
    const ViewIndex view = shape.view_at(i);
    progress.step("depth of view " + view_text(view));
    const double begin = 0.03 + 0.97 * i / shape.count();
    const ViewSurface surface =
        raster.view(view_camera(grid, view), progress.part(begin, begin + 0.97 / shape.count()));
    write_view(surface, scene, camera, view, truth);
  }
  return truth;
}

}  // namespace episcope::capture
