// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/hash.h"

#include <fmt/format.h>

#include <charconv>

namespace episcope {

std::string hash_digits(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::uint64_t hash_from_digits(std::string_view digits) {
  std::uint64_t hash = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), hash, 16);
  return hash;
}

}  // namespace episcope
