// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/hash.h"

#include <charconv>

namespace episcope {

std::string hash_digits(std::uint64_t hash) {
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); hash != 0; ++digit, hash >>= 4) {
    *digit = "0123456789abcdef"[hash & 15];
  }
  return digits;
}

std::uint64_t hash_from_digits(std::string_view digits) {
  std::uint64_t hash = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), hash, 16);
  return hash;
}

}  // namespace episcope
