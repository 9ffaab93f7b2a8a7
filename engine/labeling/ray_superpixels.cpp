// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_superpixels.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/ray_labeling.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace episcope {
namespace {

using Mean = RaySuperpixels::Mean;
constexpr std::uint16_t kNone = RaySuperpixels::kNone;

constexpr int kIterations = 8;
// Differences that weigh as much as the distance between two centers: SLIC's compactness.
constexpr float kColorScale = 0.07F;
constexpr float kDisparityScale_px = 0.12F;
constexpr int kReach = 1;             // cells around a pixel whose superpixels it may take
constexpr int kHiddenReach = 2;       // and around a ray that the center view does not show
constexpr float kBorderShare = 0.5F;  // of the tolerance: contrast of a border that is crossed

// Cells of a grid over the center view; the superpixel of each begins in it.
struct Cells {
  int height, width;
  int rows, columns;

  Cells(int view_height, int view_width) : height(view_height), width(view_width) {
    double spacing_px = RaySuperpixels::kSpacing_px;
    const auto along = [&](int length) {
      return std::max(1, static_cast<int>(std::lround(length / spacing_px)));
    };
    while (static_cast<long>(along(height)) * along(width) >= kNone) spacing_px *= 1.1;
    rows = along(height);
    columns = along(width);
  }
  [[nodiscard]] int row_of(float y) const {
    return std::clamp(static_cast<int>(y * static_cast<float>(rows) / static_cast<float>(height)),
                      0, rows - 1);
  }
  [[nodiscard]] int column_of(float x) const {
    return std::clamp(static_cast<int>(x * static_cast<float>(columns) / static_cast<float>(width)),
                      0, columns - 1);
  }
  [[nodiscard]] int count() const { return rows * columns; }
  // Weight of a squared distance.
  [[nodiscard]] float closeness() const {
    return static_cast<float>(count()) / (static_cast<float>(height) * static_cast<float>(width));
  }
};

// A ray as superpixels see it: its place is that of its point in the center view.
struct Ray {
  float y, x;
  float disparity;
  std::array<float, 3> color;
};

struct View {
  Image<float> colors;
  Image<float> disparity;  // without holes
  ImageView<const std::uint8_t> shown;

  [[nodiscard]] bool is_shown(int y, int x) const { return shown.empty() || shown.at(y, x) != 0; }
  [[nodiscard]] Ray ray(int y, int x, ViewIndex from_center) const {
    const float d = disparity.at(y, x);
    Ray ray{static_cast<float>(y) + d * static_cast<float>(from_center.v),
            static_cast<float>(x) + d * static_cast<float>(from_center.u),
            d,
            {}};
    std::copy_n(&colors.at(y, x), colors.channels(), ray.color.begin());
    return ray;
  }
};

// Invalid pixels take the disparity to the left or right that is farther away: what is unknown is
// mostly hidden.
Image<float> without_holes(const DisparityView& map) {
  const int height = map.disparity.height, width = map.disparity.width;
  constexpr float kFar = std::numeric_limits<float>::max();
  Image<float> whole(height, width);
  std::vector<float> right(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    float last = kFar;
    for (int x = width - 1; x >= 0; --x) {
      if (map.is_valid(y, x)) last = map.disparity.at(y, x);
      right[static_cast<std::size_t>(x)] = last;
    }
    last = kFar;
    for (int x = 0; x < width; ++x) {
      const bool is_valid = map.is_valid(y, x);
      if (is_valid) last = map.disparity.at(y, x);
      const float either = is_valid ? last : std::min(last, right[static_cast<std::size_t>(x)]);
      whole.at(y, x) = either == kFar ? 0 : either;
    }
  }
  return whole;
}

View read_view(const LightField& light_field, const DisparityField& disparity, ViewIndex view) {
  return {light_field.view_as_float(view), without_holes(disparity.view(view)),
          light_field.valid_of(view)};
}

float distance2(const Ray& ray, const Mean& mean, float closeness) {
  const float dy = ray.y - mean.y, dx = ray.x - mean.x;
  const float dd = (ray.disparity - mean.disparity) / kDisparityScale_px;
  float color = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    color += (ray.color[c] - mean.color[c]) * (ray.color[c] - mean.color[c]);
  }
  return (dy * dy + dx * dx) * closeness + dd * dd + color / (kColorScale * kColorScale);
}

// The superpixel most like a ray that began at most `reach` cells away from its place.
std::uint16_t most_like(const Ray& ray, const std::vector<Mean>& means, const Cells& cells,
                        int reach) {
  const int row = cells.row_of(ray.y), column = cells.column_of(ray.x);
  const float closeness = cells.closeness();
  std::uint16_t best = kNone;
  float least = std::numeric_limits<float>::max();
  for (int r = std::max(row - reach, 0); r <= std::min(row + reach, cells.rows - 1); ++r) {
    for (int c = std::max(column - reach, 0); c <= std::min(column + reach, cells.columns - 1);
         ++c) {
      const int id = r * cells.columns + c;
      const Mean& mean = means[static_cast<std::size_t>(id)];
      const float distance = mean.pixels == 0 ? least : distance2(ray, mean, closeness);
      if (distance >= least) continue;
      least = distance;
      best = static_cast<std::uint16_t>(id);
    }
  }
  return best;
}

std::vector<Mean> means_of(const View& view, ImageView<const std::uint16_t> ids, int count) {
  std::vector<Mean> means(static_cast<std::size_t>(count));
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      if (ids.at(y, x) == kNone) continue;
      Mean& sum = means[ids.at(y, x)];
      const Ray ray = view.ray(y, x, {});
      sum.y += ray.y;
      sum.x += ray.x;
      sum.disparity += ray.disparity;
      for (std::size_t c = 0; c < 3; ++c) sum.color[c] += ray.color[c];
      ++sum.pixels;
    }
  }
  for (Mean& mean : means) {
    const auto pixels = static_cast<float>(std::max(mean.pixels, 1));
    for (float* each : {&mean.y, &mean.x, &mean.disparity}) *each /= pixels;
    for (float& each : mean.color) each /= pixels;
  }
  return means;
}

// Euclidean difference of two colors of as many channels as the first.
float norm(std::span<const float> a, const float* b) {
  float squares = 0;
  for (std::size_t c = 0; c < a.size(); ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(squares);
}

template <class Visit>
void visit_neighbors(PixelIndex at, ImageView<const std::uint16_t> ids, const Visit& visit) {
  if (at.y > 0) visit(PixelIndex{at.y - 1, at.x});
  if (at.x > 0) visit(PixelIndex{at.y, at.x - 1});
  if (at.x + 1 < ids.width) visit(PixelIndex{at.y, at.x + 1});
  if (at.y + 1 < ids.height) visit(PixelIndex{at.y + 1, at.x});
}

// Gives the pixels of one superpixel that are connected to `seed` the number `part`; their count.
int number_part(ImageView<const std::uint16_t> ids, PixelIndex seed, int part,
                Image<std::int32_t>& parts) {
  std::vector<PixelIndex> open{seed};
  parts.at(seed.y, seed.x) = part;
  for (std::size_t i = 0; i < open.size(); ++i) {
    visit_neighbors(open[i], ids, [&](PixelIndex to) {
      if (ids.at(to.y, to.x) != ids.at(seed.y, seed.x) || parts.at(to.y, to.x) >= 0) return;
      parts.at(to.y, to.x) = part;
      open.push_back(to);
    });
  }
  return static_cast<int>(open.size());
}

// Marks the largest connected part of each superpixel.
Image<std::uint8_t> largest_parts(ImageView<const std::uint16_t> ids, int count) {
  struct Part {
    int number = -1, size = 0;
  };
  std::vector<Part> largest(static_cast<std::size_t>(count));
  Image<std::int32_t> parts(ids.height, ids.width, 1, -1);
  int number = 0;
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      const std::uint16_t id = ids.at(y, x);
      if (id == kNone || parts.at(y, x) >= 0) continue;
      const int size = number_part(ids, {y, x}, number, parts);
      if (size > largest[id].size) largest[id] = {number, size};
      ++number;
    }
  }
  Image<std::uint8_t> marks(ids.height, ids.width);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    marks.data()[i] = ids.data[i] != kNone && parts.data()[i] == largest[ids.data[i]].number;
  }
  return marks;
}

// Parts that are cut off join, pixel by pixel, the superpixels around them that are most like them.
void join_parts(const View& view, const Cells& cells, ImageView<std::uint16_t> ids) {
  const std::vector<Mean> means = means_of(view, ids, cells.count());
  Image<std::uint8_t> settled = largest_parts(ids, cells.count());
  std::deque<PixelIndex> open;
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      if (settled.at(y, x) == 0 && ids.at(y, x) != kNone) open.push_back({y, x});
    }
  }
  // Pixels without a settled neighbor wait; an island of content has none at all and stays.
  for (std::size_t waiting = 0; !open.empty() && waiting <= open.size();) {
    const PixelIndex at = open.front();
    open.pop_front();
    const Ray ray = view.ray(at.y, at.x, {});
    float least = std::numeric_limits<float>::max();
    visit_neighbors(at, ids, [&](PixelIndex to) {
      if (settled.at(to.y, to.x) == 0) return;
      const std::uint16_t id = ids.at(to.y, to.x);
      const float distance = distance2(ray, means[id], cells.closeness());
      if (distance >= least) return;
      least = distance;
      ids.at(at.y, at.x) = id;
    });
    const bool is_settled = least < std::numeric_limits<float>::max();
    settled.at(at.y, at.x) = is_settled ? 1 : 0;
    waiting = is_settled ? 0 : waiting + 1;
    if (!is_settled) open.push_back(at);
  }
}

// SLIC on the center view.
void divide(const View& view, const Cells& cells, const Progress& progress,
            ImageView<std::uint16_t> ids) {
  for (int y = 0; y < ids.height; ++y) {
    for (int x = 0; x < ids.width; ++x) {
      const int id = cells.row_of(static_cast<float>(y)) * cells.columns +
                     cells.column_of(static_cast<float>(x));
      ids.at(y, x) = view.is_shown(y, x) ? static_cast<std::uint16_t>(id) : kNone;
    }
  }
  for (int i = 0; i < kIterations; ++i) {
    const std::vector<Mean> means = means_of(view, ids, cells.count());
    parallel_for(ids.height, progress.part(0, 0), [&](int y) {
      for (int x = 0; x < ids.width; ++x) {
        if (view.is_shown(y, x)) ids.at(y, x) = most_like(view.ray(y, x, {}), means, cells, kReach);
      }
    });
    progress.report(static_cast<double>(i + 1) / kIterations);
  }
  join_parts(view, cells, ids);
}

void require_fitting(const LightField& light_field, const DisparityField& disparity) {
  const ViewStack<float>& maps = disparity.disparity;
  if (maps.empty() || !(maps.grid() == light_field.grid()) ||
      maps.height() != light_field.height() || maps.width() != light_field.width()) {
    throw InvalidInput(
        "superpixels of the ray space need the disparity of every view; estimate it "
        "for all views");
  }
}

// What the center view has for the points of another view; kNone where it does not show them.
void follow(const DisparityView& from, const DisparityView& to, ViewIndex from_center,
            ImageView<const std::uint16_t> center, ImageView<std::uint16_t> ids) {
  std::vector<std::int32_t> targets(static_cast<std::size_t>(ids.width));
  for (int y = 0; y < ids.height; ++y) {
    find_ray_targets(from, to, {-from_center.v, -from_center.u}, y, targets.data());
    for (int x = 0; x < ids.width; ++x) {
      const std::int32_t target = targets[static_cast<std::size_t>(x)];
      ids.at(y, x) = target < 0 ? kNone : center.data[target];
    }
  }
}

}  // namespace

RaySuperpixels::RaySuperpixels(const LightField& light_field, const DisparityField& disparity,
                               const Progress& progress)
    : ids_(light_field.grid(), light_field.height(), light_field.width()) {
  require_fitting(light_field, disparity);
  const Cells cells(light_field.height(), light_field.width());
  const GridShape grid = light_field.grid();
  const ViewIndex center = light_field.center();
  const ImageView<std::uint16_t> own = ids_.view(center);
  {
    const View view = read_view(light_field, disparity, center);
    divide(view, cells, progress.part(0, 0.3), own);
    means_ = means_of(view, own, cells.count());
    connect(view.colors, own);
  }
  parallel_for(grid.count(), progress.part(0.3, 1), [&](int i) {
    const ViewIndex at = grid.view_at(i);
    if (at == center) return;
    const ViewIndex from_center{at.v - center.v, at.u - center.u};
    const View view = read_view(light_field, disparity, at);
    const ImageView<std::uint16_t> ids = ids_.view(at);
    follow(disparity.view(at), disparity.view(center), from_center, own, ids);
    for (int y = 0; y < ids.height; ++y) {
      for (int x = 0; x < ids.width; ++x) {
        std::uint16_t& id = ids.at(y, x);
        if (!view.is_shown(y, x)) {
          id = kNone;
        } else if (id == kNone) {
          id = most_like(view.ray(y, x, from_center), means_, cells, kHiddenReach);
        }
      }
    }
  });
}

void RaySuperpixels::connect(const Image<float>& colors, ImageView<const std::uint16_t> center) {
  neighbors_.resize(means_.size());
  const auto join = [&](PixelIndex at, PixelIndex to) {
    const std::uint16_t a = center.at(at.y, at.x), b = center.at(to.y, to.x);
    if (a == b || a == kNone || b == kNone) return;
    const float contrast =
        norm({&colors.at(at.y, at.x), static_cast<std::size_t>(colors.channels())},
             &colors.at(to.y, to.x));
    neighbors_[a].push_back({b, contrast});
    neighbors_[b].push_back({a, contrast});
  };
  for (int y = 0; y < center.height; ++y) {
    for (int x = 0; x < center.width; ++x) {
      if (x > 0) join({y, x}, {y, x - 1});
      if (y > 0) join({y, x}, {y - 1, x});
    }
  }
  for (std::vector<Neighbor>& pairs : neighbors_) {
    std::ranges::stable_sort(pairs, {}, &Neighbor::id);
    std::vector<Neighbor> means;
    for (auto begin = pairs.begin(); begin != pairs.end();) {
      const auto end = std::find_if(begin, pairs.end(),
                                    [&](const Neighbor& each) { return each.id != begin->id; });
      const float sum = std::accumulate(
          begin, end, 0.0F, [](float all, const Neighbor& each) { return all + each.contrast; });
      means.push_back({begin->id, sum / static_cast<float>(end - begin)});
      begin = end;
    }
    pairs = std::move(means);
  }
}

std::vector<std::uint8_t> RaySuperpixels::alike(std::uint16_t seed, float tolerance) const {
  std::vector<std::uint8_t> selected(means_.size(), 0);
  if (seed >= means_.size()) return selected;
  const Mean& own = means_[seed];
  const auto is_like = [&](const Mean& mean) {
    return norm(mean.color, own.color.data()) <= tolerance;
  };
  std::vector<std::uint16_t> open{seed};
  selected[seed] = 1;
  while (!open.empty()) {
    const std::uint16_t at = open.back();
    open.pop_back();
    for (const auto& [next, contrast] : neighbors_[at]) {
      const float jump = std::abs(means_[next].disparity - means_[at].disparity);
      const bool is_border = jump > kSamePointTolerance_px || contrast > kBorderShare * tolerance;
      if (selected[next] != 0 || is_border || !is_like(means_[next])) continue;
      selected[next] = 1;
      open.push_back(next);
    }
  }
  return selected;
}

}  // namespace episcope
