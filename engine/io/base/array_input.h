// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

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
/// Whether integers of the type have a sign.
/// "uint8", "float16", …
[[nodiscard]] const char* number_name(NumberType type);

/// Reverses the bytes of each of `count` numbers.
void swap_bytes(NumberType type, std::size_t count, std::uint8_t* numbers);

/// Converts numbers in the byte order of this machine. To integers: clipped to their range, rounded
/// towards zero, NaN becomes 0. T: uint8, uint16, int32, float.
template <class T>
void convert_numbers(NumberType type, const std::uint8_t* numbers, std::size_t count, T* out);

using ArrayShape = std::vector<std::size_t>;

/// "9×9×512×512×3".
[[nodiscard]] std::string shape_text(const ArrayShape& shape);

/// Product of the lengths, or 2^63 if it is larger.
[[nodiscard]] std::size_t element_count(const ArrayShape& shape);

/// An array in a file, read block by block on demand.
class ArrayInput {
 public:
  virtual ~ArrayInput() = default;
  ArrayInput(const ArrayInput&) = delete;
  ArrayInput& operator=(const ArrayInput&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Lengths of the axes in C order: the last axis is contiguous in the file.
  [[nodiscard]] const ArrayShape& shape() const { return shape_; }
  [[nodiscard]] NumberType type() const { return type_; }
  /// Whether reading a block costs all data before it, as in compressed files. Such an array should
  /// be read once, from front to end.
  [[nodiscard]] virtual bool is_sequential() const { return false; }

  /// Lengths of the blocks that the file stores; they should be read whole.
  [[nodiscard]] virtual ArrayShape unit() const { return ArrayShape(shape_.size(), 1); }

  /// Reads `count[i]` elements from `start[i]` on along each axis, converted as `convert_numbers`.
  /// Throws IoError.
  template <class T>
  void read(const ArrayShape& start, const ArrayShape& count, T* out) const;

  /// Reads a block without conversion, in the byte order of this machine.
  void read_raw(const ArrayShape& start, const ArrayShape& count, std::uint8_t* out) const {
    read_block(start, count, out);
  }

 protected:
  ArrayInput(std::filesystem::path path, ArrayShape shape, NumberType type)
      : path_(std::move(path)), shape_(std::move(shape)), type_(type) {}

  /// As `read_raw`.
  virtual void read_block(const ArrayShape& start, const ArrayShape& count,
                          std::uint8_t* out) const = 0;

 private:
  std::filesystem::path path_;
  ArrayShape shape_;
  NumberType type_;
};

/// An array whose elements follow each other in the file.
class LinearArray : public ArrayInput {
 protected:
  using ArrayInput::ArrayInput;
  /// Elements `first` to `first + count`, in the byte order of this machine.
  virtual void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const = 0;

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override;
};

}  // namespace episcope::io
