// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/map_reading.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace episcope::io {

float value_by(const DisparityView& map, const MapReading& reading, const MapTarget& target, int y,
               int x) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const int border = reading.border_px;
  if (y < border || x < border || y >= target.height - border || x >= target.width - border) {
    return kNone;
  }
  int row = y - border - reading.down_px + target.above;
  int column = x - border - reading.right_px + target.left;
  const int height = reading.is_transposed ? map.disparity.width : map.disparity.height;
  const int width = reading.is_transposed ? map.disparity.height : map.disparity.width;
  if (reading.is_resized) {
    row = static_cast<int>((2LL * row + 1) * height / (2LL * target.height));
    column = static_cast<int>((2LL * column + 1) * width / (2LL * target.width));
  }
  if (reading.flip == MapFlip::Y || reading.flip == MapFlip::Both) row = height - 1 - row;
  if (reading.flip == MapFlip::X || reading.flip == MapFlip::Both) column = width - 1 - column;
  if (reading.is_transposed) std::swap(row, column);
  const bool is_inside =
      row >= 0 && column >= 0 && row < map.disparity.height && column < map.disparity.width;
  if (!is_inside || !map.is_valid(row, column)) return kNone;
  const double value = reading.scale * map.disparity.at(row, column);
  if (reading.values == MapValues::Disparity) return static_cast<float>(value);
  return value > 0 ? static_cast<float>(target.camera.disparity_from_depth(value)) : kNone;
}

namespace {

constexpr double kLargestScale = 1e5;
constexpr int kWidestBorder = 1 << 12;

DisparityField read_maps_so(const DisparityField& field, const MapReading& reading,
                            const MapTarget& target) {
  const ViewStack<float>& maps = field.disparity;
  DisparityField read{
      ViewStack<float>(maps.grid(), target.height, target.width, 1, maps.first()),
      ViewStack<std::uint8_t>(maps.grid(), target.height, target.width, 1, maps.first())};
  for (int i = 0; i < maps.grid().count(); ++i) {
    const ViewIndex view = maps.view_at(i);
    const DisparityView map = field.view(view);
    for (int y = 0; y < target.height; ++y) {
      for (int x = 0; x < target.width; ++x) {
        const float value = value_by(map, reading, target, y, x);
        read.valid.view(view).at(y, x) = std::isfinite(value) ? 1 : 0;
        read.disparity.view(view).at(y, x) = std::isfinite(value) ? value : 0;
      }
    }
  }
  return read;
}

/// Makes the pixels that have one of these values invalid.
void mark_missing(const std::vector<float>& values, DisparityField& field) {
  if (values.empty() || field.empty()) return;
  field.require_mask();
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    if (std::ranges::count(values, field.disparity.data()[i]) > 0) field.valid.data()[i] = 0;
  }
}

}  // namespace

Names<MapFlip> names_of(MapFlip) {
  return {{MapFlip::None, "none", "as stored"},
          {MapFlip::X, "x", "columns from right to left"},
          {MapFlip::Y, "y", "rows from bottom to top"},
          {MapFlip::Both, "both", "both reversed"}};
}

Names<MapCrop> names_of(MapCrop) {
  return {{MapCrop::None, "none", "all of it"},
          {MapCrop::Corner, "corner", "padded on the right and below"},
          {MapCrop::Middle, "middle", "padded on all sides"}};
}

Names<MapValues> names_of(MapValues) {
  return {{MapValues::Disparity, "disparity", "px per view step"},
          {MapValues::Depth, "depth", "in units of the camera of the light field"}};
}

Schema<MapReading> map_schema() {
  using R = MapReading;
  Schema<R> schema;
  schema
      .toggle("map-transpose", &R::is_transposed,
              {"Exchange axes of maps",
               "Exchange rows and columns of the maps of a RESULT, beyond what its file states"})
      .choice("map-flip", &R::flip,
              {"Flip maps", "Axes along which the pixels of the maps run the other way"})
      .real("map-scale", &R::scale,
            {"Scale of maps",
             "Factor that turns the values of the maps into px per view step: 0.01 for integers of "
             "hundredths, -1 for maps of the opposite sign"},
            {-kLargestScale, kLargestScale})
      .choice("map-values", &R::values,
              {"Values of maps",
               "What the values of the maps are; depth needs the camera of the light field"})
      .integer("map-border", &R::border_px,
               {"Border of maps",
                "Pixels that the maps lack at each side of the views: their first pixel belongs "
                "that far from the upper left corner",
                "px"},
               {0, kWidestBorder})
      .integer("map-down", &R::down_px,
               {"Move maps down", "Pixels by which the maps are to be moved down", "px"},
               {-kWidestBorder, kWidestBorder})
      .integer("map-right", &R::right_px,
               {"Move maps right", "Pixels by which the maps are to be moved to the right", "px"},
               {-kWidestBorder, kWidestBorder})
      .toggle(
          "map-resize", &R::is_resized,
          {"Resize maps",
           "Bring maps of another resolution to the size of the views: a pixel has the value of "
           "the nearest one of the map, which --map-scale may change"})
      .choice("map-crop", &R::crop,
              {"Part of maps", "Part of maps larger than the views that belongs to the views"})
      .text("map-missing", &R::missing,
            {"Missing values of maps",
             "Stored values, between commas, that stand for no estimate: -1 or 0,9999"});
  return schema;
}

ParameterSet given_options(const MapReading& reading) {
  return map_schema().changed_values(reading);
}

std::vector<float> missing_values(const MapReading& reading) {
  std::vector<float> values;
  std::string_view rest = reading.missing;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view text = trimmed(rest.substr(0, comma));
    double value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) {
      throw InvalidInput(fmt::format(
          "--map-missing: '{}' is no number; give values between commas, as -1 or 0,9999", text));
    }
    values.push_back(static_cast<float>(value));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return values;
}

std::string reading_text(const MapReading& reading) {
  std::vector<std::string> parts;
  if (reading.is_transposed) parts.emplace_back("rows and columns exchanged");
  if (reading.flip == MapFlip::Y) parts.emplace_back("rows from bottom to top");
  if (reading.flip == MapFlip::X) parts.emplace_back("columns from right to left");
  if (reading.flip == MapFlip::Both) parts.emplace_back("rows and columns reversed");
  if (reading.values == MapValues::Depth) parts.emplace_back("values taken as depth");
  if (reading.scale == -1) parts.emplace_back("values negated");
  if (std::abs(reading.scale) != 1) {
    parts.push_back(fmt::format("values times {:.6g}", reading.scale));
  }
  if (reading.border_px > 0) {
    parts.push_back(fmt::format("a border of {} px around the map", reading.border_px));
  }
  if (reading.down_px != 0) {
    parts.push_back(fmt::format("maps moved {} by {} px", reading.down_px > 0 ? "down" : "up",
                                std::abs(reading.down_px)));
  }
  if (reading.right_px != 0) {
    parts.push_back(fmt::format("maps moved to the {} by {} px",
                                reading.right_px > 0 ? "right" : "left",
                                std::abs(reading.right_px)));
  }
  if (reading.is_resized) parts.emplace_back("maps resized");
  if (reading.crop == MapCrop::Corner) parts.emplace_back("the upper left of padded maps");
  if (reading.crop == MapCrop::Middle) parts.emplace_back("the middle of padded maps");
  if (!reading.missing.empty()) {
    parts.push_back(fmt::format("{} taken as no estimate", reading.missing));
  }
  return fmt::format("{}", fmt::join(parts, " and "));
}

namespace {

/// Throws InvalidInput for what an estimate cannot be read by.
void require_possible(const MapReading& reading, const LightField* light_field,
                      const Estimate& estimate) {
  if (reading.scale == 0 || !std::isfinite(reading.scale)) {
    throw InvalidInput("a map times 0 says nothing; give another --map-scale");
  }
  if (!estimate.layered.foreground.empty()) {
    throw InvalidInput(
        "a result in two layers is read as its file states; leave out the options that begin with "
        "--map-");
  }
  const bool needs_size =
      reading.border_px > 0 || reading.crop != MapCrop::None || reading.is_resized;
  if (!light_field && (needs_size || reading.values == MapValues::Depth)) {
    throw InvalidInput(
        "--map-border, --map-crop, --map-resize and --map-values depth need size and camera of the "
        "light field; name it with --truth INPUT");
  }
  if (reading.is_resized && (reading.border_px > 0 || reading.crop != MapCrop::None)) {
    throw InvalidInput(
        "--map-resize fills the views with all of a map; leave out --map-border and --map-crop");
  }
  if (reading.values == MapValues::Depth && !light_field->info().camera.is_known()) {
    throw InvalidInput("the camera of " + light_field->info().name +
                       " is not known, so depth cannot become disparity; convert the map to px per "
                       "view step");
  }
}

/// What pixels of the views are to be filled from maps of this size.
MapTarget target_of(const MapReading& reading, const LightField* light_field, int height,
                    int width) {
  MapTarget target{height, width};
  if (!light_field) return target;
  target.camera = light_field->info().camera;
  const bool fills_views = reading.border_px > 0 || reading.moved_px() > 0 ||
                           reading.crop != MapCrop::None || reading.is_resized;
  if (!fills_views) return target;
  target.height = light_field->height();
  target.width = light_field->width();
  if (reading.moved_px() > 0 && reading.border_px == 0 && !reading.is_resized) {
    target.above = std::min(0, height - target.height) / 2;
    target.left = std::min(0, width - target.width) / 2;
  }
  if (reading.crop == MapCrop::None) return target;
  if (height < target.height || width < target.width) {
    throw InvalidInput(
        fmt::format("the maps have {}×{} px, less than the views with {}×{}; leave "
                    "out --map-crop",
                    width, height, target.width, target.height));
  }
  if (reading.crop == MapCrop::Middle) {
    target.above = (height - target.height) / 2;
    target.left = (width - target.width) / 2;
  }
  return target;
}

}  // namespace

void apply_reading(const MapReading& reading, const LightField* light_field, Estimate& estimate) {
  if (reading == MapReading{}) return;
  require_possible(reading, light_field, estimate);
  const std::vector<float> missing = missing_values(reading);
  mark_missing(missing, estimate.field);
  mark_missing(missing, estimate.second);
  const ViewStack<float>& maps = estimate.field.disparity;
  const MapTarget target = reading.is_transposed
                               ? target_of(reading, light_field, maps.width(), maps.height())
                               : target_of(reading, light_field, maps.height(), maps.width());
  if (!estimate.confidence.empty()) {
    MapReading places = reading;
    places.scale = 1;
    places.values = MapValues::Disparity;
    estimate.confidence =
        read_maps_so({std::move(estimate.confidence), {}}, places, target).disparity;
  }
  estimate.field = read_maps_so(estimate.field, reading, target);
  if (!estimate.second.empty()) estimate.second = read_maps_so(estimate.second, reading, target);
  const int bare = reading.moved_px() > 0 ? -std::min(target.above, target.left) : 0;
  estimate.border_px = reading.border_px + reading.moved_px() + bare;
}

}  // namespace episcope::io
