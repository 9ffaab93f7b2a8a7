// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/array_input.h"

#include "engine/core/text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

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

std::string shape_text(const ArrayShape& shape) {
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

namespace {

struct Half {
  std::uint16_t bits;
};

float widened(Half half) {
  const int exponent = half.bits >> 10 & 0x1F;
  const int fraction = half.bits & 0x3FF;
  const float sign = half.bits & 0x8000 ? -1.0F : 1.0F;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(fraction), -24);
  if (exponent < 31) return sign * std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
  return fraction ? std::numeric_limits<float>::quiet_NaN()
                  : sign * std::numeric_limits<float>::infinity();
}

template <class T, class Stored>
T converted(Stored stored) {
  if constexpr (std::is_same_v<Stored, Half>) {
    return converted<T>(widened(stored));
  } else if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(stored);
  } else if constexpr (std::is_floating_point_v<Stored>) {
    if (std::isnan(stored)) return 0;
    return static_cast<T>(
        std::clamp<double>(stored, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
  } else {
    if (std::in_range<T>(stored)) return static_cast<T>(stored);
    return stored < Stored{} ? std::numeric_limits<T>::min() : std::numeric_limits<T>::max();
  }
}

template <class Stored, class T>
void convert_all(const std::uint8_t* numbers, std::size_t count, T* out) {
  if constexpr (std::is_same_v<Stored, T>) {
    std::memcpy(out, numbers, count * sizeof(T));
  } else {
    for (std::size_t i = 0; i < count; ++i, numbers += sizeof(Stored)) {
      Stored stored;
      std::memcpy(&stored, numbers, sizeof stored);
      out[i] = converted<T>(stored);
    }
  }
}

template <class Number>
void swap_all(std::uint8_t* numbers, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::reverse(numbers + i * sizeof(Number), numbers + (i + 1) * sizeof(Number));
  }
}

}  // namespace

std::size_t byte_size(NumberType type) {
  constexpr std::array<std::size_t, 12> kBytes{1, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool is_float(NumberType type) {
  return type == NumberType::Float16 || type == NumberType::Float32 || type == NumberType::Float64;
}

const char* number_name(NumberType type) {
  constexpr const char* kNames[] = {"bool",   "int8",  "uint8",  "int16",   "uint16",  "int32",
                                    "uint32", "int64", "uint64", "float16", "float32", "float64"};
  return kNames[static_cast<int>(type)];
}

void swap_bytes(NumberType type, std::size_t count, std::uint8_t* numbers) {
  switch (byte_size(type)) {
    case 2:
      return swap_all<std::uint16_t>(numbers, count);
    case 4:
      return swap_all<std::uint32_t>(numbers, count);
    case 8:
      return swap_all<std::uint64_t>(numbers, count);
    default:
      return;
  }
}

template <class T>
void convert_numbers(NumberType type, const std::uint8_t* numbers, std::size_t count, T* out) {
  switch (type) {
    case NumberType::Bool:
    case NumberType::UInt8:
      return convert_all<std::uint8_t>(numbers, count, out);
    case NumberType::Int8:
      return convert_all<std::int8_t>(numbers, count, out);
    case NumberType::Int16:
      return convert_all<std::int16_t>(numbers, count, out);
    case NumberType::UInt16:
      return convert_all<std::uint16_t>(numbers, count, out);
    case NumberType::Int32:
      return convert_all<std::int32_t>(numbers, count, out);
    case NumberType::UInt32:
      return convert_all<std::uint32_t>(numbers, count, out);
    case NumberType::Int64:
      return convert_all<std::int64_t>(numbers, count, out);
    case NumberType::UInt64:
      return convert_all<std::uint64_t>(numbers, count, out);
    case NumberType::Float16:
      return convert_all<Half>(numbers, count, out);
    case NumberType::Float32:
      return convert_all<float>(numbers, count, out);
    case NumberType::Float64:
      return convert_all<double>(numbers, count, out);
  }
}

template void convert_numbers(NumberType, const std::uint8_t*, std::size_t, std::uint8_t*);
template void convert_numbers(NumberType, const std::uint8_t*, std::size_t, std::uint16_t*);
template void convert_numbers(NumberType, const std::uint8_t*, std::size_t, std::int32_t*);
template void convert_numbers(NumberType, const std::uint8_t*, std::size_t, float*);

}  // namespace episcope::io
