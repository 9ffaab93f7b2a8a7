// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pixel_surface.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::capture {
namespace {

/// Visible areas below this share of a pixel are rounding.
constexpr double kNoArea = 1e-10;
/// Sums of areas of fragments, which are floats, differ from 1 by less.
constexpr float kAreaRounding = 2e-5F;

struct Box {
  Corner low;
  Corner high;
};

Box box_of(const Polygon& polygon) {
  Box box{polygon.corners[0], polygon.corners[0]};
  for (int i = 1; i < polygon.count; ++i) {
    const Corner& c = polygon.corners[i];
    box.low = {std::min(box.low.x, c.x), std::min(box.low.y, c.y)};
    box.high = {std::max(box.high.x, c.x), std::max(box.high.y, c.y)};
  }
  return box;
}

/// A triangle in the pixel, with its range of 1/Z there.
struct Part {
  Polygon polygon;
  Box box{};
  double near = 0;
  double far = 0;
};

Part part_of(const ScreenTriangle& triangle) {
  Part part;
  part.polygon = clipped_to_pixel(triangle.polygon);
  if (part.polygon.count == 0) return part;
  if (twice_area(part.polygon) < 0) {
    std::reverse(part.polygon.corners.begin(), part.polygon.corners.begin() + part.polygon.count);
  }
  part.box = box_of(part.polygon);
  part.near = part.far = triangle.plane.at(part.polygon.corners[0]);
  for (int i = 1; i < part.polygon.count; ++i) {
    const double w = triangle.plane.at(part.polygon.corners[i]);
    part.near = std::max(part.near, w);
    part.far = std::min(part.far, w);
  }
  return part;
}

/// The bounds of all parts, bound by bound, so that what may hide a part is found quickly.
class Bounds {
 public:
  explicit Bounds(const std::vector<Part>& parts) {
    for (const Part& part : parts) {
      // Parts that are empty are nowhere.
      const bool is_there = part.polygon.count > 0;
      near_.push_back(is_there ? part.near : -1);
      left_.push_back(part.box.low.x);
      right_.push_back(part.box.high.x);
      top_.push_back(part.box.low.y);
      bottom_.push_back(part.box.high.y);
    }
    may_hide_.resize(parts.size());
  }

  /// Indices of the parts that may lie in front of this one, in their order.
  const std::vector<int>& before(const Part& part) {
    const std::size_t count = near_.size();
    for (std::size_t j = 0; j < count; ++j) {
      // Numbers, so that nothing is skipped: compilers make vectors of it.
      const int is_near = near_[j] >= part.far;
      const int is_left = left_[j] < part.box.high.x;
      const int is_right = right_[j] > part.box.low.x;
      const int is_above = top_[j] < part.box.high.y;
      const int is_below = bottom_[j] > part.box.low.y;
      may_hide_[j] = static_cast<char>(is_near & is_left & is_right & is_above & is_below);
    }
    indices_.clear();
    for (std::size_t j = 0; j < count; ++j) {
      if (may_hide_[j] != 0) indices_.push_back(static_cast<int>(j));
    }
    return indices_;
  }

 private:
  std::vector<double> near_;
  std::vector<double> left_;
  std::vector<double> right_;
  std::vector<double> top_;
  std::vector<double> bottom_;
  std::vector<char> may_hide_;
  std::vector<int> indices_;
};

/// Where `other` lies in front of a triangle with `plane`; `is_earlier` decides for equal depth.
Polygon region_before(const Part& other, const InversePlane& of_other, const InversePlane& plane,
                      bool is_earlier) {
  const HalfPlane nearer{of_other.by_x - plane.by_x, of_other.by_y - plane.by_y,
                         of_other.at_zero - plane.at_zero};
  const double reach = std::abs(nearer.a) + std::abs(nearer.b) + std::abs(nearer.c);
  if (reach <= 1e-13 * std::abs(plane.at_zero)) return is_earlier ? other.polygon : Polygon{};
  return clipped(other.polygon, nearer);
}

VisiblePart sum_of(const std::vector<Polygon>& pieces, int index) {
  VisiblePart part{index, 0, {0, 0}};
  for (const Polygon& piece : pieces) {
    const double area = std::abs(twice_area(piece)) / 2;
    const Corner middle = centroid(piece);
    part.area += area;
    part.centroid.x += area * middle.x;
    part.centroid.y += area * middle.y;
  }
  if (part.area > 0) part.centroid = {part.centroid.x / part.area, part.centroid.y / part.area};
  return part;
}

// Whether an edge of `a` keeps `b` outside, up to rounding; then they do not overlap.
// Precondition: the area of `a` is not negative.
bool edge_parts(const Polygon& a, const Polygon& b) {
  Corner p = a.corners[a.count - 1];
  for (int i = 0; i < a.count; ++i) {
    const Corner& q = a.corners[i];
    const double nx = p.y - q.y;
    const double ny = q.x - p.x;
    const double rounding = 1e-12 * (std::abs(nx) + std::abs(ny));
    bool is_outside = true;
    for (int k = 0; k < b.count && is_outside; ++k) {
      is_outside = nx * (b.corners[k].x - p.x) + ny * (b.corners[k].y - p.y) <= rounding;
    }
    if (is_outside) return true;
    p = q;
  }
  return false;
}

/// Areas below this share of a pixel are rounding, of edges that two polygons have in common.
constexpr double kNoOverlap = 1e-11;

constexpr int kSnapRounds = 20;
constexpr double kSettled_px = 1e-3;
constexpr double kLeastGradient = 3;   // RMS in the window, 1/255 per px
constexpr double kLeastBalance = 0.1;  // Smaller over larger eigenvalue.

/// Lines through the pixels of a window, weighted, and the point that is nearest to all.
struct Lines {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double constant = 0;
  double weight = 0;

  /// The line through `at` with this normal, of any length.
  void add(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double w) {
    const double offset = normal.dot(at);
    matrix += w * normal * normal.transpose();
    right += w * offset * normal;
    constant += w * offset * offset;
    weight += w;
  }

  [[nodiscard]] bool is_determined() const {
    const double mean = matrix.trace() / 2;  // Of both eigenvalues.
    const double apart = std::hypot((matrix(0, 0) - matrix(1, 1)) / 2, matrix(0, 1));
    return matrix.trace() > kLeastGradient * kLeastGradient * weight &&
           mean - apart > kLeastBalance * (mean + apart);
  }
  [[nodiscard]] Eigen::Vector2d nearest() const { return matrix.inverse() * right; }
  /// Sum of squares of what lines miss their nearest point by.
  [[nodiscard]] double misses() const { return constant - right.dot(nearest()); }
};

/// Lines along the edges (corner) or along the gradients (blob) around a point.
Lines lines_around(ImageView<const float> gray, const Eigen::Vector2d& center, double reach,
                   MarkKind kind) {
  Lines lines;
  const double sigma = reach / 2;
  const int top = std::max(1, static_cast<int>(std::ceil(center.y() - 2 * reach)));
  const int bottom =
      std::min(gray.height - 2, static_cast<int>(std::floor(center.y() + 2 * reach)));
  const int left = std::max(1, static_cast<int>(std::ceil(center.x() - 2 * reach)));
  const int right = std::min(gray.width - 2, static_cast<int>(std::floor(center.x() + 2 * reach)));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Eigen::Vector2d at(x, y);
      const double w = std::exp(-(at - center).squaredNorm() / (2 * sigma * sigma));
      const double gx = 0.5 * (gray.at(y, x + 1) - gray.at(y, x - 1));
      const double gy = 0.5 * (gray.at(y + 1, x) - gray.at(y - 1, x));
      // Relative to the center, where sums of squares lose no digits.
      lines.add(at - center,
                kind == MarkKind::Corner ? Eigen::Vector2d(gx, gy) : Eigen::Vector2d(-gy, gx), w);
    }
  }
  return lines;
}

struct Found {
  Eigen::Vector2d place;
  double misses = std::numeric_limits<double>::infinity();
};

std::optional<Found> find(ImageView<const float> gray, const Eigen::Vector2d& pick, double reach,
                          MarkKind kind) {
  Eigen::Vector2d place = pick;
  for (int round = 0; round < kSnapRounds; ++round) {
    const Lines lines = lines_around(gray, place, reach, kind);
    if (!lines.is_determined()) return {};
    const Eigen::Vector2d move = lines.nearest();
    place += move;
    if ((place - pick).norm() > reach) return {};
    if (move.norm() < kSettled_px) return Found{place, lines.misses() / lines.matrix.trace()};
  }
  return {};
}

}  // namespace

std::vector<VisiblePart> visible_parts(std::span<const ScreenTriangle> triangles) {
  std::vector<Part> parts;
  parts.reserve(triangles.size());
  for (const ScreenTriangle& triangle : triangles) parts.push_back(part_of(triangle));
  Bounds bounds(parts);
  std::vector<VisiblePart> visible;
  std::vector<Polygon> pieces;
  std::vector<Polygon> next;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    if (parts[i].polygon.count == 0) continue;
    pieces.assign(1, parts[i].polygon);
    for (const int j : bounds.before(parts[i])) {
      if (j == i || edge_parts(parts[i].polygon, parts[j].polygon)) continue;
      if (edge_parts(parts[j].polygon, parts[i].polygon)) continue;
      const Polygon hole = region_before(parts[j], triangles[j].plane, triangles[i].plane, j < i);
      if (hole.count == 0 || std::abs(twice_area(hole)) <= kNoArea) continue;
      next.clear();
      for (const Polygon& piece : pieces) subtract(piece, hole, next);
      pieces.swap(next);
      if (pieces.empty()) break;
    }
    const VisiblePart part = sum_of(pieces, i);
    if (part.area > kNoArea) visible.push_back(part);
  }
  return visible;
}

std::size_t PixelResolver::order(std::span<Fragment> fragments) {
  std::ranges::sort(fragments, [](const Fragment& a, const Fragment& b) {
    return a.near != b.near ? a.near > b.near : a.triangle < b.triangle;
  });
  float sum = 0;
  float far = 2e38F;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    sum += fragments[i].area;
    far = std::min(far, fragments[i].far);
    if (sum > 1 + kAreaRounding) return 0;
    if (sum < 1 - kAreaRounding) continue;
    // Slivers of the same surface may follow.
    if (i + 1 == fragments.size() || fragments[i + 1].near < far) return i + 1;
  }
  return 0;
}

bool PixelResolver::spreads(std::span<const Fragment> fragments) const {
  float near = 0;
  float far = 2e38F;
  for (const Fragment& f : fragments) {
    near = std::max(near, f.near);
    far = std::min(far, f.far);
  }
  return near - far >= jump_;
}

PixelSurface PixelResolver::exact(std::span<const Fragment> fragments) const {
  const std::vector<VisiblePart> parts = visible_parts(triangles_);
  PixelSurface surface;
  if (parts.empty()) return surface;
  const VisiblePart* best = parts.data();
  double covered = 0;
  for (const VisiblePart& part : parts) {
    covered += part.area;
    const bool is_first = fragments[part.index].triangle < fragments[best->index].triangle;
    if (part.area > best->area || (part.area == best->area && is_first)) best = &part;
  }
  const ScreenTriangle& winner = triangles_[best->index];
  surface.triangle = fragments[best->index].triangle;
  surface.covered = static_cast<float>(covered);
  surface.is_front = winner.is_front;
  surface.plane = winner.plane;
  for (const VisiblePart& part : parts) {
    const double own = triangles_[part.index].plane.at(part.centroid);
    if (std::abs(own - winner.plane.at(part.centroid)) >= jump_) surface.is_edge = true;
    if (triangles_[part.index].is_front != winner.is_front) surface.is_edge = true;
  }
  return surface;
}

double twice_area(const Polygon& polygon) {
  double sum = 0;
  const Corner& o = polygon.corners[0];
  for (int i = 2; i < polygon.count; ++i) {
    const Corner& p = polygon.corners[i - 1];
    const Corner& q = polygon.corners[i];
    sum += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  }
  return sum;
}

Corner centroid(const Polygon& polygon) {
  double weight = 0;
  Corner sum{0, 0};
  const Corner& o = polygon.corners[0];
  for (int i = 2; i < polygon.count; ++i) {
    const Corner& p = polygon.corners[i - 1];
    const Corner& q = polygon.corners[i];
    const double area = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    weight += area;
    sum.x += area * (o.x + p.x + q.x);
    sum.y += area * (o.y + p.y + q.y);
  }
  if (weight == 0) return o;
  return {sum.x / (3 * weight), sum.y / (3 * weight)};
}

Polygon clipped(const Polygon& polygon, const HalfPlane& half) {
  Polygon part;
  if (polygon.count == 0) return part;
  Corner from = polygon.corners[polygon.count - 1];
  double from_side = half.at(from);
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& to = polygon.corners[i];
    const double to_side = half.at(to);
    if ((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)) {
      const double t = from_side / (from_side - to_side);
      part.add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
    if (to_side >= 0) part.add(to);
    from = to;
    from_side = to_side;
  }
  if (part.count < 3) part.count = 0;
  return part;
}

Polygon clipped_to_pixel(const Polygon& polygon) {
  Polygon part = clipped(polygon, {1, 0, 0.5});
  part = clipped(part, {-1, 0, 0.5});
  part = clipped(part, {0, 1, 0.5});
  return clipped(part, {0, -1, 0.5});
}

void subtract(const Polygon& polygon, const Polygon& hole, std::vector<Polygon>& pieces) {
  const double turn = twice_area(hole) >= 0 ? 1 : -1;
  Polygon rest = polygon;
  const std::size_t before = pieces.size();
  for (int i = 0; i < hole.count; ++i) {
    const Corner& p = hole.corners[i];
    const Corner& q = hole.corners[(i + 1) % hole.count];
    const double a = turn * (p.y - q.y);
    const double b = turn * (q.x - p.x);
    const HalfPlane inside{a, b, -a * p.x - b * p.y};
    const Polygon outside = clipped(rest, {-inside.a, -inside.b, -inside.c});
    if (std::abs(twice_area(outside)) > kNoOverlap) pieces.push_back(outside);
    rest = clipped(rest, inside);
    if (rest.count == 0) break;
  }
  if (rest.count == 0 || std::abs(twice_area(rest)) <= kNoOverlap) {  // they do not overlap
    pieces.resize(before);
    pieces.push_back(polygon);
  }
}

std::optional<SnappedPick> snap_pick(ImageView<const float> gray, const PlanePoint& pick,
                                     double reach_px) {
  std::optional<SnappedPick> best;
  double misses = std::numeric_limits<double>::infinity();
  for (const MarkKind kind : {MarkKind::Corner, MarkKind::Blob}) {
    const auto found = find(gray, {pick.x, pick.y}, reach_px, kind);
    if (!found || found->misses >= misses) continue;
    misses = found->misses;
    best = SnappedPick{{found->place.x(), found->place.y()}, kind};
  }
  return best;
}

}  // namespace episcope::capture
