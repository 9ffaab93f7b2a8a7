// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace episcope {

/// The 64-bit FNV-1a hash (Fowler, Noll and Vo) of everything added, in that order. It identifies
/// data; it does not protect against forgery. Hash values are stored in files: the same input
/// always gives the same value.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_word(static_cast<unsigned char>(byte));
  }
  /// Adds a whole word in one step: faster, but the value differs from adding its bytes.
  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 1099511628211ULL; }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

/// The 16 lower-case hexadecimal digits of a hash.
[[nodiscard]] std::string hash_digits(std::uint64_t hash);
/// The hash that `digits` spell; leading zeros may be missing. 0 if they spell none.
[[nodiscard]] std::uint64_t hash_from_digits(std::string_view digits);

}  // namespace episcope
