// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/render/shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace episcope::render {
namespace {

/// How one view is sampled: at (x + dx + fraction_x, y + dy + fraction_y).
struct Shift {
  ViewIndex view;
  int dx = 0;
  int dy = 0;
  float fraction_x = 0;
  float fraction_y = 0;
};

bool shows_something(const LightField& light_field, ViewIndex view) {
  if (light_field.valid().empty()) return true;
  const auto* const valid = light_field.valid_of(view).data;
  return std::any_of(valid, valid + light_field.valid().view_size(),
                     [](std::uint8_t pixel) { return pixel != 0; });
}

// Of the views that show something, or of `view` alone.
std::vector<Shift> shifts_of(const LightField& light_field, ViewIndex view, double focus_px) {
  const GridShape grid = light_field.grid();
  std::vector<Shift> shifts;
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; ++u) {
      if (!shows_something(light_field, {v, u}) && !(ViewIndex{v, u} == view)) continue;
      const double x = -focus_px * (u - view.u);
      const double y = -focus_px * (v - view.v);
      shifts.push_back({{v, u},
                        static_cast<int>(std::floor(x)),
                        static_cast<int>(std::floor(y)),
                        static_cast<float>(x - std::floor(x)),
                        static_cast<float>(y - std::floor(y))});
    }
  }
  return shifts;
}

/// Arithmetic of a sample type: 8-bit samples are summed as integers, with weights that add up to
/// 256, which fits sixteen lanes where float fits four.
template <class T>
struct Arithmetic {
  using Weight = float;
  using Sum = float;
  static constexpr float kOne = 1;
};
template <>
struct Arithmetic<std::uint8_t> {
  using Weight = std::uint16_t;
  using Sum = std::uint32_t;
  static constexpr float kOne = 256;
};

/// Weights of the four neighbours: upper left, upper right, lower left, lower right.
template <class T>
struct Weights {
  typename Arithmetic<T>::Weight w[4];

  explicit Weights(const Shift& shift) {
    constexpr float one = Arithmetic<T>::kOne;
    float exact[4] = {
        (1 - shift.fraction_x) * (1 - shift.fraction_y), shift.fraction_x * (1 - shift.fraction_y),
        (1 - shift.fraction_x) * shift.fraction_y, shift.fraction_x * shift.fraction_y};
    if constexpr (std::is_integral_v<typename Arithmetic<T>::Weight>) {
      int rest = static_cast<int>(one);
      for (int i = 3; i > 0; --i) {
        w[i] = static_cast<std::uint16_t>(std::lround(exact[i] * one));
        rest -= w[i];
      }
      w[0] = static_cast<std::uint16_t>(std::max(rest, 0));
    } else {
      std::copy(std::begin(exact), std::end(exact), w);
    }
  }
};

/// Adds `count` interpolated samples. `upper` and `lower` are two rows at the left neighbour.
template <class T>
void add_samples(const T* upper, const T* lower, int count, int channels, const Weights<T>& weights,
                 typename Arithmetic<T>::Sum* sum) {
  using Weight = typename Arithmetic<T>::Weight;
  const auto [w0, w1, w2, w3] = weights.w;
  for (int i = 0; i < count; ++i) {
    // At most 255 · 256: the conversion keeps the products 16 bits wide.
    sum[i] += static_cast<Weight>(w0 * upper[i] + w1 * upper[i + channels] + w2 * lower[i] +
                                  w3 * lower[i + channels]);
  }
}

template <class T>
void add_row(ImageView<const T> view, int y, const Shift& shift, const Weights<T>& weights,
             typename Arithmetic<T>::Sum* sum) {
  const int c = view.channels;
  const T* upper = view.row(std::clamp(y + shift.dy, 0, view.height - 1));
  const T* lower = view.row(std::clamp(y + shift.dy + 1, 0, view.height - 1));
  const int begin = std::clamp(-shift.dx, 0, view.width);
  const int end = std::clamp(view.width - 1 - shift.dx, begin, view.width);
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(begin + shift.dx) * c;
  if (end > begin) {
    add_samples(upper + offset, lower + offset, (end - begin) * c, c, weights, sum + begin * c);
  }
  const auto add_border = [&](int x) {
    const int left = std::clamp(x + shift.dx, 0, view.width - 1) * c;
    const int right = std::clamp(x + shift.dx + 1, 0, view.width - 1) * c;
    for (int k = 0; k < c; ++k) {
      sum[x * c + k] += static_cast<typename Arithmetic<T>::Weight>(
          weights.w[0] * upper[left + k] + weights.w[1] * upper[right + k] +
          weights.w[2] * lower[left + k] + weights.w[3] * lower[right + k]);
    }
  };
  for (int x = 0; x < begin; ++x) add_border(x);
  for (int x = end; x < view.width; ++x) add_border(x);
}

template <class T>
float largest_sample() {
  if constexpr (std::is_integral_v<T>) return std::numeric_limits<T>::max();
  return 1;
}

template <class T>
Image<float> mean_of_views(const ViewStack<T>& stack, const std::vector<Shift>& shifts) {
  Image<float> mean(stack.height(), stack.width(), stack.channels());
  std::vector<Weights<T>> weights;
  for (const auto& shift : shifts) weights.emplace_back(shift);
  std::vector<typename Arithmetic<T>::Sum> sum(static_cast<std::size_t>(stack.width()) *
                                               stack.channels());
  const float scale = 1 / (Arithmetic<T>::kOne * largest_sample<T>() * shifts.size());
  for (int y = 0; y < stack.height(); ++y) {
    std::fill(sum.begin(), sum.end(), 0);
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      add_row(stack.view(shifts[i].view), y, shifts[i], weights[i], sum.data());
    }
    std::transform(sum.begin(), sum.end(), mean.row(y),
                   [scale](auto total) { return static_cast<float>(total) * scale; });
  }
  return mean;
}

}  // namespace

Image<float> refocus(const LightField& light_field, ViewIndex view, double focus_px) {
  if (!light_field.grid().contains(view)) {
    throw InvalidInput(fmt::format("view {},{} lies outside the grid of {}×{} views", view.v,
                                   view.u, light_field.grid().v, light_field.grid().u));
  }
  const auto shifts = shifts_of(light_field, view, focus_px);
  return std::visit([&](const auto& stack) { return mean_of_views(stack, shifts); },
                    light_field.samples());
}

}  // namespace episcope::render
