// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/array_layout.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/sample_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::size_t kMostArrayViews = 1000;  ///< Along an axis of the grid, or in a list.
constexpr std::size_t kMostViewSide = 100000;  ///< Along an axis of a view.
constexpr std::size_t kFewestPixels = 4;

bool can_be_channels(std::size_t length) {
  return length == 1 || length == 3 || length == 4;
}

bool can_be_pixels(std::size_t a, std::size_t b) {
  const auto [least, most] = std::minmax(a, b);
  return least >= kFewestPixels && most <= kMostViewSide;
}

/// Whether the lengths can be a grid of views and the pixels of a view.
bool can_be_views(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  const std::size_t most = std::max(a, b);
  return std::min(a, b) > 0 && most > 1 && most <= kMostArrayViews && can_be_pixels(c, d) &&
         most < std::min(c, d);
}

/// Letters for four axes, or a list and its pixels, into which the channels are to be put.
void add_grids(const ArrayShape& lengths, std::size_t channel_axis, std::vector<std::string>& out) {
  ArrayShape four = lengths;
  const bool has_channels = channel_axis < lengths.size();
  if (has_channels) four.erase(four.begin() + static_cast<std::ptrdiff_t>(channel_axis));
  const auto add = [&](std::string axes) {
    if (has_channels) axes = axes.substr(0, channel_axis) + 'c' + axes.substr(channel_axis);
    out.push_back(std::move(axes));
  };
  if (can_be_views(four[0], four[1], four[2], four[3])) add("vuyx");
  if (can_be_views(four[2], four[3], four[0], four[1])) {
    add(has_channels && channel_axis == 0 ? "xyuv" : "yxvu");
  }
}

/// Of mosaics whose sides were split: "vyux" of views side by side, "yvxu" of lenslets.
void add_mosaics(const ArrayShape& l, std::vector<std::string>& out) {
  const std::string channels = l.size() == 5 ? "c" : "";
  if (can_be_views(l[0], l[2], l[1], l[3])) out.push_back("vyux" + channels);
  if (can_be_views(l[1], l[3], l[0], l[2])) out.push_back("yvxu" + channels);
}

bool is_square(std::size_t n) {
  const auto root = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
  return root * root == n;
}

bool can_be_list(std::size_t n, std::size_t y, std::size_t x) {
  return n > 1 && n <= kMostArrayViews && can_be_pixels(y, x) && (n < std::max(y, x) || n > 4);
}

void add_lists(const ArrayShape& lengths, std::vector<std::string>& out) {
  const ArrayShape& l = lengths;
  if (l.size() == 3) {
    if (!can_be_channels(l[2]) && can_be_list(l[0], l[1], l[2])) out.emplace_back("nyx");
    const bool is_deep = l[2] < std::min(l[0], l[1]) || l[0] == l[1] ||
                         (l[2] < std::max(l[0], l[1]) && is_square(l[2]));
    if (!can_be_channels(l[0]) && can_be_list(l[2], l[0], l[1]) && is_deep &&
        !can_be_channels(l[2])) {
      out.emplace_back("yxn");
    }
    return;
  }
  if (can_be_channels(l[3]) && can_be_list(l[0], l[1], l[2])) out.emplace_back("nyxc");
  if (can_be_channels(l[1]) && l[1] > 1 && can_be_list(l[0], l[2], l[3])) out.emplace_back("ncyx");
  if (can_be_channels(l[2]) && l[2] > 1 && can_be_list(l[3], l[0], l[1])) out.emplace_back("yxcn");
}

/// Lists as networks take them, which are written like the only row or column of a grid: after a
/// batch of one, or with one channel. They are read as lists, whose views can speak for either.
void add_network_lists(const ArrayShape& lengths, std::vector<std::string>& out) {
  const bool is_batch = lengths.front() == 1;
  const ArrayShape rest(lengths.begin() + (is_batch ? 1 : 0), lengths.end());
  std::vector<std::string> lists;
  if (is_batch) add_lists(rest, lists);
  if (rest.size() == 4 && rest[1] == 1 && can_be_list(rest[0], rest[2], rest[3])) {
    lists.emplace_back("ncyx");
  }
  std::erase_if(lists,
                [](const std::string& axes) { return !axes.starts_with('n') && axes != "yxn"; });
  if (!lists.empty()) {
    std::erase_if(out, [](const std::string& axes) { return axes.starts_with("vu"); });
  }
  for (std::string& axes : lists) {
    if (is_batch) axes.insert(axes.begin(), kSingle);
    out.push_back(std::move(axes));
  }
}

}  // namespace

ArrayShape in_index_order(ArrayShape stored, IndexOrder order) {
  if (order == IndexOrder::Fortran) std::ranges::reverse(stored);
  return stored;
}

std::string in_index_order(std::string axes, IndexOrder order) {
  if (order == IndexOrder::Fortran) std::ranges::reverse(axes);
  return axes;
}

std::size_t ArrayLayout::length(char letter) const {
  const std::size_t at = axes.find(letter);
  return at == std::string::npos ? 1 : shape[at];
}

std::size_t ArrayLayout::stride(char letter) const {
  const std::size_t at = axes.find(letter);
  if (at == std::string::npos) return 0;
  std::size_t stride = 1;
  for (std::size_t axis = at + 1; axis < shape.size(); ++axis) stride *= shape[axis];
  return stride;
}

bool ArrayLayout::views_are_fastest() const {
  const std::size_t views = has('n') ? axes.find('n') : std::min(axes.find('v'), axes.find('u'));
  return views > std::min(axes.find('y'), axes.find('x'));
}

GridShape ArrayLayout::grid() const {
  return has('n') ? GridShape{1, count('n')} : GridShape{count('v'), count('u')};
}

int ArrayLayout::count(char letter) const {
  constexpr std::size_t most = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(length(letter), most));
}

ArrayLayout ArrayLayout::crossed() const {
  ArrayLayout other = *this;
  for (char& letter : other.axes) letter = letter == 'v' ? 'u' : letter == 'u' ? 'v' : letter;
  return other;
}

std::vector<ArrayLayout> possible_layouts(const ArrayShape& stored, IndexOrder order) {
  ArrayShape lengths = in_index_order(stored, order);
  std::string singles;
  while (lengths.size() > 5 && lengths.front() == 1) {
    lengths.erase(lengths.begin());
    singles += kSingle;
  }
  std::vector<std::string> found;
  if (lengths.size() == 5) {
    for (const std::size_t axis : {4, 0, 2}) {
      if (can_be_channels(lengths[axis])) add_grids(lengths, axis, found);
    }
  } else if (lengths.size() == 4) {
    add_grids(lengths, lengths.size(), found);
    add_lists(lengths, found);
  } else if (lengths.size() == 3) {
    add_lists(lengths, found);
  }
  const bool has_channels_last = lengths.size() == 5 && can_be_channels(lengths[4]);
  if (found.empty() && (lengths.size() == 4 || has_channels_last)) add_mosaics(lengths, found);
  const bool may_be_of_network = order == IndexOrder::C && singles.empty() && lengths.size() > 3;
  if (may_be_of_network) add_network_lists(lengths, found);
  std::vector<ArrayLayout> layouts;
  for (const std::string& axes : found)
    layouts.push_back({stored, in_index_order(singles + axes, order)});
  return layouts;
}

std::string axis_letters(const std::string& axes) {
  std::string letters;
  for (const char c : axes) {
    const char lower = lower_case(c);
    if (lower == ',' || lower == ' ') continue;
    letters += lower == 't' ? 'v' : lower == 's' ? 'u' : lower;
  }
  const auto refused = [&](char letter, const char* why) {
    return InvalidInput(
        fmt::format("axes {}: {} {}; give one of the letters v, u, y, x, c for each axis, or n, y, "
                    "x, c for a list of views, as in vuyxc",
                    axes.substr(0, 40), letter, why));
  };
  for (const char letter : letters) {
    if (letter == kSingle) continue;
    if (std::string("vuyxcn").find(letter) == std::string::npos) {
      throw refused(letter, "is no axis");
    }
    if (std::ranges::count(letters, letter) > 1) throw refused(letter, "stands there twice");
  }
  return letters;
}

ArrayLayout stated_layout(const std::filesystem::path& path, const ArrayShape& stored,
                          const std::string& axes, IndexOrder order) {
  const std::string letters = axis_letters(axes);
  const auto refused = [&](const std::string& why) {
    return InvalidInput(fmt::format(
        "{}: axes {} do not fit the array of {}: {}; give one of the letters v, u, y, x, c for "
        "each of its axes, or n, y, x, c for a list of views, as in --axes vuyxc",
        path.string(), axes.substr(0, 40), shape_text(in_index_order(stored, order)), why));
  };
  if (letters.size() != stored.size()) {
    throw refused(fmt::format("{} letters, but {} axes", letters.size(), stored.size()));
  }
  const ArrayLayout layout{stored, in_index_order(letters, order)};
  const bool has_list = layout.has('n') && !layout.has('v') && !layout.has('u');
  const bool has_grid = !layout.has('n') && (layout.has('v') || layout.has('u'));
  if (!layout.has('y') || !layout.has('x')) throw refused("y and x are both needed");
  if (!has_list && !has_grid) throw refused("either v and u, or n, are needed");
  if (!can_be_channels(layout.length('c'))) {
    throw refused(fmt::format("{} channels, but 1, 3 or 4 are expected", layout.length('c')));
  }
  const auto is_odd = [](std::size_t length) { return length == 0 || length > kMostViewSide; };
  if (std::ranges::any_of(stored, is_odd)) throw refused("that is no size of a light field");
  return layout;
}

std::string layout_text(const ArrayLayout& layout, IndexOrder order) {
  return fmt::format("{} ({})", shape_text(in_index_order(layout.shape, order)),
                     in_index_order(layout.axes, order));
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPreviewTime{700};
constexpr std::size_t kCoarsest = 64;
constexpr std::size_t kLargestPiece = std::size_t{64} << 20;

struct PixelBox {
  int y = 0;
  int x = 0;
  int height = 0;
  int width = 0;
  int channel = 0;
  int channels = 1;
};

/// One view in float, and which lines of it have been read.
struct PartialView {
  Image<float> samples;
  char line_letter = 'y';  ///< y: rows are read one by one; x: columns.
  std::vector<std::uint8_t> has_line;
};

/// A block of the array: everything along `letter`, one place along the others.
struct Selection {
  const ArrayLayout& layout;
  ArrayShape start;
  ArrayShape count;

  explicit Selection(const ArrayLayout& of)
      : layout(of), start(of.shape.size(), 0), count(of.shape) {}
  void pick(char letter, std::size_t first, std::size_t length = 1) {
    const std::size_t axis = layout.axes.find(letter);
    if (axis == std::string::npos) return;
    start[axis] = first;
    count[axis] = length;
  }
  [[nodiscard]] std::size_t stride(char letter) const {
    return ArrayLayout{count, layout.axes}.stride(letter);
  }
  void pick(ViewIndex view) {
    pick('v', static_cast<std::size_t>(view.v));
    pick('u', static_cast<std::size_t>(view.u));
    pick('n', static_cast<std::size_t>(view.u));
  }
};

std::size_t offset_of(const Selection& block, ViewIndex view) {
  return block.stride('v') * static_cast<std::size_t>(view.v) +
         block.stride(block.layout.has('n') ? 'n' : 'u') * static_cast<std::size_t>(view.u);
}

/// All views of a line of pixels at once: they lie together.
void read_line(const ArrayInput& array, const ArrayLayout& layout, ViewIndex view, std::size_t line,
               PartialView& out) {
  const bool is_row = out.line_letter == 'y';
  Selection block(layout);
  block.pick(out.line_letter, line);
  std::vector<float> samples(element_count(block.count));
  array.read(block.start, block.count, samples.data());
  const std::size_t first = offset_of(block, view);
  const std::size_t along = block.stride(is_row ? 'x' : 'y');
  const std::size_t channel = block.stride('c');
  for (int i = 0; i < (is_row ? out.samples.width() : out.samples.height()); ++i) {
    const int y = is_row ? static_cast<int>(line) : i;
    const int x = is_row ? i : static_cast<int>(line);
    for (int c = 0; c < out.samples.channels(); ++c) {
      out.samples.at(y, x, c) = samples[first + along * static_cast<std::size_t>(i) +
                                        channel * static_cast<std::size_t>(c)];
    }
  }
  out.has_line[line] = 1;
}

void read_lines(const ArrayInput& array, const ArrayLayout& layout, ViewIndex view,
                PartialView& out) {
  const auto begin = Clock::now();
  const std::size_t lines = out.has_line.size();
  for (std::size_t step = kCoarsest; step > 0; step /= 2) {
    for (std::size_t line = step / 2; line < lines; line += step) {
      if (out.has_line[line]) continue;
      const bool has_any = step < kCoarsest || line > step;
      if (has_any && Clock::now() - begin > kPreviewTime) return;
      read_line(array, layout, view, line, out);
    }
  }
  for (std::size_t line = 0; line < lines; ++line) {
    if (Clock::now() - begin > kPreviewTime) return;
    if (!out.has_line[line]) read_line(array, layout, view, line, out);
  }
}

/// Lines that were not read repeat the nearest one that was.
void fill_lines(PartialView& view) {
  const auto lines = static_cast<int>(view.has_line.size());
  const auto copy = [&](int from, int to) {
    const bool is_row = view.line_letter == 'y';
    for (int i = 0; i < (is_row ? view.samples.width() : view.samples.height()); ++i) {
      for (int c = 0; c < view.samples.channels(); ++c) {
        float& out = is_row ? view.samples.at(to, i, c) : view.samples.at(i, to, c);
        out = is_row ? view.samples.at(from, i, c) : view.samples.at(i, from, c);
      }
    }
  };
  for (int line = 0; line < lines; ++line) {
    if (view.has_line[static_cast<std::size_t>(line)]) continue;
    for (int far = 1; far < lines; ++far) {
      const int before = line - far;
      const int after = line + far;
      const bool is_before = before >= 0 && view.has_line[static_cast<std::size_t>(before)];
      const bool is_after = after < lines && view.has_line[static_cast<std::size_t>(after)];
      if (!is_before && !is_after) continue;
      copy(is_before ? before : after, line);
      break;
    }
  }
}

/// The box of some views, which are read at once if they lie together.
std::vector<Image<float>> read_boxes(const ArrayInput& array, const ArrayLayout& layout,
                                     const std::vector<ViewIndex>& views, const PixelBox& box) {
  Selection block(layout);
  block.pick('y', static_cast<std::size_t>(box.y), static_cast<std::size_t>(box.height));
  block.pick('x', static_cast<std::size_t>(box.x), static_cast<std::size_t>(box.width));
  block.pick('c', static_cast<std::size_t>(box.channel), static_cast<std::size_t>(box.channels));
  const bool are_together = layout.views_are_fastest();
  std::vector<Image<float>> images;
  std::vector<float> samples;
  for (const ViewIndex view : views) {
    if (!are_together) block.pick(view);
    if (!are_together || images.empty()) {
      samples.resize(element_count(block.count));
      array.read(block.start, block.count, samples.data());
    }
    const float* first = samples.data() + (are_together ? offset_of(block, view) : 0);
    const std::size_t stride_y = block.stride('y');
    const std::size_t stride_x = block.stride('x');
    const std::size_t stride_c = block.stride('c');
    Image<float>& image = images.emplace_back(box.height, box.width, box.channels);
    for (int y = 0; y < box.height; ++y) {
      const float* row = first + stride_y * static_cast<std::size_t>(y);
      for (int x = 0; x < box.width; ++x, row += stride_x) {
        for (int c = 0; c < box.channels; ++c) {
          image.at(y, x, c) = row[stride_c * static_cast<std::size_t>(c)];
        }
      }
    }
  }
  return images;
}

Image<std::uint8_t> picture_of(const Image<float>& samples, NumberType type) {
  float black = 0;
  float white = 0;
  for (const float sample : samples) {
    if (!std::isfinite(sample)) continue;
    black = std::min(black, sample);
    white = std::max(white, sample);
  }
  if (!is_float(type) && black == 0) white = static_cast<float>(full_scale(white));
  Image<std::uint8_t> rgb(samples.height(), samples.width(), 3);
  for (int y = 0; y < rgb.height(); ++y) {
    for (int x = 0; x < rgb.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const float sample = samples.at(y, x, c % samples.channels());
        const float unit =
            white > black && std::isfinite(sample) ? (sample - black) / (white - black) : 0;
        rgb.at(y, x, c) = static_cast<std::uint8_t>(255 * std::clamp(unit, 0.0F, 1.0F) + 0.5F);
      }
    }
  }
  return rgb;
}

}  // namespace

Image<std::uint8_t> array_preview(const ArrayInput& array, const ArrayLayout& layout,
                                  ViewIndex view) {
  const int channels = static_cast<int>(std::min<std::size_t>(layout.length('c'), 3));
  if (!layout.views_are_fastest()) {
    const PixelBox whole{0, 0, layout.height(), layout.width(), 0, channels};
    return picture_of(read_boxes(array, layout, {view}, whole).front(), array.type());
  }
  PartialView partial{Image<float>(layout.height(), layout.width(), channels), 'y', {}};
  if (layout.axes.find('x') < layout.axes.find('y')) partial.line_letter = 'x';
  partial.has_line.resize(layout.length(partial.line_letter));
  read_lines(array, layout, view, partial);
  fill_lines(partial);
  return picture_of(partial.samples, array.type());
}

std::vector<Image<float>> array_windows(const ArrayInput& array, const ArrayLayout& layout,
                                        const std::vector<ViewIndex>& views, int side) {
  PixelBox box{0, 0, std::min(side, layout.height()), std::min(side, layout.width())};
  if (layout.length('c') >= 3) box.channel = 1;
  const int together = layout.views_are_fastest() ? layout.grid().count() : 1;
  const std::size_t pixels =
      kLargestPiece / sizeof(float) / static_cast<std::size_t>(std::max(together, 1));
  while (static_cast<std::size_t>(box.height) * static_cast<std::size_t>(box.width) > pixels &&
         box.height > 1) {
    box.height /= 2;
  }
  box.y = (layout.height() - box.height) / 2;
  box.x = (layout.width() - box.width) / 2;
  std::vector<Image<float>> windows = read_boxes(array, layout, views, box);
  for (Image<float>& window : windows) {
    std::ranges::replace_if(
        window, [](float sample) { return !std::isfinite(sample); }, 0.0F);
  }
  return windows;
}

}  // namespace episcope::io
