// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/array_samples.h"

#include "engine/io/base/sample_range.h"
#include "engine/io/models/load_views.h"

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

struct ArrayBlock {
  ArrayShape start;
  ArrayShape count;
};

/// Blocks that together are the whole array, in the order of the file, each of whole units and of
/// at most `elements`, unless one unit has more.
std::vector<ArrayBlock> plan_blocks(const ArrayShape& shape, const ArrayShape& unit,
                                    std::size_t elements) {
  // From the last axis on, a block takes as many units as fit.
  ArrayShape step(shape.size());
  std::size_t size = 1;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    step[axis] = std::min(unit[axis], shape[axis]);
    size *= step[axis];
  }
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    size /= step[axis];
    const std::size_t units = std::max<std::size_t>(elements / (size * step[axis]), 1);
    step[axis] = std::min(units * step[axis], shape[axis]);
    size *= step[axis];
  }
  std::vector<ArrayBlock> blocks;
  ArrayShape at(shape.size(), 0);
  for (;;) {
    ArrayBlock block{at, step};
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
      block.count[axis] = std::min(step[axis], shape[axis] - at[axis]);
    }
    blocks.push_back(std::move(block));
    std::size_t axis = shape.size();
    while (axis > 0 && (at[axis - 1] += step[axis - 1]) >= shape[axis - 1]) at[--axis] = 0;
    if (axis == 0) return blocks;
  }
}

constexpr std::size_t kBlockBytes = std::size_t{64} << 20;
constexpr std::string_view kLetters = "vuyxc";

/// Where the axes of a block lie among v, u, y, x, c; a list is a row of views.
struct BlockAxes {
  FiveAxes start{};
  FiveAxes count{1, 1, 1, 1, 1};
  FiveAxes stride{};
};

BlockAxes axes_of(const ArrayBlock& block, const ArrayLayout& layout) {
  BlockAxes axes;
  std::size_t stride = 1;
  for (std::size_t axis = layout.axes.size(); axis-- > 0;) {
    const char letter = layout.axes[axis] == 'n' ? 'u' : layout.axes[axis];
    const std::size_t at = kLetters.find(letter);
    if (at == std::string_view::npos) continue;  // of length 1
    axes.start[at] = block.start[axis];
    axes.count[at] = block.count[axis];
    axes.stride[at] = stride;
    stride *= block.count[axis];
  }
  return axes;
}

template <class T>
PlacedSamples<T> place_of(ViewStack<T>& stack, const BlockAxes& axes) {
  PlacedSamples<T> placed{stack.data(), strides_of(stack)};
  for (std::size_t i = 0; i < 4; ++i) placed.data += axes.start[i] * placed.stride[i];
  return placed;
}

/// Chunks, with all channels of a pixel, so that its place in the views is visited once.
ArrayShape unit_of(const ArrayInput& array, const ArrayLayout& layout) {
  ArrayShape unit = array.unit();
  const std::size_t channels = layout.axes.find('c');
  const bool may_skip = !array.is_sequential();
  if (channels != std::string::npos && may_skip) unit[channels] = array.shape()[channels];
  return unit;
}

template <class T, class UseBlock>
void for_each_block(const ArrayInput& array, const ArrayLayout& layout, const Progress& progress,
                    const UseBlock& use) {
  const auto blocks = plan_blocks(array.shape(), unit_of(array, layout), kBlockBytes / sizeof(T));
  LargeArray<T> samples;
  std::size_t room = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    progress.check();
    const std::size_t size = element_count(blocks[i].count);
    if (size > room) {
      samples = make_large<T>(size);
      room = size;
    }
    array.read(blocks[i].start, blocks[i].count, samples.get());
    use(samples.get(), axes_of(blocks[i], layout));
    progress.report((i + 1.0) / static_cast<double>(blocks.size()));
  }
}

/// What a value of a fourth channel can be.
enum Fourth : std::uint8_t { Nothing = 0, Weight = 1, NoWeight = 2, NegativeWeight = 3 };

/// Weights are fractions, or integers.
template <class T>
std::uint8_t fourth_of(T value) {
  if (value == 0) return Nothing;
  if constexpr (std::is_floating_point_v<T>) {
    if (!(value > 0)) return NegativeWeight;
    if (value > 1 && value != std::floor(value)) return NoWeight;
  }
  return Weight;
}

/// Turns what values can be into a mask, or says why they are none.
std::string settle_fourth(ViewStack<std::uint8_t>& valid) {
  const std::uint8_t* begin = valid.data();
  const std::uint8_t* end = begin + valid.size();
  if (begin == end) return {};
  const std::uint8_t largest = *std::max_element(begin, end);
  const bool has_zeros = std::find(begin, end, std::uint8_t{Nothing}) != end;
  if (largest > Weight || !has_zeros) valid = {};
  if (largest == NegativeWeight) return "it holds values below 0, or that are not finite";
  return largest == NoWeight ? "it holds fractions above 1" : std::string();
}

template <class T>
ArraySamples read_as(const ArrayInput& array, const ArrayLayout& layout, const Progress& progress) {
  const std::size_t stored = layout.length('c');
  const std::size_t channels = std::min<std::size_t>(stored, 3);
  require_view_memory(array.path(), static_cast<double>(element_count(array.shape())) * sizeof(T));
  ViewStack<T> stack(layout.grid(), layout.height(), layout.width(), static_cast<int>(channels));
  ViewStack<std::uint8_t> valid;
  if (stored == 4) valid = all_valid(layout.grid(), layout.height(), layout.width());
  const bool views_are_fastest = layout.views_are_fastest();
  for_each_block<T>(array, layout, progress, [&](const T* samples, const BlockAxes& axes) {
    const std::size_t first = axes.start[4];
    const std::size_t last = std::min(first + axes.count[4], channels);
    FiveAxes count = axes.count;
    if (first < last) {
      PlacedSamples<T> place = place_of(stack, axes);
      place.data += first;
      count[4] = last - first;
      move_block<T, T>({samples, axes.stride}, place, count, views_are_fastest,
                       [](T sample) { return sample; });
    }
    if (stored < 4 || first + axes.count[4] < 4) return;
    count[4] = 1;
    move_block<T, std::uint8_t>({samples + (3 - first) * axes.stride[4], axes.stride},
                                place_of(valid, axes), count, views_are_fastest, fourth_of<T>);
  });
  std::string left_out = settle_fourth(valid);
  return {std::move(stack), std::move(valid), std::move(left_out)};
}

template <class To>
ViewStack<To> converted(const ViewStack<float>& from) {
  ViewStack<To> to(from.grid(), from.height(), from.width(), from.channels());
  std::transform(from.data(), from.data() + from.size(), to.data(),
                 [](float sample) { return static_cast<To>(sample); });
  return to;
}

bool lies_in(const ViewStack<float>& stack, float smallest, float largest) {
  return std::all_of(stack.data(), stack.data() + stack.size(),
                     [=](float sample) { return smallest <= sample && sample <= largest; });
}

}  // namespace

void narrow(LightField::Samples& samples) {
  const auto& floats = std::get<ViewStack<float>>(samples);
  if (lies_in(floats, 0, std::numeric_limits<std::uint8_t>::max())) {
    samples = converted<std::uint8_t>(floats);
  } else if (lies_in(floats, 0, std::numeric_limits<std::uint16_t>::max())) {
    samples = converted<std::uint16_t>(floats);
  }
}

ArraySamples read_samples(const ArrayInput& array, const ArrayLayout& layout,
                          const Progress& progress) {
  const NumberType type = array.type();
  if (is_float(type)) return read_as<float>(array, layout, progress);
  if (byte_size(type) == 1 && type != NumberType::Int8) {
    ArraySamples read = read_as<std::uint8_t>(array, layout, progress);
    auto& bytes = std::get<ViewStack<std::uint8_t>>(read.samples);
    if (type == NumberType::Bool) {
      std::for_each(bytes.data(), bytes.data() + bytes.size(),
                    [](std::uint8_t& sample) { sample = sample != 0 ? 255 : 0; });
    }
    return read;
  }
  const bool is_of_words = type == NumberType::UInt16;
  ArraySamples read = is_of_words ? read_as<std::uint16_t>(array, layout, progress)
                                  : read_as<float>(array, layout, progress);
  if (!is_of_words) narrow(read.samples);
  return read;
}

template <class T>
ViewStack<T> read_map_stack(const ArrayInput& array, const ArrayLayout& layout,
                            const Progress& progress) {
  require_view_memory(array.path(), static_cast<double>(element_count(array.shape())) * sizeof(T));
  ViewStack<T> stack(layout.grid(), layout.height(), layout.width());
  for_each_block<T>(array, layout, progress, [&](const T* samples, const BlockAxes& axes) {
    move_block<T, T>({samples, axes.stride}, place_of(stack, axes), axes.count,
                     layout.views_are_fastest(), [](T sample) { return sample; });
  });
  return stack;
}

template ViewStack<float> read_map_stack(const ArrayInput&, const ArrayLayout&, const Progress&);
template ViewStack<std::int32_t> read_map_stack(const ArrayInput&, const ArrayLayout&,
                                                const Progress&);

}  // namespace episcope::io
