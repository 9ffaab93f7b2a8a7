// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/excerpt_attributes.h"

#include "engine/io/durable/system_error.h"
#include "engine/io/maps/parse_number.h"

#include <fstream>
#include <sstream>

namespace episcope::io {

ExcerptAttributes read_excerpt_attributes(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  ExcerptAttributes attributes;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string value;
    std::string name;
    words >> value >> name;
    const auto number = parse_number(value);
    if (number && name.starts_with("//")) attributes[name.substr(2)] = *number;
  }
  return attributes;
}

}  // namespace episcope::io
