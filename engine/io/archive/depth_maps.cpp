// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/depth_maps.h"

#include "engine/core/parallel/parallel.h"
#include "engine/io/archive/depth_units.h"
#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace episcope::io {
namespace {

/// The view whose neighbours tell most: the centre, or another if depth is there only.
ViewIndex reference_view(const DepthMaps& maps, GridShape grid) {
  return maps.depth.contains(grid.center()) ? grid.center() : maps.depth.first();
}

Interval depth_range(const DepthMaps& maps, ViewIndex view) {
  Interval range{std::numeric_limits<double>::infinity(), 0};
  for (int y = 0; y < maps.depth.height(); ++y) {
    for (int x = 0; x < maps.depth.width(); ++x) {
      if (!maps.is_valid(view, y, x)) continue;
      const double z = maps.depth.view(view).at(y, x);
      range = {std::min(range.min, z), std::max(range.max, z)};
    }
  }
  return range;
}

DisparityField one_view(const DepthMaps& maps, ViewIndex view, const CameraGrid& camera) {
  DisparityField field{ViewStack<float>({1, 1}, maps.depth.height(), maps.depth.width(), 1, view),
                       {}};
  auto out = field.disparity.view(view);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double z = maps.is_valid(view, y, x) ? maps.depth.view(view).at(y, x) : 0;
      out.at(y, x) = static_cast<float>(camera.disparity_from_depth(z));
    }
  }
  return field;
}

/// If all valid depth lies in one view, the field shrinks to that view.
void keep_only_valid_view(DisparityField& field, const std::vector<std::size_t>& valid_counts) {
  const auto is_used = [](std::size_t count) { return count > 0; };
  if (valid_counts.size() < 2 ||
      std::count_if(valid_counts.begin(), valid_counts.end(), is_used) != 1) {
    return;
  }
  const auto used = std::find_if(valid_counts.begin(), valid_counts.end(), is_used);
  const ViewIndex view =
      field.disparity.view_at(static_cast<int>(std::distance(valid_counts.begin(), used)));
  const auto shrink = [&]<class T>(ViewStack<T>& stack) {
    ViewStack<T> single({1, 1}, stack.height(), stack.width(), 1, view);
    std::copy_n(stack.view(view).data, stack.view_size(), single.data());
    stack = std::move(single);
  };
  shrink(field.disparity);
  shrink(field.valid);
}

/// Turns the depth of a view into disparity, 0 where `valid` is 0 or becomes so because there is no
/// depth. Written without branches or calls, since all views of a large light field pass through
/// it. Returns how many pixels are valid.
std::size_t turn_view(float* z, std::uint8_t* valid, std::size_t size, const CameraGrid& camera) {
  const double at_depth_one = camera.baseline * camera.focal_length;
  const double shift = camera.shift;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const float depth = z[i];
    const bool is_depth = (depth > 0) & (depth <= std::numeric_limits<float>::max());
    const bool is_valid = is_depth & (valid[i] != 0);
    const auto disparity =
        static_cast<float>(at_depth_one / (is_valid ? depth : 1.0F) - shift);  // eq. 1
    valid[i] = is_valid ? 1 : 0;
    z[i] = is_valid ? disparity : 0;
    count += is_valid ? 1 : 0;
  }
  return count;
}

void warn_of_gaps(const std::string& name, std::size_t valid, std::size_t total,
                  ConventionReport& report) {
  if (valid == total) return;
  const double share = 100 * static_cast<double>(total - valid) / static_cast<double>(total);
  report.warnings.push_back(fmt::format(
      "{} holds no depth at {:.3g} % of its pixels (masked, zero, negative or NaN); they are "
      "ignored.",
      name, share));
}

}  // namespace

DisparityField disparity_from_depth(DepthMaps maps, const CameraGrid& camera,
                                    ConventionReport& report, const Progress& progress) {
  DisparityField field;
  const ViewStack<float>& depth = maps.depth;
  // A mask of all views becomes what is valid; another is copied.
  const bool is_mask_whole = maps.mask.grid() == depth.grid() && maps.mask.first() == depth.first();
  field.valid = is_mask_whole ? std::move(maps.mask)
                              : ViewStack<std::uint8_t>(depth.grid(), depth.height(), depth.width(),
                                                        1, depth.first());
  std::vector<std::size_t> valid_counts(static_cast<std::size_t>(depth.grid().count()));
  parallel_for(depth.grid().count(), progress, [&](int i) {
    const ViewIndex view = depth.view_at(i);
    const auto z = maps.depth.view(view);
    const auto valid = field.valid.view(view);
    if (!is_mask_whole && maps.mask.contains(view)) {
      std::copy_n(maps.mask.view(view).data, valid.size(), valid.data);
    } else if (!is_mask_whole) {
      std::fill_n(valid.data, valid.size(), std::uint8_t{1});
    }
    valid_counts[static_cast<std::size_t>(i)] = turn_view(z.data, valid.data, z.size(), camera);
  });
  field.disparity = std::move(maps.depth);
  keep_only_valid_view(field, valid_counts);
  std::size_t valid = 0;
  for (const std::size_t count : valid_counts) valid += count;
  warn_of_gaps(maps.name, valid, field.valid.size(), report);
  if (valid == 0) return {};
  if (valid == field.valid.size()) field.valid = {};
  return field;
}

CameraGrid settle_units(const DepthMaps& maps, const LightField::Samples& samples,
                        const CameraGrid& stored, Units units, ConventionReport& report) {
  const GridShape grid = grid_of(samples);
  const ViewIndex view = reference_view(maps, grid);
  const Interval range = depth_range(maps, view);
  if (!(range.max > 0)) {
    report.units = "no valid depth";
    return stored;
  }
  const UnitsFinding finding =
      find_units({stored, maps.depth.width(), range}, units, [&](const CameraGrid& camera) {
        const DisparityField field = one_view(maps, view, camera);
        return warp_errors(samples, view, field.view(view)).best();
      });
  report.units = finding.text;
  report.units_check = finding.check;
  report.units_were_chosen = units != Units::Auto;
  report.warnings.insert(report.warnings.end(), finding.warnings.begin(), finding.warnings.end());
  return finding.camera;
}

}  // namespace episcope::io
