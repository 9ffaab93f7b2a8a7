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
/// Zeros are a spike if so many times as many pixels have them as any value nearby.
constexpr std::ptrdiff_t kSpike = 8;
constexpr std::ptrdiff_t kFewestFilled = 200;
/// They are contradicted if what lies around them explains the views by so much better; if it
/// explains them by so much worse, they are right.
constexpr double kFilledBetter = 0.93;
constexpr double kLeastDifference = 0.3;  ///< Grey levels.
constexpr double kAlike = 0.2;            ///< px between both: then neither matters.
/// Values are contradicted if the error there is so many times that of the others.
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

/// Other values than the one that so many pixels have, near it.
struct Nearby {
  std::ptrdiff_t pixels = 0;
  std::ptrdiff_t most = 0;  ///< Pixels that have the same one.
};

std::optional<Nearby> values_near(const DisparityView& map, float value) {
  std::vector<float> distances;
  const ImageView<const float>& values = map.disparity;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      if (!map.is_valid(y, x) || values.at(y, x) == value) continue;
      distances.push_back(std::abs(values.at(y, x) - value));
    }
  }
  if (distances.empty()) return std::nullopt;
  const double gap = kGap * *std::ranges::max_element(distances);
  std::erase_if(distances, [=](float distance) { return distance >= gap; });
  std::ranges::sort(distances);
  Nearby near{std::ssize(distances), 0};
  for (auto i = distances.begin(); i != distances.end();) {
    const auto next = std::upper_bound(i, distances.end(), *i);
    near.most = std::max(near.most, next - i);
    i = next;
  }
  return near;
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

/// A map in px, the pixels that may be unknown, and the others.
struct Doubtful {
  const LightField::Samples& samples;
  ViewIndex at;
  const Image<float>& disparity;
  const Image<std::uint8_t>& pixels;
  const Image<std::uint8_t>& others;
};

struct Verdict {
  bool is_wrong = false;
  std::string evidence;  ///< Empty if the value is as good as others.

  [[nodiscard]] std::string sentence(float stored, double percent) const {
    if (evidence.empty()) return {};
    const std::string is = fmt::format(" is {:.7g} at {:.3g} % of its pixels, ", stored, percent);
    if (is_wrong) {
      return is + "which the views contradict (" + evidence + "): no disparity is known there.";
    }
    return is +
           "and hardly anywhere nearly so: whether that stands for unknown, the views do not "
           "tell (" +
           evidence + ").";
  }
};

/// Whether the views contradict the value more than the others.
Verdict compare_with_others(const Doubtful& map, float stored) {
  const WarpErrors there =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.pixels.view()});
  const WarpErrors elsewhere =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.others.view()});
  const double error = error_as_of(there, elsewhere);
  const bool helps = stored != 0 && error < kAsUnwarped * there.unwarped();
  if (!(error > kContradicted * elsewhere.best()) || helps) return {};
  return {true, std::isfinite(error) ? fmt::format("grey error {:.2f} there, {:.2f} elsewhere",
                                                   error, elsewhere.best())
                                     : "it leads out of the picture"};
}

/// The map with those pixels as the last of the others before them, row by row, from either end.
Image<float> filled(const Doubtful& map, bool from_end) {
  Image<float> values = map.disparity;
  const std::size_t all = values.size();
  const auto place = [&](std::size_t i) { return from_end ? all - 1 - i : i; };
  std::size_t first = 0;
  while (first < all && map.others.data()[place(first)] == 0) ++first;
  if (first == all) return values;
  float last = values.data()[place(first)];
  for (std::size_t i = 0; i < all; ++i) {
    float& value = values.data()[place(i)];
    if (map.others.data()[place(i)] != 0) last = value;
    value = last;
  }
  return values;
}

/// How well these values explain those pixels, and how far they are from the doubtful ones.
struct Filling {
  double error = 0;
  double distance = 0;  ///< Mean, in px.
};

Filling filling_from(const Doubtful& map, bool from_end, const WarpErrors& elsewhere) {
  const Image<float> values = filled(map, from_end);
  Filling filling;
  double pixels = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (map.pixels.data()[i] == 0) continue;
    filling.distance += std::abs(values.data()[i] - map.disparity.data()[i]);
    pixels += 1;
  }
  filling.distance /= pixels;
  filling.error =
      error_as_of(warp_errors(map.samples, map.at, {values.view(), map.pixels.view()}), elsewhere);
  return filling;
}

/// Whether values of the surroundings explain those pixels better, whatever the noise.
Verdict compare_with_filled(const Doubtful& map) {
  const WarpErrors elsewhere =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.others.view()});
  const WarpErrors there =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.pixels.view()});
  const double error = error_as_of(there, elsewhere);
  const Filling around = std::ranges::min(filling_from(map, false, elsewhere),
                                          filling_from(map, true, elsewhere), {}, &Filling::error);
  if (around.distance < kAlike || error < kFilledBetter * around.error) return {};
  const bool is_wrong =
      around.error < kFilledBetter * error && error - around.error > kLeastDifference;
  return {is_wrong, fmt::format("grey error {:.2f} there, {:.2f} with the values around", error,
                                around.error)};
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
  const auto near = values_near(map, unknown.value);
  if (!near) return {};
  const bool is_apart = static_cast<double>(near->pixels) < kFewInGap * static_cast<double>(count);
  const bool is_spike = unknown.stored == 0 && count >= kFewestFilled &&
                        count > kSpike * std::max<std::ptrdiff_t>(near->most, 1);
  if (!is_apart && !is_spike) return {};
  const Image<std::uint8_t> others = valid_without(map, unknown.value);
  const Image<float> disparity = scaled(map.disparity, unknown.factor);
  const Doubtful doubtful{samples, at, disparity, pixels, others};
  Verdict verdict;
  if (is_apart) verdict = compare_with_others(doubtful, unknown.stored);
  if (is_spike && !verdict.is_wrong) verdict = compare_with_filled(doubtful);
  if (verdict.is_wrong) mark(field, unknown.value);
  return verdict.sentence(unknown.stored, 100 * static_cast<double>(count) / all);
}

}  // namespace episcope::io
