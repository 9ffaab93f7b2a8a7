// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/turned_truth.h"

#include "engine/io/order/warp_check.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace episcope::io {
namespace {

/// Share of the error as stored, and of that without warping, below which a turned map is right:
/// the right map is near the least error that there is, so none can be so much better than it.
constexpr double kFarBetter = 0.6;
/// Share of the error without warping below which a map is right beyond doubt.
constexpr double kEvident = 0.2;

/// How a map may have been written.
struct Turn {
  bool is_transposed = false;
  bool flips_y = false;
  bool flips_x = false;
  const char* text = "";
};

constexpr Turn kTurns[] = {{false, true, false, "rows from bottom to top"},
                           {false, false, true, "columns from right to left"},
                           {false, true, true, "both rows and columns in reverse order"},
                           {true, false, false, "rows and columns exchanged"}};

/// A single view of the stack, or all.
template <class T>
ViewStack<T> turned(const ViewStack<T>& stack, const Turn& turn, GridShape grid, ViewIndex first) {
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

double unwarped(const WarpErrors& errors) {
  const auto pixels = static_cast<double>(errors.u.pixels + errors.v.pixels);
  if (pixels == 0) return 0;
  return (errors.u.unwarped * static_cast<double>(errors.u.pixels) +
          errors.v.unwarped * static_cast<double>(errors.v.pixels)) /
         pixels;
}

}  // namespace

std::string put_truth_upright(const LightField::Samples& samples, DisparityField& field) {
  if (field.empty()) return {};
  const ViewIndex center = grid_of(samples).center();
  const ViewIndex at = field.contains(center) ? center : field.disparity.first();
  const WarpErrors stored = warp_errors(samples, at, field.view(at));
  const double without = unwarped(stored);
  if (stored.best() < kEvident * without) return {};
  double least = kFarBetter * std::min(stored.best(), without);
  const Turn* undone = nullptr;
  for (const Turn& turn : kTurns) {
    if (turn.is_transposed && field.disparity.height() != field.disparity.width()) continue;
    const DisparityField candidate{turned(field.disparity, turn, {1, 1}, at),
                                   turned(field.valid, turn, {1, 1}, at)};
    const double error = warp_errors(samples, at, candidate.view(at)).best();
    if (error >= least) continue;
    least = error;
    undone = &turn;
  }
  if (undone == nullptr) return {};
  const GridShape grid = field.disparity.grid();
  const ViewIndex first = field.disparity.first();
  field = {turned(field.disparity, *undone, grid, first),
           turned(field.valid, *undone, grid, first)};
  return undone->text;
}

}  // namespace episcope::io
