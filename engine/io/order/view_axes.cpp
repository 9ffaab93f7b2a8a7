// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/view_axes.h"

#include "engine/core/text/text_table.h"
#include "engine/io/order/both_axes.h"
#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope::io {
namespace {

constexpr int kFarthest = 8;
/// Swapping axes against what names or files say takes more than looking at them.
constexpr double kWithoutDoubt = 8;

AxisEvidence evidence_along(const LightField::Samples& samples, bool is_v,
                            const Progress& progress) {
  const GridShape grid = grid_of(samples);
  const ViewIndex center = grid.center();
  const auto picture = [&](ViewIndex view) { return MotionPictures(grey_levels(samples, view)); };
  AxisEvidence clearest;
  if ((is_v ? grid.v : grid.u) < 2) return clearest;
  const MotionPictures middle = picture(center);
  for (int step = 1; step <= kFarthest; step *= 2) {
    progress.check();
    AxisEvidence evidence;
    for (const int offset : {-step, step}) {
      const ViewIndex view{center.v + (is_v ? offset : 0), center.u + (is_v ? 0 : offset)};
      if (grid.contains(view)) evidence.add(middle, picture(view));
    }
    if (std::abs(evidence.score()) > std::abs(clearest.score())) clearest = evidence;
    if (clearest.is_decided() && std::abs(clearest.score()) > kWithoutDoubt) break;
  }
  return clearest;
}

template <class T>
void swap_axes(ViewStack<T>& stack) {
  if (stack.empty()) return;
  if (stack.kind() == LargeKind::File) return stack.transpose_in_place();
  const GridShape grid = stack.grid();
  const ViewIndex first = stack.first();
  if (grid.u == grid.v && first.u == first.v) {
    for (int v = 0; v < grid.v; ++v) {
      for (int u = 0; u < v; ++u) {
        T* a = stack.view({first.v + v, first.u + u}).data;
        T* b = stack.view({first.v + u, first.u + v}).data;
        std::swap_ranges(a, a + stack.view_size(), b);
      }
    }
    return;
  }
  ViewStack<T> swapped({grid.u, grid.v}, stack.height(), stack.width(), stack.channels(),
                       {first.u, first.v});
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    std::copy_n(stack.view(view).data, stack.view_size(), swapped.view({view.u, view.v}).data);
  }
  stack = std::move(swapped);
}

std::string share_text(const char* which, const AxisEvidence& evidence) {
  return fmt::format("between {} {} % of the difference is motion along x and {} % along y", which,
                     fixed_text(100 * evidence.gone_along_x(), 0),
                     fixed_text(100 * evidence.gone_along_y(), 0));
}

}  // namespace

bool ViewAxes::are_swapped() const {
  const bool u_is_y = along_u.is_y() && along_u.score() < -kWithoutDoubt;
  const bool v_is_x = along_v.is_x() && along_v.score() > kWithoutDoubt;
  return (u_is_y && v_is_x) || (u_is_y && !along_v.has_pairs()) || (v_is_x && !along_u.has_pairs());
}

std::string ViewAxes::evidence() const {
  std::string text;
  if (along_u.has_pairs()) text = share_text("columns", along_u);
  if (along_u.has_pairs() && along_v.has_pairs()) text += ", ";
  if (along_v.has_pairs()) text += share_text("rows", along_v);
  return text;
}

ViewAxes find_view_axes(const LightField::Samples& samples, const Progress& progress) {
  const auto [u, v] =
      along_both_axes(progress, [&](bool is_v) { return evidence_along(samples, is_v, progress); });
  return {u, v};
}

void swap_view_axes(LightField::Samples& samples) {
  std::visit([](auto& stack) { swap_axes(stack); }, samples);
}

void swap_view_axes(ViewStack<std::uint8_t>& stack) {
  swap_axes(stack);
}

void swap_view_axes(GroundTruth& truth) {
  for (DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    swap_axes(field->disparity);
    swap_axes(field->valid);
  }
  swap_axes(truth.labels);
}

void swap_view_axes(std::vector<CameraPosition>& positions, GridShape stored) {
  if (positions.size() != static_cast<std::size_t>(stored.count())) return;
  std::vector<CameraPosition> swapped;
  for (int u = 0; u < stored.u; ++u) {
    for (int v = 0; v < stored.v; ++v) {
      swapped.push_back(positions[static_cast<std::size_t>(v * stored.u + u)]);
    }
  }
  positions = std::move(swapped);
}

}  // namespace episcope::io
