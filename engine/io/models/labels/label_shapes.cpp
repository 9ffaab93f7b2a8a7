// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_shapes.h"

#include "engine/core/error.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <utility>

namespace episcope::io {
namespace {

/// The first pixel whose center is not left of `x`, within [0, width].
int first_center(double x, int width) {
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width)));
}

double distance_to(const Corner& at, const Corner& begin, const Corner& end) {
  const double dx = end.x - begin.x, dy = end.y - begin.y;
  const double length = dx * dx + dy * dy;
  const double along =
      length > 0 ? std::clamp(((at.x - begin.x) * dx + (at.y - begin.y) * dy) / length, 0.0, 1.0)
                 : 0;
  return std::hypot(at.x - begin.x - along * dx, at.y - begin.y - along * dy);
}

}  // namespace

void fill_polygon(Image<std::int32_t>& map, const Polygon& polygon, std::int32_t label) {
  if (polygon.empty()) return;
  const auto [top, bottom] = std::ranges::minmax_element(polygon, {}, &Corner::y);
  const auto height = static_cast<double>(map.height());
  const auto end = static_cast<int>(std::clamp(std::ceil(bottom->y), 0.0, height));
  std::vector<double> crossings;
  for (auto y = static_cast<int>(std::clamp(std::floor(top->y), 0.0, height)); y < end; ++y) {
    const double center = y + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner& a = polygon[i];
      const Corner& b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= center) == (b.y <= center)) continue;
      crossings.push_back(a.x + (center - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int from = first_center(crossings[i], map.width());
      const int to = first_center(crossings[i + 1], map.width());
      if (from < to) std::fill_n(&map.at(y, from), to - from, label);
    }
  }
}

void draw_line(Image<std::int32_t>& map, const Polygon& corners, double radius_px,
               std::int32_t label) {
  const auto row = [&](double y) {
    return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(map.height())));
  };
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(map.width())));
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i + 1 == corners.size() && i > 0) break;
    const Corner& a = corners[i];
    const Corner& b = corners[std::min(i + 1, corners.size() - 1)];
    const int end_y = row(std::max(a.y, b.y) + radius_px + 1);
    const int end_x = column(std::max(a.x, b.x) + radius_px + 1);
    for (int y = row(std::min(a.y, b.y) - radius_px - 1); y < end_y; ++y) {
      for (int x = column(std::min(a.x, b.x) - radius_px - 1); x < end_x; ++x) {
        if (distance_to({x + 0.5, y + 0.5}, a, b) <= radius_px) map.at(y, x) = label;
      }
    }
  }
}

namespace {

/// Numbers regions, and collects their pixels.
class Regions {
 public:
  explicit Regions(ImageView<const std::int32_t> map) : map_(map), numbers_(map.height, map.width) {
    std::ranges::fill(numbers_, kNone);
  }

  std::vector<LabelRegion> find() {
    for (int y = 0; y < map_.height; ++y) {
      for (int x = 0; x < map_.width; ++x) {
        if (map_.at(y, x) > 0 && numbers_.at(y, x) == kNone) grow({y, x});
      }
    }
    for (std::size_t i = 0; i < regions_.size(); ++i) trace(static_cast<int>(i));
    return std::move(regions_);
  }

 private:
  static constexpr int kNone = -1;

  [[nodiscard]] bool is_of(int number, int y, int x) const {
    return y >= 0 && y < map_.height && x >= 0 && x < map_.width && numbers_.at(y, x) == number;
  }

  void grow(PixelIndex first) {
    const auto number = static_cast<int>(regions_.size());
    LabelRegion region{map_.at(first.y, first.x), {}, false, {}, {}};
    region.pixels.push_back(first);
    numbers_.at(first.y, first.x) = number;
    for (std::size_t i = 0; i < region.pixels.size(); ++i) {
      const auto [y, x] = region.pixels[i];
      region.box.include({y, x, y + 1, x + 1});
      for (const auto& [dy, dx] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int next_y = y + dy, next_x = x + dx;
        const bool is_inside =
            next_y >= 0 && next_y < map_.height && next_x >= 0 && next_x < map_.width;
        if (!is_inside || numbers_.at(next_y, next_x) != kNone ||
            map_.at(next_y, next_x) != region.label) {
          continue;
        }
        numbers_.at(next_y, next_x) = number;
        region.pixels.push_back({next_y, next_x});
      }
    }
    regions_.push_back(std::move(region));
  }

  /// Follows the sides of pixels from the upper left corner of the first pixel, the region at the
  /// right hand. Where two pixels meet at a corner alone, turns right, which keeps them apart.
  void trace(int number) {
    constexpr std::array<std::pair<int, int>, 4> kSteps{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
    LabelRegion& region = regions_[static_cast<std::size_t>(number)];
    // The pixels at the right and the left of a step from corner (y, x).
    const auto right = [&](int y, int x, int way) {
      return way == 0   ? is_of(number, y, x)
             : way == 1 ? is_of(number, y, x - 1)
             : way == 2 ? is_of(number, y - 1, x - 1)
                        : is_of(number, y - 1, x);
    };
    const auto left = [&](int y, int x, int way) {
      return way == 0   ? is_of(number, y - 1, x)
             : way == 1 ? is_of(number, y, x)
             : way == 2 ? is_of(number, y, x - 1)
                        : is_of(number, y - 1, x - 1);
    };
    const PixelIndex first = region.pixels.front();
    int y = first.y, x = first.x, way = 0;
    std::size_t outer = 0;
    do {
      region.outline.push_back({static_cast<double>(x), static_cast<double>(y)});
      const int begin_way = way;
      while (way == begin_way) {
        const auto [dy, dx] = kSteps[static_cast<std::size_t>(way)];
        y += dy;
        x += dx;
        ++outer;
        for (const int turn : {1, 0, 3}) {
          const int next = (way + turn) % 4;
          if (!right(y, x, next) || left(y, x, next)) continue;
          way = next;
          break;
        }
        if (y == first.y && x == first.x && way == 0) break;
      }
    } while (!(y == first.y && x == first.x && way == 0));
    region.has_holes = outer < count_sides(number);
  }

  [[nodiscard]] std::size_t count_sides(int number) const {
    std::size_t sides = 0;
    for (const auto [y, x] : regions_[static_cast<std::size_t>(number)].pixels) {
      for (const auto& [dy, dx] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (!is_of(number, y + dy, x + dx)) ++sides;
      }
    }
    return sides;
  }

  ImageView<const std::int32_t> map_;
  Image<int> numbers_;
  std::vector<LabelRegion> regions_;
};

}  // namespace

std::vector<LabelRegion> regions_of(ImageView<const std::int32_t> map) {
  return Regions(map).find();
}

Runs runs_of(ImageView<const std::int32_t> map, std::int32_t label) {
  Runs runs{0};
  bool is_inside = false;
  for (int x = 0; x < map.width; ++x) {
    for (int y = 0; y < map.height; ++y) {
      if ((map.at(y, x) == label) != is_inside) {
        is_inside = !is_inside;
        runs.push_back(0);
      }
      ++runs.back();
    }
  }
  return runs;
}

std::string packed_runs(const Runs& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::int64_t number = runs[i];
    if (i > 2) number -= runs[i - 2];
    for (bool has_more = true; has_more;) {
      auto bits = static_cast<int>(number & 0x1F);
      number >>= 5;
      has_more = (bits & 0x10) != 0 ? number != -1 : number != 0;
      if (has_more) bits |= 0x20;
      text += static_cast<char>(bits + 48);
    }
  }
  return text;
}

Runs unpacked_runs(const std::string& text) {
  constexpr int kMostGroups = 7;  // of 5 bits, in 32
  Runs runs;
  std::size_t at = 0;
  while (at < text.size()) {
    std::int64_t number = 0;
    bool has_more = true;
    for (int k = 0; has_more; ++k) {
      if (at == text.size() || k == kMostGroups)
        throw InvalidInput("the runs of a mask are damaged");
      const int bits = text[at++] - 48;
      number |= static_cast<std::int64_t>(bits & 0x1F) << (5 * k);
      has_more = (bits & 0x20) != 0;
      if (!has_more && (bits & 0x10) != 0) number -= std::int64_t{1} << (5 * (k + 1));
    }
    if (runs.size() > 2) number += runs[runs.size() - 2];
    if (number < 0 || number > INT32_MAX) throw InvalidInput("the runs of a mask are damaged");
    runs.push_back(static_cast<std::uint32_t>(number));
  }
  return runs;
}

void fill_runs(Image<std::int32_t>& map, const Runs& runs, std::int32_t label) {
  std::uint64_t sum = 0;
  for (const std::uint32_t run : runs) sum += run;
  if (sum != map.size()) {
    throw InvalidInput("the runs of a mask are of " + std::to_string(sum) +
                       " px, but the picture has " + std::to_string(map.size()));
  }
  std::size_t at = 0;
  const auto height = static_cast<std::size_t>(map.height());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t end = at + runs[i];
    for (; at < end; ++at) {
      if (i % 2 == 0) continue;
      map.at(static_cast<int>(at % height), static_cast<int>(at / height)) = label;
    }
  }
}

namespace {

constexpr const char* kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string to_base64(const std::string& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      group = group << 8 | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kBase64[group >> (18 - 6 * k) & 0x3F] : '=';
    }
  }
  return text;
}

std::string from_base64(const std::string& text) {
  const std::string letters = kBase64;
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char letter : text) {
    if (letter == '=' || letter == '\n' || letter == '\r') continue;
    const std::size_t value = letters.find(letter);
    if (value == std::string::npos) throw InvalidInput("a mask holds what is no base64");
    group = group << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xFF);
  }
  return bytes;
}

}  // namespace episcope::io
