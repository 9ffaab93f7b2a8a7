// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/map_padding.h"

#include "engine/core/finding.h"
#include "engine/core/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

namespace episcope::io {

namespace {

struct PaddedPlace {
  int y = 0;
  int x = 0;
  const char* text = "";
};

/// Whether all of a map outside the place is invalid or of the value in the last corner.
bool is_padding(const DisparityView& map, const PaddedPlace& place, int height, int width) {
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
ViewStack<T> cut(const ViewStack<T>& stack, const PaddedPlace& place, int height, int width) {
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

/// The widest border that is taken for one that maps lack.
int widest_border(int height, int width) {
  return std::min(height, width) / 8;
}

/// Calls `visit(y, x)` for the pixels that are `depth` away from the border.
template <class Visit>
void visit_ring(int height, int width, int depth, Visit visit) {
  const int bottom = height - 1 - depth, right = width - 1 - depth;
  for (int x = depth; x <= right; ++x) {
    visit(depth, x);
    if (bottom > depth) visit(bottom, x);
  }
  for (int y = depth + 1; y < bottom; ++y) {
    visit(y, depth);
    if (right > depth) visit(y, right);
  }
}

/// How much of a ring has this value.
double share_of(const DisparityView& map, int depth, float value) {
  double all = 0, alike = 0;
  visit_ring(map.disparity.height, map.disparity.width, depth, [&](int y, int x) {
    all += 1;
    alike += map.is_valid(y, x) && map.disparity.at(y, x) == value ? 1 : 0;
  });
  return alike / all;
}

/// Width of a frame of one value, which ends at once; 0 if there is none.
int frame_width(const DisparityView& map) {
  constexpr int least = 2;
  constexpr double few = 0.1;
  if (!map.is_valid(0, 0)) return 0;
  const float value = map.disparity.at(0, 0);
  const int widest = widest_border(map.disparity.height, map.disparity.width);
  int width = 0;
  while (width <= widest && share_of(map, width, value) == 1) ++width;
  if (width < least || width > widest) return 0;
  return share_of(map, width, value) <= few ? width : 0;
}

/// Width of the frame that is equal in every map, or 0.
int common_frame(const DisparityField& field) {
  const ViewStack<float>& maps = field.disparity;
  const int first = frame_width(field.view(maps.view_at(0)));
  for (int i = 1; first > 0 && i < maps.grid().count(); ++i) {
    if (frame_width(field.view(maps.view_at(i))) != first) return 0;
  }
  return first;
}

/// The maps in the middle of larger ones, whose border of `border` px is invalid.
DisparityField framed(const DisparityField& field, int border) {
  const ViewStack<float>& maps = field.disparity;
  const int height = maps.height() + 2 * border, width = maps.width() + 2 * border;
  DisparityField result = DisparityField::unknown(maps.grid(), height, width, maps.first());
  for (int i = 0; i < maps.grid().count(); ++i) {
    const ViewIndex view = maps.view_at(i);
    const DisparityView in = field.view(view);
    for (int y = 0; y < maps.height(); ++y) {
      std::copy_n(in.disparity.row(y), maps.width(),
                  result.disparity.view(view).row(y + border) + border);
      for (int x = 0; x < maps.width(); ++x) {
        result.valid.view(view).at(y + border, x + border) = in.is_valid(y, x) ? 1 : 0;
      }
    }
  }
  return result;
}

void make_border_invalid(DisparityField& field, int border) {
  const ViewStack<float>& maps = field.disparity;
  field.require_mask();
  for (int i = 0; i < maps.grid().count(); ++i) {
    const auto valid = field.valid.view(maps.view_at(i));
    for (int depth = 0; depth < border; ++depth) {
      visit_ring(maps.height(), maps.width(), depth, [&](int y, int x) { valid.at(y, x) = 0; });
    }
  }
}

}  // namespace

BareBorder find_bare_border(DisparityField& field, int height, int width) {
  const int high = field.disparity.height(), wide = field.disparity.width();
  if (high == height && wide == width) {
    const int border = common_frame(field);
    if (border == 0) return {};
    make_border_invalid(field, border);
    return {border,
            fmt::format(finding_text("map.border"), border, wide - 2 * border, high - 2 * border)};
  }
  const int lacking = height - high;
  const bool fits = lacking > 0 && lacking == width - wide && lacking % 2 == 0 &&
                    lacking / 2 <= widest_border(height, width);
  if (!fits) return {};
  field = framed(field, lacking / 2);
  return {lacking / 2, fmt::format(finding_text("map.middle"), wide, high, width, height)};
}

std::string remove_padding(DisparityField& field, int height, int width) {
  const int high = field.disparity.height();
  const int wide = field.disparity.width();
  if (high < height || wide < width || (high == height && wide == width)) return {};
  const PaddedPlace places[] = {{(high - height) / 2, (wide - width) / 2, "on all sides"},
                                {0, 0, "on the right and below"}};
  const auto fits = [&](const PaddedPlace& place) {
    for (int i = 0; i < field.disparity.grid().count(); ++i) {
      const DisparityView map = field.view(field.disparity.view_at(i));
      if (!is_padding(map, place, height, width)) return false;
    }
    return true;
  };
  // Of one row or column too many, half is none: both places are the same.
  const bool is_one = places[0].y == places[1].y && places[0].x == places[1].x;
  const auto different = std::span(places).subspan(is_one ? 1 : 0);
  if (std::ranges::count_if(different, fits) != 1) return {};
  const PaddedPlace place = *std::ranges::find_if(different, fits);
  field.valid = cut(field.valid, place, height, width);
  field.disparity = cut(field.disparity, place, height, width);
  return fmt::format(finding_text("map.padded"), wide, high, place.text, width, height);
}

}  // namespace episcope::io
