// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/array_preview.h"

#include "engine/io/base/sample_range.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace episcope::io {
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
