// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/padding.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace episcope::io {
namespace {

struct Place {
  int y = 0;
  int x = 0;
  const char* text = "";
};

/// Whether all of a map outside the place is invalid or of the value in the last corner.
bool is_padding(const DisparityView& map, const Place& place, int height, int width) {
  const ImageView<const float>& values = map.disparity;
  std::optional<float> padding;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      const bool is_inside =
          y >= place.y && y < place.y + height && x >= place.x && x < place.x + width;
      if (is_inside || !map.is_valid(y, x)) continue;
      if (!padding) padding = values.at(y, x);
      if (values.at(y, x) != *padding) return false;
    }
  }
  return true;
}

template <class T>
ViewStack<T> cut(const ViewStack<T>& stack, const Place& place, int height, int width) {
  if (stack.empty()) return {};
  ViewStack<T> part(stack.grid(), height, width, 1, stack.first());
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    for (int y = 0; y < height; ++y) {
      std::copy_n(stack.view(view).row(place.y + y) + place.x, width, part.view(view).row(y));
    }
  }
  return part;
}

}  // namespace

std::string remove_padding(DisparityField& field, int height, int width) {
  const int high = field.disparity.height();
  const int wide = field.disparity.width();
  if (high < height || wide < width || (high == height && wide == width)) return {};
  const Place places[] = {{(high - height) / 2, (wide - width) / 2, "on all sides"},
                          {0, 0, "on the right and below"}};
  const auto fits = [&](const Place& place) {
    for (int i = 0; i < field.disparity.grid().count(); ++i) {
      const DisparityView map = field.view(field.disparity.view_at(i));
      if (!is_padding(map, place, height, width)) return false;
    }
    return true;
  };
  if (std::ranges::count_if(places, fits) != 1) return {};
  const Place place = *std::ranges::find_if(places, fits);
  field.valid = cut(field.valid, place, height, width);
  field.disparity = cut(field.disparity, place, height, width);
  return fmt::format("The maps of {}×{} px are padded {} with a constant; {}×{} px are used.", wide,
                     high, place.text, width, height);
}

}  // namespace episcope::io
