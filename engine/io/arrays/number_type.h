// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace episcope::io {

/// Types of numbers that arrays in files consist of.
enum class NumberType {
  Bool,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float16,
  Float32,
  Float64
};

/// The type of the numbers that this program writes. T: uint8, uint16, int32, float.
template <class T>
[[nodiscard]] constexpr NumberType number_type_of() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return NumberType::UInt8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return NumberType::UInt16;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberType::Int32;
  if constexpr (std::is_same_v<T, float>) return NumberType::Float32;
}

[[nodiscard]] std::size_t byte_size(NumberType type);
[[nodiscard]] bool is_float(NumberType type);
/// Of integers.
[[nodiscard]] bool is_signed(NumberType type);
/// "uint8", "float16", …
[[nodiscard]] const char* number_name(NumberType type);

/// Reverses the bytes of each of `count` numbers.
void swap_bytes(NumberType type, std::size_t count, std::uint8_t* numbers);

/// Converts numbers in the byte order of this machine. To integers: clipped to their range, rounded
/// towards zero, NaN becomes 0. T: uint8, uint16, int32, float.
template <class T>
void convert_numbers(NumberType type, const std::uint8_t* numbers, std::size_t count, T* out);

}  // namespace episcope::io
