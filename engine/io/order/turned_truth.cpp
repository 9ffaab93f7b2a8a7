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

/// How a map may have been written.
struct Turn {
  bool is_transposed = false;  ///< Else upside down.
  const char* text = "";
};

constexpr Turn kTurns[] = {{false, "rows from bottom to top"},
                           {true, "rows and columns exchanged"}};

template <class T>
ViewStack<T> turned(const ViewStack<T>& stack, const Turn& turn) {
  if (stack.empty()) return {};
  ViewStack<T> out({1, 1}, stack.height(), stack.width(), 1, stack.first());
  const auto from = stack.view(stack.first());
  const auto to = out.view(stack.first());
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      to.at(y, x) = turn.is_transposed ? from.at(x, y) : from.at(to.height - 1 - y, x);
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
  if (field.empty() || field.disparity.grid().count() != 1) return {};
  const ViewIndex at = field.disparity.first();
  const WarpErrors stored = warp_errors(samples, at, field.view(at));
  double least = kFarBetter * std::min(stored.best(), unwarped(stored));
  if (stored.best() < kFarBetter * unwarped(stored)) return {};
  std::string undone;
  DisparityField best;
  for (const Turn& turn : kTurns) {
    if (turn.is_transposed && field.disparity.height() != field.disparity.width()) continue;
    DisparityField candidate{turned(field.disparity, turn), turned(field.valid, turn)};
    const double error = warp_errors(samples, at, candidate.view(at)).best();
    if (error >= least) continue;
    least = error;
    undone = turn.text;
    best = std::move(candidate);
  }
  if (!undone.empty()) field = std::move(best);
  return undone;
}

}  // namespace episcope::io
