// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace episcope {

/// The 64-bit FNV-1a hash (Fowler, Noll and Vo) of all that is added, in that order. It tells
/// things apart; it does not protect against forgery. Values are stored in files: the same input
/// always gives the same value.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) add_word(static_cast<unsigned char>(byte));
  }
  /// Takes a whole word in one step: eight times as fast, and another value than its bytes give.
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
