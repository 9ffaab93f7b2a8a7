// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/painted_views.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

namespace episcope {
namespace {

const Image<std::int32_t>* strokes_on(const Scribbles& scribbles, ViewIndex view) {
  const auto found = std::ranges::find(scribbles.views, view, &ViewScribbles::view);
  return found == scribbles.views.end() ? nullptr : &found->labels;
}

// 1 where strokes differ, of which null has none; empty if they are the same.
Image<std::uint8_t> difference(const Image<std::int32_t>* before,
                               const Image<std::int32_t>* after) {
  const Image<std::int32_t>& either = before ? *before : *after;
  const Image<std::int32_t> none(either.height(), either.width());
  const Image<std::int32_t>&a = before ? *before : none, &b = after ? *after : none;
  Image<std::uint8_t> changed(none.height(), none.width());
  std::transform(a.begin(), a.end(), b.begin(), changed.begin(),
                 [](std::int32_t was, std::int32_t is) { return was != is ? 1 : 0; });
  const bool is_any = std::ranges::any_of(changed, [](std::uint8_t each) { return each != 0; });
  return is_any ? std::move(changed) : Image<std::uint8_t>();
}

void require_fit(const ViewScribbles& painted, const LightField& lf) {
  if (lf.grid().contains(painted.view) && painted.labels.height() == lf.height() &&
      painted.labels.width() == lf.width()) {
    return;
  }
  throw InvalidInput(fmt::format(
      "scribbles of {}×{} px on view {} do not fit the light field {} of {}×{} views of {}×{} px",
      painted.labels.width(), painted.labels.height(), view_text(painted.view), lf.info().name,
      lf.grid().v, lf.grid().u, lf.width(), lf.height()));
}

struct Painted {
  const ViewScribbles* view;
  std::ptrdiff_t pixels = 0;
  std::set<std::int32_t> labels{};
};

Painted painted_in(const ViewScribbles& view) {
  Painted painted{&view};
  std::int32_t last = 0;
  for (const std::int32_t label : view.labels) {
    if (label != last) painted.labels.insert(label);
    last = label;
    painted.pixels += label != 0 ? 1 : 0;
  }
  return painted;
}

}  // namespace

std::vector<std::int32_t> painted_labels(const Scribbles& scribbles, const LightField& lf) {
  std::set<std::int32_t> found;
  for (const ViewScribbles& painted : scribbles.views) {
    require_fit(painted, lf);
    std::int32_t last = 0;
    for (const std::int32_t label : painted.labels) {
      if (label != last && label > 0) found.insert(label);
      last = label;
    }
  }
  if (found.empty()) {
    throw InvalidInput("nothing is painted yet; paint strokes of at least two labels");
  }
  if (found.size() == 1) {
    throw InvalidInput(
        fmt::format("only label {} is painted; paint a second one as well", *found.begin()));
  }
  return {found.begin(), found.end()};
}

bool have_same_strokes(const std::vector<ViewScribbles>& a, const std::vector<ViewScribbles>& b) {
  return std::ranges::equal(a, b, [](const ViewScribbles& left, const ViewScribbles& right) {
    return left.view == right.view && std::ranges::equal(left.labels, right.labels);
  });
}

std::vector<const ViewScribbles*> teaching_views(const std::vector<ViewScribbles>& views) {
  std::vector<Painted> all;
  for (const ViewScribbles& view : views) all.push_back(painted_in(view));
  if (all.size() > kTeachingViews) {
    std::ranges::stable_sort(all, std::greater<>(), &Painted::pixels);
  }
  std::set<std::int32_t> taught{0};
  std::vector<const ViewScribbles*> chosen;
  for (const Painted& each : all) {
    if (chosen.size() >= kTeachingViews && std::ranges::includes(taught, each.labels)) continue;
    taught.insert(each.labels.begin(), each.labels.end());
    chosen.push_back(each.view);
  }
  return chosen;
}

std::vector<NewStrokes> new_strokes(const Scribbles& former, const Scribbles& now,
                                    ViewIndex first) {
  std::set<std::pair<int, int>> painted;
  for (const Scribbles* each : {&former, &now}) {
    for (const ViewScribbles& view : each->views) painted.insert({view.view.v, view.view.u});
  }
  std::vector<NewStrokes> all;
  for (const auto& [v, u] : painted) {
    Image<std::uint8_t> strokes = difference(strokes_on(former, {v, u}), strokes_on(now, {v, u}));
    if (!strokes.empty()) all.push_back({{v, u}, std::move(strokes)});
  }
  if (all.size() <= kNewViews) return all;
  auto kept = std::ranges::find(all, first, &NewStrokes::view);
  if (kept == all.end()) {
    kept = std::ranges::max_element(
        all, {}, [](const NewStrokes& each) { return std::ranges::count(each.pixels, 1); });
  }
  std::iter_swap(all.begin(), kept);
  all.resize(1);
  return all;
}

}  // namespace episcope
