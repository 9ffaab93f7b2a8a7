// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/config_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/maps/parse_number.h"

#include <algorithm>
#include <fstream>

namespace episcope::io {
namespace {

std::string trimmed(const std::string& text) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  const auto begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto end = std::find_if_not(text.rbegin(), text.rend(), is_space).base();
  return begin < end ? std::string(begin, end) : std::string();
}

}  // namespace

ConfigFile::ConfigFile(const std::filesystem::path& path) : path_(path) {
  require_readable_file(path);
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || line[0] == '#' || line[0] == ';') continue;
    values_[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  }
}

std::optional<std::string> ConfigFile::text(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> ConfigFile::number(const std::string& key) const {
  const auto value = text(key);
  if (!value) return std::nullopt;
  const auto number = parse_number(*value);
  if (number) return number;
  throw IoError(path_, key + " is '" + *value + "', but must be a number; correct this file");
}

}  // namespace episcope::io
