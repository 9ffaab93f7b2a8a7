// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/pose_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace episcope::io {
namespace {

constexpr double kMostOff_steps = 0.1;

/// How cameras of a light field may differ from a plane grid that is exact: orientations by half a
/// degree, places by a tenth of a step, on the plane and off it, steps of rows and columns by a
/// tenth.
constexpr double kMostTurn_deg = 0.5;

constexpr std::size_t kFewestCameras = 3;
constexpr double kMostPosePlaces = 10;  ///< Of a grid with gaps, for each camera.
constexpr double kMostSteps = 1e4;
constexpr double kOneLine_spans = 0.02;  ///< Of the larger extent: then it is a single row.

/// A camera seen by the first one: to the right, below, ahead of it.
struct PlanePlace {
  double x = 0;
  double y = 0;
  double z = 0;
};

std::vector<PlanePlace> places_of(const std::vector<CameraPose>& poses) {
  const CameraPose& first = poses.front();
  std::vector<PlanePlace> places;
  for (const CameraPose& pose : poses) {
    const Direction from_first{pose.center[0] - first.center[0], pose.center[1] - first.center[1],
                               pose.center[2] - first.center[2]};
    places.push_back(
        {dot(from_first, first.right), dot(from_first, first.down), dot(from_first, first.ahead)});
  }
  return places;
}

double largest_turn_deg(const std::vector<CameraPose>& poses) {
  double smallest = 1;
  const CameraPose& first = poses.front();
  for (const CameraPose& pose : poses) {
    smallest = std::min({smallest, dot(pose.right, first.right), dot(pose.down, first.down),
                         dot(pose.ahead, first.ahead)});
  }
  return std::acos(std::clamp(smallest, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Equal steps along one axis, and in which of them each camera is.
struct Steps {
  double first = 0;
  double step = 0;  ///< 0 for a single one.
  int count = 1;
  std::vector<int> numbers;
  double off = 0;  ///< The largest deviation.
};

Steps steps_along(const std::vector<PlanePlace>& places, double PlanePlace::*axis, double gap) {
  std::vector<double> sorted;
  for (const PlanePlace& place : places) sorted.push_back(place.*axis);
  std::ranges::sort(sorted);
  Steps steps;
  steps.first = sorted.front();
  std::vector<double> distances;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] > gap) distances.push_back(sorted[i] - sorted[i - 1]);
  }
  if (!distances.empty()) {
    // Where cameras are missing some distances are larger.
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::ranges::nth_element(distances, middle);
    const double extent = sorted.back() - sorted.front();
    steps.count = 1 + static_cast<int>(std::lround(std::min(extent / *middle, kMostSteps)));
    steps.step = extent / (steps.count - 1);
  }
  for (const PlanePlace& place : places) {
    const double from_first = place.*axis - steps.first;
    const int number = steps.step > 0 ? static_cast<int>(std::lround(from_first / steps.step)) : 0;
    steps.numbers.push_back(number);
    steps.off = std::max(steps.off, std::abs(from_first - number * steps.step));
  }
  return steps;
}

double extent(const std::vector<PlanePlace>& places, double PlanePlace::*axis) {
  const auto [least, most] = std::ranges::minmax_element(places, {}, axis);
  return (*most).*axis - (*least).*axis;
}

/// The step of a full grid of so many cameras follows from its extents: rows and columns with
/// about equal steps. Of a grid with gaps the step is smaller.
double likely_step(const std::vector<PlanePlace>& places) {
  const double width = extent(places, &PlanePlace::x);
  const double height = extent(places, &PlanePlace::y);
  const double longer = std::max(width, height);
  const double shorter = std::min(width, height);
  const auto count = static_cast<double>(places.size());
  if (shorter <= kOneLine_spans * longer) return longer / (count - 1);
  // (width / s + 1) · (height / s + 1) = count
  const double a = count - 1;
  const double b = width + height;
  return (b + std::sqrt(b * b + 4 * a * width * height)) / (2 * a);
}

std::string problem_of(const PoseGrid& grid, const Steps& columns, const Steps& rows, double depth,
                       std::size_t count) {
  const double off = std::max(columns.off, rows.off) / grid.step;
  if (depth / grid.step > kMostOff_steps) {
    return fmt::format(
        "the cameras do not stand on a plane that they face: they differ by {:.2g} "
        "of their step along the line of sight",
        depth / grid.step);
  }
  const double places = static_cast<double>(rows.count) * columns.count;
  if (places > kMostPosePlaces * static_cast<double>(count)) {
    return fmt::format("{} cameras do not fill a grid of equal steps, which would have {}×{}",
                       count, grid.grid.v, grid.grid.u);
  }
  if (off > kMostOff_steps) {
    return fmt::format("the cameras are off a grid of equal steps by up to {:.2g} of a step", off);
  }
  const bool has_both = columns.step > 0 && rows.step > 0;
  const double ratio = has_both ? columns.step / rows.step : 1;
  if (std::abs(ratio - 1) > kMostOff_steps) {
    return fmt::format("columns are {:.3g} times as far apart as rows", ratio);
  }
  return {};
}

/// The cameras in their places; says so if two stand in one.
std::string fill(PoseGrid& grid, const Steps& columns, const Steps& rows,
                 const std::vector<PlanePlace>& places) {
  grid.order.assign(static_cast<std::size_t>(grid.grid.count()), kNoCamera);
  grid.positions.resize(grid.order.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = static_cast<std::size_t>(rows.numbers[i] * grid.grid.u + columns.numbers[i]);
    if (grid.order[at] != kNoCamera) return "two cameras stand in the same place";
    grid.order[at] = i;
    const auto rounded = [&](double length) {
      return std::round(length / grid.step * 1e6) / 1e6 * grid.step;
    };
    grid.positions[at] = {rounded(places[i].x - columns.first), rounded(places[i].y - rows.first)};
  }
  return {};
}

}  // namespace

PoseGrid find_pose_grid(const std::vector<CameraPose>& poses) {
  PoseGrid grid;
  if (poses.size() < kFewestCameras) return {.problem = "there are less than three cameras"};
  if (!std::ranges::all_of(poses, &CameraPose::is_finite)) {
    return {.problem = "some numbers are not finite"};
  }
  const double turn_deg = largest_turn_deg(poses);
  if (turn_deg > kMostTurn_deg) {
    return {.problem = fmt::format("the cameras are turned against each other by up to {:.3g}°",
                                   turn_deg)};
  }
  const std::vector<PlanePlace> places = places_of(poses);
  const double gap = likely_step(places) / 4;
  if (!(gap > 0)) return {.problem = "all cameras stand in one place"};
  const Steps columns = steps_along(places, &PlanePlace::x, gap);
  const Steps rows = steps_along(places, &PlanePlace::y, gap);
  grid.grid = {rows.count, columns.count};
  grid.step = columns.step > 0 && rows.step > 0 ? (columns.step + rows.step) / 2
                                                : std::max(columns.step, rows.step);
  if (!(grid.step > 0))
    return {.problem = "the cameras do not stand in rows and columns of equal steps"};
  const double depth = extent(places, &PlanePlace::z);
  grid.problem = problem_of(grid, columns, rows, depth, poses.size());
  if (grid.problem.empty()) grid.problem = fill(grid, columns, rows, places);
  grid.focal_widths = poses.front().focal_widths;
  grid.evidence = fmt::format(
      "cameras in steps of {:.4g}, off the grid by up to {:.2g} of a step, turned against each "
      "other by up to {:.2g}°",
      grid.step, std::max({columns.off, rows.off, depth}) / grid.step, turn_deg);
  return grid;
}

}  // namespace episcope::io
