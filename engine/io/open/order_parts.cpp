// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/order_parts.h"

#include "engine/io/order/camera_positions.h"
#include "engine/io/order/line_motion.h"
#include "engine/io/order/turned_truth.h"
#include "engine/io/order/view_axes.h"

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

/// Swaps rows and columns of views where the motion between them says so; returns the evidence.
std::string order_axes(SceneParts& parts, bool are_axes_known, ConventionReport& report,
                       const Progress& progress) {
  const ViewAxes axes = find_view_axes(parts.samples, progress);
  if (!axes.are_swapped()) return {};
  if (are_axes_known) {
    report.warnings.push_back("Rows and columns of views seem to be swapped: " + axes.evidence() +
                              ".");
    return {};
  }
  const GridShape stored = grid_of(parts.samples);
  swap_view_axes(parts.samples);
  swap_view_axes(parts.truth);
  swap_view_axes(parts.valid);
  swap_view_axes(parts.info.positions, stored);
  return axes.evidence();
}

/// A camera that zooms or turns makes no light field, but a list that looks like a line of views.
void check_line(const SceneParts& parts, ConventionReport& report, const Progress& progress) {
  const GridShape grid = grid_of(parts.samples);
  if (grid.count() < 2 || std::min(grid.v, grid.u) > 1) return;
  const LineMotion motion = measure_line_motion(parts.samples, progress);
  if (motion.is_askew()) report.warnings.push_back(motion.warning());
}

/// Undoes how a program wrote the truth of a single view, and says so.
void turn_truth(SceneParts& parts, ConventionReport& report) {
  const std::string undone = put_truth_upright(parts.samples, parts.truth.field);
  if (!undone.empty()) report.warnings.push_back(turned_back_text(undone));
}

/// Adds to what is known of order and sign: swapped axes, and where positions run.
void complete_order(SceneParts& parts, const std::string& swapped, ConventionReport& report) {
  const GridShape grid = grid_of(parts.samples);
  if (!swapped.empty()) {
    std::string order = "rows and columns swapped";
    if (report.order != "as stored") order += ", " + report.order;
    report.order = std::move(order);
    report.order_check = swapped + "; " + report.order_check;
  }
  reverse_positions(parts.info.positions, grid, flip_of(report));
  const std::string directions = position_directions(parts.info.positions, grid);
  if (!directions.empty()) report.sign_check += "; by the positions, " + directions;
}

}  // namespace

bool are_axes_stated(const OpenOptions& options) {
  return !options.axes.empty() || !options.pattern.empty() || !options.grid.empty();
}

void bring_in_order(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress) {
  progress.step("checking the order of views");
  const bool are_axes_known = parts.expected.are_axes_known || are_axes_stated(options);
  const std::string swapped = parts.swapped_axes
                                  ? *parts.swapped_axes
                                  : order_axes(parts, are_axes_known, report, progress);
  check_line(parts, report, progress);
  turn_truth(parts, report);
  put_in_order(parts.samples, parts.truth, parts.expected, options.flip, report, progress);
  reverse_views(parts.valid, grid_of(parts.samples), flip_of(report));
  complete_order(parts, swapped, report);
}

}  // namespace episcope::io
