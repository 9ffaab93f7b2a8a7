// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/unknown_zeros.h"

#include "engine/io/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr std::ptrdiff_t kFewest = 30;
constexpr double kMostShare = 0.9;
/// Values next to zero, within this part of the farthest, are next to none: else zero is one of
/// them.
constexpr double kGap = 0.05;
constexpr double kFewInGap = 0.1;  ///< Of the zeros.
/// Zeros are contradicted if the error there is so many times that of the others.
constexpr double kContradicted = 2;

Image<std::uint8_t> zeros_of(const DisparityView& map, float zero) {
  const ImageView<const float>& values = map.disparity;
  Image<std::uint8_t> zeros(values.height, values.width);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      zeros.at(y, x) = map.is_valid(y, x) && values.at(y, x) == zero ? 1 : 0;
    }
  }
  return zeros;
}

Image<std::uint8_t> others_of(const DisparityView& map, const Image<std::uint8_t>& zeros) {
  Image<std::uint8_t> others(zeros.height(), zeros.width());
  for (int y = 0; y < zeros.height(); ++y) {
    for (int x = 0; x < zeros.width(); ++x) {
      others.at(y, x) = map.is_valid(y, x) && zeros.at(y, x) == 0 ? 1 : 0;
    }
  }
  return others;
}

/// Whether hardly any other value lies near zero.
bool stands_apart(const DisparityView& map, float zero, std::ptrdiff_t zeros) {
  std::vector<float> distances;
  const ImageView<const float>& values = map.disparity;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      if (!map.is_valid(y, x) || values.at(y, x) == zero) continue;
      distances.push_back(std::abs(values.at(y, x) - zero));
    }
  }
  if (distances.empty()) return false;
  const double gap = kGap * *std::ranges::max_element(distances);
  const auto near =
      std::ranges::count_if(distances, [&](float distance) { return distance < gap; });
  return static_cast<double>(near) < kFewInGap * static_cast<double>(zeros);
}

void mark(DisparityField& field, float zero) {
  if (field.valid.empty()) {
    const ViewStack<float>& like = field.disparity;
    field.valid =
        ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{1});
  }
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    if (field.disparity.data()[i] == zero) field.valid.data()[i] = 0;
  }
}

}  // namespace

std::string drop_unknown_zeros(const LightField::Samples& samples, ViewIndex at, float zero,
                               DisparityField& field) {
  const DisparityView map = field.view(at);
  const Image<std::uint8_t> zeros = zeros_of(map, zero);
  const auto count = std::count(zeros.begin(), zeros.end(), std::uint8_t{1});
  const auto all = static_cast<double>(zeros.size());
  if (count < kFewest || static_cast<double>(count) > kMostShare * all) return {};
  if (!stands_apart(map, zero, count)) return {};
  const Image<std::uint8_t> others = others_of(map, zeros);
  const double there = warp_errors(samples, at, {map.disparity, zeros.view()}).best();
  const double elsewhere = warp_errors(samples, at, {map.disparity, others.view()}).best();
  if (!(there > kContradicted * elsewhere)) return {};
  mark(field, zero);
  return fmt::format(
      " is 0 at {:.3g} % of its pixels, which the views contradict (grey error {:.2f} there, "
      "{:.2f} "
      "elsewhere): no disparity is known there.",
      100 * static_cast<double>(count) / all, there, elsewhere);
}

}  // namespace episcope::io
