// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/flipped_truth.h"

#include <algorithm>
#include <optional>

namespace episcope::io {
namespace {

/// Share of the error as stored, and of that without warping, below which a turned map is right:
/// the right map is near the least error that there is, so none can be so much better than it.
constexpr double kFarBetterTurn = 0.6;
/// Share of the error without warping below which a map is right beyond doubt.
constexpr double kEvident = 0.2;

constexpr MapTurn kTurns[] = {{false, true, false, "rows from bottom to top"},
                              {false, false, true, "columns from right to left"},
                              {false, true, true, "both rows and columns in reverse order"},
                              {true, false, false, "rows and columns exchanged"}};

/// A single view of the stack, or all.
template <class T>
ViewStack<T> turned(const ViewStack<T>& stack, const MapTurn& turn, GridShape grid,
                    ViewIndex first) {
  if (stack.empty()) return {};
  ViewStack<T> out(grid, stack.height(), stack.width(), 1, first);
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = out.view_at(i);
    const auto from = stack.view(view);
    const auto to = out.view(view);
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        const int source_y = turn.flips_y ? to.height - 1 - y : y;
        const int source_x = turn.flips_x ? to.width - 1 - x : x;
        to.at(y, x) = turn.is_transposed ? from.at(x, y) : from.at(source_y, source_x);
      }
    }
  }
  return out;
}

}  // namespace

std::vector<MapTurn> possible_turns(int height, int width) {
  std::vector<MapTurn> turns;
  for (const MapTurn& turn : kTurns) {
    if (!turn.is_transposed || height == width) turns.push_back(turn);
  }
  return turns;
}

DisparityField turned_back(const DisparityField& field, const MapTurn& turn) {
  const GridShape grid = field.disparity.grid();
  const ViewIndex first = field.disparity.first();
  return {turned(field.disparity, turn, grid, first), turned(field.valid, turn, grid, first)};
}

DisparityField turned_back(const DisparityView& map, const MapTurn& turn) {
  const int height = map.disparity.height;
  const int width = map.disparity.width;
  DisparityField field{ViewStack<float>({1, 1}, height, width),
                       ViewStack<std::uint8_t>({1, 1}, height, width)};
  for (int y = 0; y < height; ++y) {
    std::copy_n(map.disparity.row(y), width, field.disparity.view({}).row(y));
    for (int x = 0; x < width; ++x) field.valid.view({}).at(y, x) = map.is_valid(y, x) ? 1 : 0;
  }
  return turned_back(field, turn);
}

std::string turned_back_text(const std::string& turn) {
  return "The truth was stored with " + turn +
         ", as comparing it with the views shows; it was put right.";
}

UprightTruth put_truth_upright(const LightField::Samples& samples, DisparityField& field) {
  if (field.empty()) return {};
  const ViewIndex center = grid_of(samples).center();
  const ViewIndex at = field.contains(center) ? center : field.disparity.first();
  UprightTruth found{{}, warp_errors(samples, at, field.view(at))};
  const WarpErrors stored = *found.errors;
  const double without = stored.unwarped();
  if (stored.best() < kEvident * without) return found;
  double least = kFarBetterTurn * std::min(stored.best(), without);
  std::optional<MapTurn> undone;
  for (const MapTurn& turn : possible_turns(field.disparity.height(), field.disparity.width())) {
    const DisparityField candidate{turned(field.disparity, turn, {1, 1}, at),
                                   turned(field.valid, turn, {1, 1}, at)};
    const WarpErrors errors = warp_errors(samples, at, candidate.view(at));
    if (errors.best() >= least) continue;
    least = errors.best();
    found.errors = errors;
    undone = turn;
  }
  if (!undone) return found;
  field = turned_back(field, *undone);
  found.undone = undone->text;
  return found;
}

}  // namespace episcope::io
