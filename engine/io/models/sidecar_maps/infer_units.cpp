// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/infer_units.h"

#include "engine/io/models/order/warp_check.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace episcope::io {
namespace {

constexpr std::ptrdiff_t kFewestUnknown = 30;
constexpr double kMostShare = 0.9;
/// Values next to the unknown one, within this part of the farthest, are next to none: else it
/// is one of them.
constexpr double kGapAroundUnknown = 0.05;
constexpr double kFewInGap = 0.1;  ///< Of the pixels with the unknown value.
/// Values are contradicted if their error is so many times the error of the others.
constexpr double kContradicted = 2;
/// Values other than 0 may belong to a surface that matches badly, but better than unwarped.
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

/// Pixels of other values that are near it; nothing if there is no other value.
std::optional<std::ptrdiff_t> pixels_near(const DisparityView& map, float value) {
  std::vector<float> distances;
  const ImageView<const float>& values = map.disparity;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      if (!map.is_valid(y, x) || values.at(y, x) == value) continue;
      distances.push_back(std::abs(values.at(y, x) - value));
    }
  }
  if (distances.empty()) return std::nullopt;
  const double gap = kGapAroundUnknown * *std::ranges::max_element(distances);
  return std::ranges::count_if(distances, [=](float distance) { return distance < gap; });
}

void mark(DisparityField& field, float value) {
  field.require_mask();
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

/// 1 where the map is valid and has another value, `[y][x]`.
Image<std::uint8_t> valid_without(const DisparityView& map, float value) {
  Image<std::uint8_t> valid(map.disparity.height, map.disparity.width);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      valid.at(y, x) = map.is_valid(y, x) && map.disparity.at(y, x) != value ? 1 : 0;
    }
  }
  return valid;
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
  std::erase_if(values, [&](float value) { return count_of(map, value) < kFewestUnknown; });
  return values;
}

std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                               const UnknownValue& unknown, DisparityField& field) {
  const DisparityView map = field.view(at);
  const Image<std::uint8_t> pixels = pixels_of(map, unknown.value);
  const auto count = std::count(pixels.begin(), pixels.end(), std::uint8_t{1});
  const auto all = static_cast<double>(pixels.size());
  if (count < kFewestUnknown || static_cast<double>(count) > kMostShare * all) return {};
  const auto near = pixels_near(map, unknown.value);
  if (!near || static_cast<double>(*near) >= kFewInGap * static_cast<double>(count)) return {};
  const Image<std::uint8_t> others = valid_without(map, unknown.value);
  const Image<float> disparity = scaled(map.disparity, unknown.factor);
  const WarpErrors there = warp_errors(samples, at, {disparity.view(), pixels.view()});
  const WarpErrors elsewhere = warp_errors(samples, at, {disparity.view(), others.view()});
  const double error = error_as_of(there, elsewhere);
  const bool helps = unknown.value != 0 && error < kAsUnwarped * there.unwarped();
  if (!(error > kContradicted * elsewhere.best()) || helps) return {};
  mark(field, unknown.value);
  return fmt::format(
      " is {:.7g} at {:.3g} % of its pixels, which the views contradict ({}): no disparity is "
      "known there.",
      unknown.value, 100 * static_cast<double>(count) / all,
      std::isfinite(error)
          ? fmt::format("grey error {:.2f} there, {:.2f} elsewhere", error, elsewhere.best())
          : "it leads out of the picture");
}

namespace {

/// A map that explains views this well, as a share of the error without warping, is upright.
constexpr double kPlainMap = 0.5;
/// Largest share of the error that a turned map may leave: maps as they are stored may explain
/// views not much worse than turned ones, which are wrong then.
constexpr double kFarBetterReading = 0.6;

bool is_plain(const Explanation& explanation) {
  // Shifts out of the picture leave nothing to compare.
  return explanation.unwarped > 0 && explanation.error <= kPlainMap * explanation.unwarped;
}

/// Before near and far are judged, which mirrored maps would get wrong.
void put_upright(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                 ViewIndex at, DisparityField& field, ConventionReport& report) {
  const DisparityView map = field.view(at);
  const Explanation stored = settle_unit(samples, at, map, units).explanation;
  if (is_plain(stored)) return;
  double least =
      kFarBetterReading * (stored.unwarped > 0 ? std::min(stored.error, stored.unwarped) : 0);
  std::optional<MapTurn> found;
  for (const MapTurn& turn : possible_turns(map.disparity.height, map.disparity.width)) {
    const DisparityField turned = turned_back(map, turn);
    const double error = settle_unit(samples, at, turned.view({}), units).explanation.error;
    if (error >= least) continue;
    least = error;
    found = turn;
  }
  if (!found) return;
  field = turned_back(field, *found);
  report.warnings.push_back(turned_back_text(found->text));
}

}  // namespace

ViewIndex NamedValues::at(GridShape grid) const {
  return field.contains(grid.center()) ? grid.center() : field.disparity.first();
}

void scale_values(DisparityField& field, double factor) {
  if (factor == 1) return;
  std::for_each(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                [&](float& value) { value = static_cast<float>(factor * value); });
}

SettledUnit infer_units(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                        NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  put_upright(samples, units, at, values.field, report);
  SettledUnit settled = settle_unit(samples, at, values.field.view(at), units);
  for (const float value : possible_unknown_values(values.field.view(at))) {
    const std::string text =
        drop_unknown_value(samples, at, {value, settled.unit.factor}, values.field);
    if (!text.empty()) report.warnings.push_back(values.name + text);
  }
  return settled;
}

}  // namespace episcope::io
