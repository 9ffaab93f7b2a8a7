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
  field.valid =
      ViewStack<std::uint8_t>(depth.grid(), depth.height(), depth.width(), 1, depth.first());
  std::vector<std::size_t> valid_counts(static_cast<std::size_t>(depth.grid().count()));
  parallel_for(depth.grid().count(), progress, [&](int i) {
    const ViewIndex view = depth.view_at(i);
    const auto z = maps.depth.view(view);
    const auto valid = field.valid.view(view);
    for (int y = 0; y < z.height; ++y) {
      for (int x = 0; x < z.width; ++x) {
        const bool is_valid = maps.is_valid(view, y, x);
        valid.at(y, x) = is_valid ? 1 : 0;
        z.at(y, x) = is_valid ? static_cast<float>(camera.disparity_from_depth(z.at(y, x))) : 0;
        valid_counts[static_cast<std::size_t>(i)] += is_valid ? 1 : 0;
      }
    }
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
