// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/unknown_value.h"

#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace episcope::io {
namespace {

constexpr std::ptrdiff_t kFewest = 30;
constexpr double kMostShare = 0.9;
/// Values next to the unknown one, within this part of the farthest, are next to none: else it
/// is one of them.
constexpr double kGap = 0.05;
constexpr double kFewInGap = 0.1;  ///< Of the pixels with the unknown value.
/// They are contradicted if the error there is so many times that of the others.
constexpr double kContradicted = 2;
/// Other values than 0 may be those of a surface that matches badly, but better than unwarped.
constexpr double kAsUnwarped = 0.9;

Image<std::uint8_t> pixels_of(const DisparityView& map, float value) {
  const ImageView<const float>& values = map.disparity;
  Image<std::uint8_t> pixels(values.height, values.width);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      pixels.at(y, x) = map.is_valid(y, x) && values.at(y, x) == value ? 1 : 0;
    }
  }
  return pixels;
}

/// Whether hardly any other value lies near the one that so many pixels have.
bool stands_apart(const DisparityView& map, float value, std::ptrdiff_t pixels) {
  std::vector<float> distances;
  const ImageView<const float>& values = map.disparity;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      if (!map.is_valid(y, x) || values.at(y, x) == value) continue;
      distances.push_back(std::abs(values.at(y, x) - value));
    }
  }
  if (distances.empty()) return false;
  const double gap = kGap * *std::ranges::max_element(distances);
  const auto near =
      std::ranges::count_if(distances, [&](float distance) { return distance < gap; });
  return static_cast<double>(near) < kFewInGap * static_cast<double>(pixels);
}

void mark(DisparityField& field, float value) {
  if (field.valid.empty()) {
    const ViewStack<float>& like = field.disparity;
    field.valid =
        ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{1});
  }
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    if (field.disparity.data()[i] == value) field.valid.data()[i] = 0;
  }
}

std::ptrdiff_t count_of(const DisparityView& map, float value) {
  const Image<std::uint8_t> pixels = pixels_of(map, value);
  return std::count(pixels.begin(), pixels.end(), std::uint8_t{1});
}

Image<float> scaled(const ImageView<const float>& map, double factor) {
  Image<float> out(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    std::transform(map.row(y), map.row(y) + map.width, out.row(y),
                   [&](float value) { return static_cast<float>(factor * value); });
  }
  return out;
}

/// With the orders of views in which others fit better; infinite if nothing was compared.
double error_as_of(const WarpErrors& errors, const WarpErrors& others) {
  const auto pixels = static_cast<double>(errors.u.pixels + errors.v.pixels);
  if (pixels == 0) return std::numeric_limits<double>::infinity();
  const auto sum = [](const AxisErrors& axis, const AxisErrors& other) {
    return (other.says_reversed() ? axis.reversed : axis.forward) *
           static_cast<double>(axis.pixels);
  };
  return (sum(errors.u, others.u) + sum(errors.v, others.v)) / pixels;
}

}  // namespace

std::vector<float> possible_unknown_values(const DisparityView& map) {
  std::vector<float> values{0, -1};
  std::optional<float> smallest, largest;
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      if (!map.is_valid(y, x)) continue;
      const float value = map.disparity.at(y, x);
      smallest = std::min(smallest.value_or(value), value);
      largest = std::max(largest.value_or(value), value);
    }
  }
  for (const std::optional<float>& extreme : {largest, smallest}) {
    if (extreme && *extreme != 0 && *extreme != -1) values.push_back(*extreme);
  }
  std::erase_if(values, [&](float value) { return count_of(map, value) < kFewest; });
  return values;
}

Image<std::uint8_t> valid_without(const DisparityView& map, float value) {
  Image<std::uint8_t> valid(map.disparity.height, map.disparity.width);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      valid.at(y, x) = map.is_valid(y, x) && map.disparity.at(y, x) != value ? 1 : 0;
    }
  }
  return valid;
}

std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                               const UnknownValue& unknown, DisparityField& field) {
  const DisparityView map = field.view(at);
  const Image<std::uint8_t> pixels = pixels_of(map, unknown.value);
  const auto count = std::count(pixels.begin(), pixels.end(), std::uint8_t{1});
  const auto all = static_cast<double>(pixels.size());
  if (count < kFewest || static_cast<double>(count) > kMostShare * all) return {};
  if (!stands_apart(map, unknown.value, count)) return {};
  const Image<std::uint8_t> others = valid_without(map, unknown.value);
  const Image<float> disparity = scaled(map.disparity, unknown.factor);
  const WarpErrors there = warp_errors(samples, at, {disparity.view(), pixels.view()});
  const WarpErrors elsewhere = warp_errors(samples, at, {disparity.view(), others.view()});
  const double error = error_as_of(there, elsewhere);
  const bool helps = unknown.stored != 0 && error < kAsUnwarped * there.unwarped();
  if (!(error > kContradicted * elsewhere.best()) || helps) return {};
  mark(field, unknown.value);
  const std::string evidence =
      std::isfinite(error)
          ? fmt::format("grey error {:.2f} there, {:.2f} elsewhere", error, elsewhere.best())
          : "it leads out of the picture";
  return fmt::format(
      " is {:.7g} at {:.3g} % of its pixels, which the views contradict ({}): no disparity is "
      "known there.",
      unknown.stored, 100 * static_cast<double>(count) / all, evidence);
}

}  // namespace episcope::io
