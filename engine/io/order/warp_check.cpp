// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/warp_check.h"

#include "engine/io/order/pair_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace episcope::io {
namespace {

float sample(const Image<float>& image, double y, double x) {
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width() - 1);
  const int y1 = std::min(y0 + 1, image.height() - 1);
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  const float top = image.at(y0, x0) + fx * (image.at(y0, x1) - image.at(y0, x0));
  const float bottom = image.at(y1, x0) + fx * (image.at(y1, x1) - image.at(y1, x0));
  return top + fy * (bottom - top);
}

/// The value that counts as white: of 16-bit samples what as many bits hold as the view at the
/// centre uses, since cameras give 10, 12 or 14 of them.
template <class T>
float white_of(const ViewStack<T>& stack) {
  if constexpr (std::is_same_v<T, float>) return 1;
  if constexpr (std::is_same_v<T, std::uint8_t>) return 255;
  constexpr std::size_t kStride = 7;
  const auto center = stack.view(stack.grid().center());
  std::size_t largest = 0;
  for (std::size_t i = 0; i < center.size(); i += kStride) {
    largest = std::max(largest, static_cast<std::size_t>(center.data[i]));
  }
  std::size_t white = 255;
  while (white < largest) white = 2 * white + 1;
  return static_cast<float>(white);
}

/// A view, and one next to it along an axis.
struct ViewPair {
  const Image<float>& center;
  const Image<float>& neighbour;
  bool is_u;
  int step;  ///< +1 or −1.
};

/// Grey levels at a pixel, and where it is by each assumption.
struct Moved {
  float here;
  float forward;
  float reversed;
  float unwarped;
};

/// Of every `stride`-th pixel whose targets lie inside the image.
template <class Visit>
void for_moved(const ViewPair& pair, const DisparityView& disparity, int stride,
               const Visit& visit) {
  const int width = pair.center.width();
  const int height = pair.center.height();
  for (int y = 0; y < height; y += stride) {
    for (int x = 0; x < width; x += stride) {
      if (!disparity.is_valid(y, x)) continue;
      const double shift = pair.step * static_cast<double>(disparity.disparity.at(y, x));
      const double place = pair.is_u ? x : y;
      const double last = (pair.is_u ? width : height) - 1;
      if (place - std::abs(shift) < 0 || place + std::abs(shift) > last) continue;
      const auto moved = [&](double by) {
        return pair.is_u ? sample(pair.neighbour, y, x - by) : sample(pair.neighbour, y - by, x);
      };
      visit(Moved{pair.center.at(y, x), moved(shift), moved(-shift), pair.neighbour.at(y, x)});
    }
  }
}

/// Adds the errors against the neighbour, of which brightness is evened out.
void add_neighbour(const ViewPair& pair, const DisparityView& disparity, AxisErrors& sums) {
  constexpr int kGainStride = 3;
  PairGain forward, reversed, unwarped;
  for_moved(pair, disparity, kGainStride, [&](const Moved& moved) {
    forward.add(moved.here, moved.forward);
    reversed.add(moved.here, moved.reversed);
    unwarped.add(moved.here, moved.unwarped);
  });
  const float of_forward = forward.value();
  const float of_reversed = reversed.value();
  const float of_unwarped = unwarped.value();
  for_moved(pair, disparity, 1, [&](const Moved& moved) {
    sums.forward += std::abs(moved.here - of_forward * moved.forward);
    sums.reversed += std::abs(moved.here - of_reversed * moved.reversed);
    sums.unwarped += std::abs(moved.here - of_unwarped * moved.unwarped);
    ++sums.pixels;
  });
}

AxisErrors axis_errors(const LightField::Samples& samples, ViewIndex at, bool is_u,
                       const DisparityView& disparity) {
  const GridShape grid = grid_of(samples);
  const Image<float> center = grey_levels(samples, at);
  AxisErrors errors;
  for (const int step : {-1, 1}) {
    const ViewIndex next = is_u ? ViewIndex{at.v, at.u + step} : ViewIndex{at.v + step, at.u};
    if (!grid.contains(next)) continue;
    const Image<float> neighbour = grey_levels(samples, next);
    add_neighbour({center, neighbour, is_u, step}, disparity, errors);
  }
  if (errors.pixels > 0) {
    errors.forward /= static_cast<double>(errors.pixels);
    errors.reversed /= static_cast<double>(errors.pixels);
    errors.unwarped /= static_cast<double>(errors.pixels);
  }
  return errors;
}

/// Sums of the channels of a row.
template <class T>
void add_channels(const T* samples, int width, int channels, float* sums) {
  for (int x = 0; x < width; ++x) {
    const T* const pixel = samples + static_cast<std::ptrdiff_t>(x) * channels;
    sums[x] = 0;
    for (int c = 0; c < channels; ++c) sums[x] += static_cast<float>(pixel[c]);
  }
}

/// The same of floats: one that is not finite counts as the last before it that is.
void add_channels(const float* samples, int width, int channels, float* sums) {
  std::array<float, 4> last{};
  for (int x = 0; x < width; ++x) {
    sums[x] = 0;
    for (int c = 0; c < channels; ++c) {
      const float value = samples[static_cast<std::ptrdiff_t>(x) * channels + c];
      float& kept = last[static_cast<std::size_t>(c)];
      if (std::isfinite(value)) kept = value;
      sums[x] += kept;
    }
  }
}

}  // namespace

bool AxisErrors::is_decided() const {
  const double difference = std::abs(forward - reversed);
  return pixels > 0 && difference > 0.02 && difference > 0.03 * std::min(forward, reversed);
}

bool AxisErrors::is_poor() const {
  if (pixels == 0) return false;
  const double best = std::min(forward, reversed);
  const double other = std::max(forward, reversed);
  if (is_decided()) return best > 0.9 * std::min(other, unwarped);
  return best > 1.1 * unwarped + 0.5;
}

double WarpErrors::best() const {
  if (u.pixels + v.pixels == 0) return std::numeric_limits<double>::infinity();
  const double sum = std::min(u.forward, u.reversed) * static_cast<double>(u.pixels) +
                     std::min(v.forward, v.reversed) * static_cast<double>(v.pixels);
  return sum / static_cast<double>(u.pixels + v.pixels);
}

double WarpErrors::unwarped() const {
  const auto pixels = static_cast<double>(u.pixels + v.pixels);
  if (pixels == 0) return 0;
  return (u.unwarped * static_cast<double>(u.pixels) + v.unwarped * static_cast<double>(v.pixels)) /
         pixels;
}

Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view) {
  const PixelRect all = std::visit(
      [](const auto& stack) {
        return PixelRect{0, 0, stack.height(), stack.width()};
      },
      samples);
  return grey_levels(samples, view, all);
}

Image<float> grey_levels(const LightField::Samples& samples, ViewIndex view,
                         const PixelRect& part) {
  return std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        const auto image = stack.view(view);
        const float scale = 255.0F / white_of(stack) / static_cast<float>(image.channels);
        Image<float> grey(part.y1 - part.y0, part.x1 - part.x0);
        for (int y = 0; y < grey.height(); ++y) {
          const T* const row = image.row(part.y0 + y) + part.x0 * image.channels;
          add_channels(row, grey.width(), image.channels, grey.row(y));
          for (int x = 0; x < grey.width(); ++x) grey.row(y)[x] *= scale;
        }
        return grey;
      },
      samples);
}

WarpErrors warp_errors(const LightField::Samples& samples, ViewIndex at,
                       const DisparityView& disparity) {
  return {axis_errors(samples, at, true, disparity), axis_errors(samples, at, false, disparity)};
}

}  // namespace episcope::io
