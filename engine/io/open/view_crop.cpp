// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/view_crop.h"

#include "engine/core/error.h"
#include "engine/io/open/grid_option.h"

#include <fmt/format.h>

#include <utility>

namespace episcope::io {
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
