// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/save/file_name.h"

#include <algorithm>

namespace episcope {

std::string file_name_of(std::string name) {
  constexpr std::size_t longest = 80;
  std::ranges::replace_if(
      name, [](char each) { return std::string("/\\:*?\"<>|").find(each) != std::string::npos; },
      '_');
  return name.substr(0, longest);
}

}  // namespace episcope
