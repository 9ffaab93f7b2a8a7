// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace episcope::test {

/// What a process is refused from now on, by the kernel; for good, as a process cannot take it
/// back. Files that are open on 0, 1 and 2 stay writable.
struct Quota {
  std::string name;
  std::string sentence;  ///< Words that the user is told.
  void (*begin)(std::uint64_t bytes);
  /// Whether `bytes`, which a file may have, mean anything to it.
  bool has_limit = false;
};

/// A user's quota that is used up as a file is made, written or flushed (EDQUOT), and a limit on
/// the size of a file (EFBIG).
[[nodiscard]] std::vector<Quota> quotas();

}  // namespace episcope::test
