// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/shear.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope {
namespace {

constexpr int kTaps = 4;
constexpr float kSameSurface = 0.1F;  // px

/// Along one axis, element i is fetched at i + whole + fraction.
struct Offset {
  int whole = 0;
  float fraction = 0;

  explicit Offset(double px)
      : whole(static_cast<int>(std::floor(px))),
        fraction(static_cast<float>(px - std::floor(px))) {}
  [[nodiscard]] int nearest() const { return fraction < 0.5F ? whole : whole + 1; }
};

struct ViewOffset {
  Offset y;
  Offset x;
};

ViewOffset offset_of(ViewIndex view, ViewIndex center, double focus_px) {
  return {Offset(-focus_px * (view.v - center.v)), Offset(-focus_px * (view.u - center.u))};
}

/// The four rows around a row, interpolated, with the border repeated where columns leave the
/// image: `line` has width + 3 pixels and begins at column `whole` − 1.
template <class T>
void gather_line(ImageView<const T> in, int y, const ViewOffset& offset, std::vector<float>& line) {
  const T* rows[kTaps];
  for (int k = 0; k < kTaps; ++k) {
    rows[k] = in.row(std::clamp(y + offset.y.whole + k - 1, 0, in.height - 1));
  }
  const auto w = cubic_weights(offset.y.fraction);
  const auto value = [&](int i) {
    return w[0] * rows[0][i] + w[1] * rows[1][i] + w[2] * rows[2][i] + w[3] * rows[3][i];
  };
  const int channels = in.channels;
  const int first = offset.x.whole - 1;
  const int count = in.width + kTaps - 1;
  const int begin = std::clamp(-first, 0, count);
  const int end = std::clamp(in.width - first, begin, count);
  for (int i = begin * channels; i < end * channels; ++i) line[i] = value(i + first * channels);
  for (int c = 0; c < channels; ++c) {
    for (int x = 0; x < begin; ++x) line[x * channels + c] = value(c);
    const float last = value((in.width - 1) * channels + c);
    for (int x = end; x < count; ++x) line[x * channels + c] = last;
  }
}

template <class T>
void shear_view(ImageView<const T> in, const ViewOffset& offset, ImageView<T> out) {
  const std::ptrdiff_t channels = in.channels;
  std::vector<float> line(static_cast<std::size_t>(in.width + kTaps - 1) * channels);
  const auto w = cubic_weights(offset.x.fraction);
  for (int y = 0; y < in.height; ++y) {
    gather_line(in, y, offset, line);
    T* target = out.row(y);
    for (int i = 0; i < in.width * channels; ++i) {
      const float* at = line.data() + i;
      target[i] = interpolated_sample<T>(w[0] * at[0] + w[1] * at[channels] +
                                         w[2] * at[2 * channels] + w[3] * at[3 * channels]);
    }
  }
}

/// Where samples of the view are valid: all that are interpolated must be.
void shear_mask(ImageView<const std::uint8_t> in, const ViewOffset& offset,
                ImageView<std::uint8_t> out) {
  const auto taps_of = [](int at, const Offset& by, int extent) {
    const bool is_whole = by.fraction == 0;
    std::array<int, kTaps> taps{};
    for (int k = 0; k < kTaps; ++k) {
      taps[k] = std::clamp(at + by.whole + (is_whole ? 0 : k - 1), 0, extent - 1);
    }
    return taps;
  };
  for (int y = 0; y < in.height; ++y) {
    const std::array<int, kTaps> rows = taps_of(y, offset.y, in.height);
    for (int x = 0; x < in.width; ++x) {
      const std::array<int, kTaps> columns = taps_of(x, offset.x, in.width);
      out.at(y, x) = std::ranges::all_of(rows, [&](int row) {
        return std::ranges::all_of(columns, [&](int column) { return in.at(row, column) != 0; });
      });
    }
  }
}

ViewStack<std::uint8_t> sheared_mask(const LightField& light_field, double focus_px,
                                     const Progress& progress) {
  const ViewStack<std::uint8_t>& in = light_field.valid();
  if (in.empty()) return {};
  ViewStack<std::uint8_t> out(in.grid(), in.height(), in.width());
  parallel_for(in.grid().count(), progress, [&](int i) {
    const ViewIndex view = in.view_at(i);
    shear_mask(in.view(view), offset_of(view, light_field.center(), focus_px), out.view(view));
  });
  return out;
}

void require_in_sight(const LightField& light_field, double focus_px) {
  const GridShape grid = light_field.grid();
  const double reach = std::abs(focus_px) * std::max(grid.v, grid.u) / 2;
  if (reach < std::min(light_field.height(), light_field.width())) return;  // false for NaN
  throw InvalidInput(
      fmt::format("a focus plane of {:g} px moves the outer views out of the image of {}×{} px; "
                  "choose a smaller "
                  "one",
                  focus_px, light_field.width(), light_field.height()));
}

/// Copies the pixels that stand `down` and `right` of those of `out`; where there are none, these
/// stay.
template <class T>
void copy_moved(ImageView<const T> in, int down, int right, ImageView<T> out) {
  for (int y = std::max(0, -down); y < std::min(out.height, in.height - down); ++y) {
    for (int x = std::max(0, -right); x < std::min(out.width, in.width - right); ++x) {
      out.at(y, x) = in.at(y + down, x + right);
    }
  }
}

/// Nearest pixels; 0, which says nothing, where there is none.
template <class T>
Image<T> nearest(ImageView<const T> in, const ViewOffset& offset) {
  Image<T> out(in.height, in.width);
  copy_moved(in, offset.y.nearest(), offset.x.nearest(), out.view());
  return out;
}

/// How maps are moved.
struct Shear {
  ViewIndex center;
  double focus_px;
  const Progress& progress;

  [[nodiscard]] ViewOffset offset(ViewIndex view) const {
    return offset_of(view, center, focus_px);
  }
};

template <class T>
ViewStack<T> nearest(const ViewStack<T>& stack, const Shear& shear) {
  if (stack.empty()) return {};
  ViewStack<T> result(stack.grid(), stack.height(), stack.width(), 1, stack.first());
  parallel_for(stack.grid().count(), shear.progress, [&](int i) {
    const ViewIndex view = stack.view_at(i);
    const Image<T> moved = nearest(stack.view(view), shear.offset(view));
    std::copy_n(moved.data(), moved.size(), result.view(view).data);
  });
  return result;
}

/// Disparity at row y and column x, both moved by `offset`; NaN where there is none.
float disparity_at(const DisparityView& in, int y, int x, const ViewOffset& offset) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const int height = in.disparity.height;
  const int width = in.disparity.width;
  const auto at = [&](int row, int column) {
    const bool is_inside = row >= 0 && row < height && column >= 0 && column < width;
    return is_inside && in.is_valid(row, column) ? in.disparity.at(row, column) : none;
  };
  const int top = y + offset.y.whole;
  const int left = x + offset.x.whole;
  const float fy = offset.y.fraction;
  const float fx = offset.x.fraction;
  // A neighbor without weight need not be there.
  const int bottom = fy > 0 ? top + 1 : top;
  const int right = fx > 0 ? left + 1 : left;
  const float corners[4] = {at(top, left), at(top, right), at(bottom, left), at(bottom, right)};
  const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
  const bool are_there = std::none_of(std::begin(corners), std::end(corners),
                                      [](float each) { return std::isnan(each); });
  if (!are_there || *most - *least > kSameSurface) {
    return at(y + offset.y.nearest(), x + offset.x.nearest());
  }
  return (1 - fy) * ((1 - fx) * corners[0] + fx * corners[1]) +
         fy * ((1 - fx) * corners[2] + fx * corners[3]);
}

Interval moved(const Interval& range, double focus_px) {
  return {range.min - focus_px, range.max - focus_px};
}

/// The camera whose plane of zero disparity is at this disparity of the former.
CameraGrid moved(CameraGrid camera, double focus_px) {
  if (!camera.is_known()) return camera;
  const double depth = camera.depth_from_disparity(focus_px);
  camera.shift += focus_px;
  camera.cam_distance = std::isfinite(depth) ? std::optional<double>(depth) : std::nullopt;
  return camera;
}

LightFieldInfo moved(LightFieldInfo info, double focus_px) {
  info.camera = moved(info.camera, focus_px);
  if (info.disparity_range) info.disparity_range = moved(*info.disparity_range, focus_px);
  info.reading.set_focus(info.reading.focus_px() + focus_px);
  return info;
}

const Image<std::int32_t>* painted_on(ViewIndex view, const Scribbles& scribbles) {
  const auto found = std::ranges::find(scribbles.views, view, &ViewScribbles::view);
  return found == scribbles.views.end() ? nullptr : &found->labels;
}

/// Views painted in either, in the order of the grid.
std::vector<ViewIndex> painted_in(const Scribbles& a, const Scribbles& b) {
  std::vector<ViewIndex> views;
  for (const Scribbles* each : {&a, &b}) {
    for (const ViewScribbles& painted : each->views) views.push_back(painted.view);
  }
  const auto place = [](ViewIndex view) { return std::pair(view.v, view.u); };
  std::ranges::sort(views, {}, place);
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

template <class T>
ViewStack<T> cropped(const ViewStack<T>& stack, const PixelRect& part, const Progress& progress) {
  ViewStack<T> kept(stack.grid(), part.y1 - part.y0, part.x1 - part.x0, stack.channels());
  const std::size_t row_size = static_cast<std::size_t>(kept.width()) * kept.channels();
  parallel_for(kept.grid().count(), progress, [&](int i) {
    const auto from = stack.view(stack.view_at(i));
    const auto to = kept.view(kept.view_at(i));
    for (int y = 0; y < kept.height(); ++y) {
      const T* row = from.row(part.y0 + y) + static_cast<std::size_t>(part.x0) * kept.channels();
      std::copy_n(row, row_size, to.row(y));
    }
  });
  return kept;
}

}  // namespace

LightFieldPtr sheared(const LightField& light_field, double focus_px, const Progress& progress) {
  require_in_sight(light_field, focus_px);
  auto samples = std::visit(
      [&]<class T>(const ViewStack<T>& in) {
        ViewStack<T> out(in.grid(), in.height(), in.width(), in.channels());
        parallel_for(in.grid().count(), progress, [&](int i) {
          const ViewIndex view = in.view_at(i);
          shear_view(in.view(view), offset_of(view, light_field.center(), focus_px),
                     out.view(view));
        });
        return LightField::Samples(std::move(out));
      },
      light_field.samples());
  return std::make_shared<const LightField>(std::move(samples), moved(light_field.info(), focus_px),
                                            sheared_mask(light_field, focus_px, progress));
}

DisparityField sheared(const DisparityField& field, ViewIndex center, double focus_px,
                       const Progress& progress) {
  if (field.empty()) return {};
  const ViewStack<float>& in = field.disparity;
  DisparityField result;
  result.disparity = ViewStack<float>(in.grid(), in.height(), in.width(), 1, in.first());
  result.valid = ViewStack<std::uint8_t>(in.grid(), in.height(), in.width(), 1, in.first());
  parallel_for(in.grid().count(), progress, [&](int i) {
    const ViewIndex view = in.view_at(i);
    const ViewOffset offset = offset_of(view, center, focus_px);
    const DisparityView from = field.view(view);
    const ImageView<float> disparity = result.disparity.view(view);
    const ImageView<std::uint8_t> valid = result.valid.view(view);
    for (int y = 0; y < in.height(); ++y) {
      for (int x = 0; x < in.width(); ++x) {
        const float value = disparity_at(from, y, x, offset);
        const bool is_there = !std::isnan(value);
        valid.at(y, x) = is_there ? 1 : 0;
        disparity.at(y, x) = is_there ? value - static_cast<float>(focus_px) : 0;
      }
    }
  });
  return result;
}

ViewStack<std::int32_t> sheared(const ViewStack<std::int32_t>& labels, ViewIndex center,
                                double focus_px, const Progress& progress) {
  return nearest(labels, {center, focus_px, progress});
}

Scribbles sheared(const Scribbles& scribbles, ViewIndex center, double focus_px) {
  Scribbles result;
  result.labels = scribbles.labels;
  for (const ViewScribbles& each : scribbles.views) {
    result.views.push_back({each.view, nearest(ImageView<const std::int32_t>(each.labels),
                                               offset_of(each.view, center, focus_px))});
  }
  return result;
}

Scribbles unsheared(const Scribbles& scribbles, const Scribbles& before, ViewIndex center,
                    double focus_px) {
  Scribbles result;
  result.labels = scribbles.labels;
  const auto is_known = [&](std::int32_t id) {
    return std::ranges::find(scribbles.labels, id, &LabelInfo::id) != scribbles.labels.end();
  };
  for (const ViewIndex view : painted_in(scribbles, before)) {
    const Image<std::int32_t>* now = painted_on(view, scribbles);
    const Image<std::int32_t>* former = painted_on(view, before);
    const Image<std::int32_t>& any = now ? *now : *former;
    const Image<std::int32_t> bare(any.height(), any.width());
    Image<std::int32_t> put(any.height(), any.width());
    if (former) {
      std::ranges::transform(*former, put.begin(),
                             [&](std::int32_t id) { return is_known(id) ? id : 0; });
    }
    // The view as it was reaches further than the sheared one, and is left as it is there.
    const ViewOffset offset = offset_of(view, center, focus_px);
    copy_moved(now ? now->view() : bare.view(), -offset.y.nearest(), -offset.x.nearest(),
               put.view());
    const bool is_bare = std::ranges::all_of(put, [](std::int32_t id) { return id == 0; });
    if (!is_bare) result.views.push_back({view, std::move(put)});
  }
  return result;
}

Scene sheared(const Scene& scene, double focus_px, const Progress& progress) {
  const ViewIndex center = scene.light_field->center();
  const Progress rest = progress.part(0.7, 1);
  Scene result;
  result.light_field = sheared(*scene.light_field, focus_px, progress.part(0, 0.7));
  auto truth = std::make_shared<GroundTruth>();
  truth->field = sheared(scene.truth->field, center, focus_px, rest);
  truth->foreground = sheared(scene.truth->foreground, center, focus_px, rest);
  truth->background = sheared(scene.truth->background, center, focus_px, rest);
  truth->labels = sheared(scene.truth->labels, center, focus_px, rest);
  truth->regions = scene.truth->regions;  // of the center view, which stays
  truth->high_res = shifted(scene.truth->high_res, static_cast<float>(-focus_px));
  truth->stratified = scene.truth->stratified;
  truth->estimated = scene.truth->estimated;
  result.truth = std::move(truth);
  result.scribbles = sheared(scene.scribbles, center, focus_px);
  result.convention = scene.convention;
  result.convention.focus_px += focus_px;
  return result;
}

Estimate sheared(const Estimate& estimate, const ShearedInto& into, double focus_px,
                 const Progress& progress) {
  const Shear shear{into.center, focus_px, progress};
  const auto field = [&](const DisparityField& each) {
    return sheared(each, into.center, focus_px, progress);
  };
  Estimate result;
  result.field = field(estimate.field);
  result.confidence = nearest(estimate.confidence, shear);
  result.layered.foreground = field(estimate.layered.foreground);
  result.layered.background = field(estimate.layered.background);
  result.layered.layers = nearest(estimate.layered.layers, shear);
  result.second = field(estimate.second);
  result.set_provenance(estimate.provenance());
  for (auto& [key, value] : result.parameters) {
    auto* range = std::get_if<IntervalOrAuto>(&value);
    if (key == "range" && range && *range) *range = moved(**range, focus_px);
  }
  if (estimate.range.length() > 0) result.range = moved(estimate.range, focus_px);
  result.camera = moved(estimate.camera, focus_px);
  result.source_hash = into.sample_hash;
  result.reading.set_focus(estimate.reading.focus_px() + focus_px);
  result.notes.push_back(
      fmt::format("moved to a focus plane of {:.4g} px after it was estimated", focus_px));
  return result;
}

LightField cropped(const LightField& lf, const PixelRect& part, const Progress& progress) {
  assert(!part.empty() && part.y0 >= 0 && part.x0 >= 0 && part.y1 <= lf.height() &&
         part.x1 <= lf.width());
  LightFieldInfo info = lf.info();
  if (info.camera.pinhole) {
    info.camera.pinhole->center_y -= part.y0;
    info.camera.pinhole->center_x -= part.x0;
  }
  auto samples = std::visit(
      [&](const auto& stack) -> LightField::Samples {
        return cropped(stack, part, progress.part(0, 0.9));
      },
      lf.samples());
  ViewStack<std::uint8_t> valid;
  if (!lf.valid().empty()) valid = cropped(lf.valid(), part, progress.part(0.9, 1));
  return {std::move(samples), std::move(info), std::move(valid)};
}

}  // namespace episcope
