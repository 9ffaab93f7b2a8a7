// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/view_order.h"

#include "engine/core/error.h"
#include "engine/io/models/open_options.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace episcope::io {
namespace {

/// Change from one end of the grid to the other, summed over rows or columns.
CameraPosition change(const std::vector<CameraPosition>& positions, GridShape grid, bool is_u) {
  CameraPosition sum;
  const int lines = is_u ? grid.v : grid.u;
  for (int i = 0; i < lines; ++i) {
    const int first = is_u ? i * grid.u : i;
    const int last = is_u ? first + grid.u - 1 : (grid.v - 1) * grid.u + i;
    const CameraPosition& a = positions[static_cast<std::size_t>(first)];
    const CameraPosition& b = positions[static_cast<std::size_t>(last)];
    sum.x += b.x - a.x;
    sum.y += b.y - a.y;
  }
  return sum;
}

std::string direction(const char* name, CameraPosition change) {
  const bool is_x = std::abs(change.x) >= std::abs(change.y);
  const double along = is_x ? change.x : change.y;
  if (along == 0 || !std::isfinite(along)) return {};
  return std::string("camera ") + name + (along > 0 ? " = larger " : " = smaller ") +
         (is_x ? "X" : "Y");
}

}  // namespace

void reverse_positions(std::vector<CameraPosition>& positions, GridShape grid, ViewFlip flip) {
  if (positions.size() != static_cast<std::size_t>(grid.count())) return;
  std::vector<CameraPosition> moved;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex from = flipped(grid.view_at(i), grid, flip);
    moved.push_back(positions[static_cast<std::size_t>(from.v * grid.u + from.u)]);
  }
  positions = std::move(moved);
}

std::string position_directions(const std::vector<CameraPosition>& positions, GridShape grid) {
  if (positions.size() != static_cast<std::size_t>(grid.count())) return {};
  const std::string right = direction("right", change(positions, grid, true));
  const std::string down = direction("down", change(positions, grid, false));
  return right.empty() || down.empty() ? right + down : right + ", " + down;
}

namespace {

bool holds(const ViewCrop& crop, ViewIndex stored) {
  return crop.kept.contains({stored.v - crop.first.v, stored.u - crop.first.u});
}

}  // namespace

ViewCrop parse_crop(const std::string& text, GridShape stored) {
  const GridShape kept = parse_grid(text);
  if (kept.v > stored.v || kept.u > stored.u) {
    throw InvalidInput(
        fmt::format("--crop {} asks for more than the {} views that there are; give "
                    "a smaller grid, or all",
                    text, grid_text(stored)));
  }
  return central_crop(stored, kept);
}

void crop_truth(GroundTruth& truth, const ViewCrop& crop) {
  for (DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    field->disparity = cropped(std::move(field->disparity), crop);
    field->valid = cropped(std::move(field->valid), crop);
  }
  truth.labels = cropped(std::move(truth.labels), crop);
}

Scribbles cropped(Scribbles scribbles, const ViewCrop& crop) {
  std::erase_if(scribbles.views, [&](const ViewScribbles& one) { return !holds(crop, one.view); });
  for (ViewScribbles& one : scribbles.views) {
    one.view = {one.view.v - crop.first.v, one.view.u - crop.first.u};
  }
  return scribbles;
}

Scribbles uncropped(Scribbles scribbles, Scribbles before, const ViewCrop& crop) {
  for (ViewScribbles& one : scribbles.views) {
    one.view = {one.view.v + crop.first.v, one.view.u + crop.first.u};
  }
  for (ViewScribbles& one : before.views) {
    if (!holds(crop, one.view)) scribbles.views.push_back(std::move(one));
  }
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
  return scribbles;
}

}  // namespace episcope::io
