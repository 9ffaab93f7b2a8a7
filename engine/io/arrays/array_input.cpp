// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/array_input.h"

#include "engine/core/text/join.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace episcope::io {
namespace {

/// Numbers that are converted at a time.
constexpr std::size_t kConvertedBytes = std::size_t{16} << 20;

template <class T>
constexpr bool is_stored_as(NumberType type) {
  const bool is_truth = std::is_same_v<T, std::uint8_t> && type == NumberType::Bool;
  return is_truth || type == number_type_of<T>();
}

}  // namespace

std::string array_shape_text(const ArrayShape& shape) {
  if (shape.empty()) return "a single value";
  return joined(shape, "×", [](std::size_t length) { return std::to_string(length); });
}

std::size_t element_count(const ArrayShape& shape) {
  constexpr std::size_t kMost = std::size_t{1} << 63;
  if (std::ranges::find(shape, std::size_t{0}) != shape.end()) return 0;
  std::size_t count = 1;
  for (const std::size_t length : shape) {
    if (length > kMost / count) return kMost;
    count *= length;
  }
  return count;
}

template <class T>
void ArrayInput::read(const ArrayShape& start, const ArrayShape& count, T* out) const {
  assert(start.size() == shape_.size() && count.size() == shape_.size());
  if (is_stored_as<T>(type_)) {
    return read_block(start, count, reinterpret_cast<std::uint8_t*>(out));
  }
  const std::size_t total = element_count(count);
  if (total == 0) return;
  const std::size_t whole = byte_size(type_) * total;
  if (whole <= kConvertedBytes || count.empty() || total == count.back()) {
    std::vector<std::uint8_t> numbers(whole);
    read_block(start, count, numbers.data());
    return convert_numbers(type_, numbers.data(), total, out);
  }
  // One step along the first axis that has several, so that little memory is needed.
  const auto axis = static_cast<std::size_t>(
      std::ranges::find_if(count, [](std::size_t length) { return length > 1; }) - count.begin());
  ArrayShape one_start = start;
  ArrayShape one_count = count;
  one_count[axis] = 1;
  for (std::size_t i = 0; i < count[axis]; ++i, out += total / count[axis]) {
    one_start[axis] = start[axis] + i;
    read(one_start, one_count, out);
  }
}

template void ArrayInput::read(const ArrayShape&, const ArrayShape&, std::uint8_t*) const;
template void ArrayInput::read(const ArrayShape&, const ArrayShape&, std::uint16_t*) const;
template void ArrayInput::read(const ArrayShape&, const ArrayShape&, std::int32_t*) const;
template void ArrayInput::read(const ArrayShape&, const ArrayShape&, float*) const;

void LinearArray::read_block(const ArrayShape& start, const ArrayShape& count,
                             std::uint8_t* out) const {
  const ArrayShape& whole = shape();
  if (element_count(count) == 0) return;
  // A run covers the trailing axes that are read completely and one axis before them.
  std::size_t axis = whole.size();
  std::size_t run = 1;
  while (axis > 0) {
    --axis;
    run *= count[axis];
    if (count[axis] != whole[axis]) break;
  }
  ArrayShape at = start;
  for (;;) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) first = first * whole[i] + at[i];
    read_elements(first, run, out);
    out += run * byte_size(type());
    std::size_t moved = axis;
    while (moved > 0 && ++at[moved - 1] == start[moved - 1] + count[moved - 1]) {
      at[moved - 1] = start[moved - 1];
      --moved;
    }
    if (moved == 0) return;
  }
}

}  // namespace episcope::io
