// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace episcope {

namespace {

/// Which pixels a fill may pass, 1 or 0; rows are computed when the fill reaches them. Pixels
/// already taken no longer pass.
template <class OpenRow>
class OpenPixels {
 public:
  OpenPixels(int height, int width, const OpenRow& open_row)
      : open_(height, width), is_known_(static_cast<std::size_t>(height)), open_row_(open_row) {}

  std::uint8_t* row(int y) {
    std::uint8_t* row = open_.row(y);
    if (std::exchange(is_known_[static_cast<std::size_t>(y)], std::uint8_t{1}) == 0)
      open_row_(y, row);
    return row;
  }

 private:
  Image<std::uint8_t> open_;
  std::vector<std::uint8_t> is_known_;
  const OpenRow& open_row_;
};

/// The first column from `x` on that is `value`; `end` if there is none.
int first_of(const std::uint8_t* row, std::uint8_t value, int x, int end) {
  const void* found = std::memchr(row + x, value, static_cast<std::size_t>(end - x));
  return found ? static_cast<int>(static_cast<const std::uint8_t*>(found) - row) : end;
}

/// Spans of the connected pixels that are 1 in the rows given by `open_row(y, row)`.
template <class OpenRow>
PixelRegion connected_region(int height, int width, PixelIndex seed, const OpenRow& open_row) {
  PixelRegion region;
  if (seed.y < 0 || seed.y >= height || seed.x < 0 || seed.x >= width) return region;
  OpenPixels<OpenRow> pixels(height, width, open_row);
  std::vector<PixelIndex> starts{seed};
  while (!starts.empty()) {
    const PixelIndex pixel = starts.back();
    starts.pop_back();
    std::uint8_t* row = pixels.row(pixel.y);
    if (row[pixel.x] == 0) continue;
    PixelSpan span{pixel.y, pixel.x, first_of(row, 0, pixel.x, width)};
    while (span.x0 > 0 && row[span.x0 - 1] != 0) --span.x0;
    std::fill(row + span.x0, row + span.x1, std::uint8_t{0});
    region.push_back(span);
    for (const int y : {span.y - 1, span.y + 1}) {
      if (y < 0 || y >= height) continue;
      const std::uint8_t* next = pixels.row(y);
      // The first of each stretch is enough: its span covers the rest.
      for (int x = first_of(next, 1, span.x0, span.x1); x < span.x1;) {
        starts.push_back({y, x});
        x = first_of(next, 0, x, span.x1);
        x = first_of(next, 1, x, span.x1);
      }
    }
  }
  return region;
}

/// Crossings are taken a little too wide against rounding; the exact condition then decides.
constexpr double kSlack = 1e-6;

/// All points within the radius of a segment.
class Capsule {
 public:
  explicit Capsule(const BrushPath& path)
      : from_(path.from),
        dy_(path.to.y - path.from.y),
        dx_(path.to.x - path.from.x),
        radius_(path.diameter_px / 2),
        reach_(radius_ + kSlack),
        length2_(dy_ * dy_ + dx_ * dx_) {}

  [[nodiscard]] bool covers(int y, int x) const {
    const double py = y + 0.5 - from_.y;
    const double px = x + 0.5 - from_.x;
    const double along =
        length2_ > 0 ? std::clamp((py * dy_ + px * dx_) / length2_, 0.0, 1.0) : 0.0;
    const double ey = py - along * dy_;
    const double ex = px - along * dx_;
    return ey * ey + ex * ex <= radius_ * radius_;
  }

  /// Where the line through the middles of row y enters and leaves the capsule, up to the slack; an
  /// empty interval (from > to) where it misses. The capsule is convex: its part of a line is the
  /// hull of the parts of the discs at its ends and of the strip between them.
  struct Crossing {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    void include(double a, double b) {
      from = std::min(from, a);
      to = std::max(to, b);
    }
  };
  [[nodiscard]] Crossing crossing(int y) const {
    Crossing crossing;
    const double py = y + 0.5 - from_.y;
    add_disc(py, 0, crossing);
    add_disc(py - dy_, dx_, crossing);
    add_strip(py, crossing);
    crossing.from += from_.x;
    crossing.to += from_.x;
    return crossing;
  }

 private:
  void add_disc(double py, double center_x, Crossing& crossing) const {
    const double rest = reach_ * reach_ - py * py;
    if (rest >= 0) crossing.include(center_x - std::sqrt(rest), center_x + std::sqrt(rest));
  }

  /// Of the rectangle without its round ends: 0 ≤ py·dy + px·dx ≤ length² and
  /// |py·dx − px·dy| ≤ radius · length.
  void add_strip(double py, Crossing& crossing) const {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    const auto bound = [&](double slope, double min, double max) {
      if (slope == 0) {
        if (min > 0 || max < 0) high = -std::numeric_limits<double>::infinity();
        return;
      }
      low = std::max(low, slope > 0 ? min / slope : max / slope);
      high = std::min(high, slope > 0 ? max / slope : min / slope);
    };
    const double reach = reach_ * std::sqrt(length2_);
    bound(dx_, -py * dy_, length2_ - py * dy_);
    bound(dy_, py * dx_ - reach, py * dx_ + reach);
    if (low <= high && std::isfinite(low) && std::isfinite(high)) crossing.include(low, high);
  }

  StrokePoint from_;
  double dy_;
  double dx_;
  double radius_;
  double reach_;  ///< Of the crossings.
  double length2_;
};

/// `value` rounded down, within what a view may hold.
int floor_pixel(double value, int extent) {
  return static_cast<int>(std::floor(std::clamp(value, -1.0, static_cast<double>(extent))));
}

/// The covered pixels of a row: the crossing, corrected at both ends by the exact condition.
PixelSpan covered_span(const Capsule& capsule, int y, int width) {
  const Capsule::Crossing crossing = capsule.crossing(y);
  if (!(crossing.from <= crossing.to)) return {y, 0, 0};
  int x0 = std::clamp(floor_pixel(crossing.from - 0.5, width), 0, width);
  int x1 = std::clamp(floor_pixel(crossing.to - 0.5, width) + 2, 0, width);
  while (x0 < x1 && !capsule.covers(y, x0)) ++x0;
  while (x0 < x1 && !capsule.covers(y, x1 - 1)) --x1;
  return {y, x0, x1};
}

void require_sound(const BrushPath& path) {
  if (!(path.diameter_px >= kMinBrush_px && path.diameter_px <= kMaxBrush_px)) {
    throw InvalidInput(
        fmt::format("a brush of {:f} px is not possible; choose 1 to 100 px", path.diameter_px));
  }
  for (const double value : {path.from.y, path.from.x, path.to.y, path.to.x}) {
    if (!std::isfinite(value)) throw InvalidInput("a point of a stroke is not a number");
  }
}

}  // namespace

PixelRegion region_of_segment(ImageView<const std::int32_t> segmentation, PixelIndex seed) {
  const bool is_inside =
      seed.y >= 0 && seed.y < segmentation.height && seed.x >= 0 && seed.x < segmentation.width;
  if (!is_inside) return {};
  const std::int32_t label = segmentation.at(seed.y, seed.x);
  return connected_region(segmentation.height, segmentation.width, seed,
                          [&](int y, std::uint8_t* row) {
                            const std::int32_t* labels = segmentation.row(y);
                            std::transform(labels, labels + segmentation.width, row,
                                           [label](std::int32_t each) { return each == label; });
                          });
}

PixelRegion covered_pixels(const BrushPath& path, int height, int width) {
  require_sound(path);
  const Capsule capsule(path);
  const double radius = path.diameter_px / 2;
  const double top = std::min(path.from.y, path.to.y) - radius;
  const double bottom = std::max(path.from.y, path.to.y) + radius;
  PixelRegion region;
  const int end = std::min(floor_pixel(bottom, height) + 1, height);
  for (int y = std::max(floor_pixel(top, height), 0); y < end; ++y) {
    PixelSpan span = covered_span(capsule, y, width);
    for (const StrokePoint& point : {path.from, path.to}) {
      const int x = floor_pixel(point.x, width);
      if (floor_pixel(point.y, height) != y || x < 0 || x >= width) continue;
      span = span.x0 < span.x1 ? PixelSpan{y, std::min(span.x0, x), std::max(span.x1, x + 1)}
                               : PixelSpan{y, x, x + 1};
    }
    if (span.x0 < span.x1) region.push_back(span);
  }
  return region;
}

namespace {

/// Where an edge crosses the middle of a row, and whether it goes up or down there.
struct Crossing {
  double x = 0;
  int winding = 0;
};

std::vector<Crossing> crossings_at(double y, std::span<const StrokePoint> corners) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const StrokePoint& a = corners[i];
    const StrokePoint& b = corners[(i + 1) % corners.size()];
    // Half-open, so that a corner on the row counts once.
    if ((a.y <= y) == (b.y <= y)) continue;
    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    crossings.push_back({x, a.y < b.y ? 1 : -1});
  }
  std::ranges::sort(crossings, {}, &Crossing::x);
  return crossings;
}

// The first pixel whose center does not lie left of `x`.
int first_at(double x, int width) {
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width)));
}

void add_row(int y, int width, const std::vector<Crossing>& crossings, PixelRegion& region) {
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding;
    if (winding == 0) continue;
    const int x0 = first_at(crossings[i].x, width);
    const int x1 = first_at(crossings[i + 1].x, width);
    if (x0 >= x1) continue;
    const bool continues = !region.empty() && region.back().y == y && region.back().x1 == x0;
    if (continues) {
      region.back().x1 = x1;
    } else {
      region.push_back({y, x0, x1});
    }
  }
}

// Ink and menu entry for these settings; also for fills. Throws InvalidInput for a label outside 1
// … 255.
Ink ink_of(const PaintStyle& style) {
  if (style.label < 1 || style.label > LabelSet::kMaxId) {
    throw InvalidInput(
        fmt::format("the label id {} is out of range; ids range from 1 to 255", style.label));
  }
  const auto label = static_cast<std::uint8_t>(style.label);
  Ink ink;
  if (style.tool == PaintTool::Brush) ink.label = label;
  if (style.protects_others) {
    ink.kept = all_labels_but(style.tool == PaintTool::Brush ? 0 : label);
  }
  ink.kept |= style.locked;
  if (ink.label != 0 && style.locked[label]) ink.kept.set();
  return ink;
}

}  // namespace

PixelRegion pixels_in_polygon(std::span<const StrokePoint> corners, int height, int width) {
  PixelRegion region;
  const auto is_finite = [](const StrokePoint& each) {
    return std::isfinite(each.y) && std::isfinite(each.x);
  };
  if (!std::ranges::all_of(corners, is_finite)) {
    throw InvalidInput("a corner of a polygon is not finite");
  }
  if (corners.size() < 3) return region;
  const auto [top, bottom] = std::ranges::minmax(corners, {}, &StrokePoint::y);
  const int y0 = first_at(top.y, height);
  const int y1 = first_at(bottom.y, height);
  for (int y = y0; y < y1; ++y) add_row(y, width, crossings_at(y + 0.5, corners), region);
  return region;
}

EditKind kind_of(const PaintStyle& style) {
  return style.tool == PaintTool::Brush ? EditKind::Paint : EditKind::Erase;
}

Stroke::Stroke(AnnotationDocument& document, ViewIndex view, const PaintStyle& style)
    : layer_(&document.scribbles()),
      view_(view),
      diameter_px_(style.diameter_px),
      ink_(ink_of(style)),
      edit_(document, kind_of(style)) {
  edit_.paint(view, covered_pixels({{}, {}, diameter_px_}, 0, 0), ink_);  // Checks all three.
}

PixelRect Stroke::extend(StrokePoint point) {
  const BrushPath path{last_.value_or(point), point, diameter_px_};
  const PixelRegion region = covered_pixels(path, layer_->height(), layer_->width());
  last_ = point;
  return edit_.paint(view_, region, ink_);
}

bool fill_regions(AnnotationDocument& document, const std::vector<ViewRegion>& regions,
                  const PaintStyle& style, EditKind kind) {
  PendingEdit edit(document, kind);
  for (const ViewRegion& each : regions) edit.paint(each.view, each.region, ink_of(style));
  return edit.commit();
}

bool fill_region(AnnotationDocument& document, ViewIndex view, const PixelRegion& region,
                 const PaintStyle& style, EditKind kind) {
  return fill_regions(document, {{view, region}}, style, kind);
}

}  // namespace episcope
