// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/config_file.h"

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

/// Without what a comment adds behind the value: "100.0 ; mm".
std::string without_comment(const std::string& value) {
  for (const std::size_t mark :
       {value.find(" ;"), value.find(" #"), value.find("\t;"), value.find("\t#")}) {
    if (mark != std::string::npos) return without_comment(trimmed(value.substr(0, mark)));
  }
  return value;
}

/// With a decimal point where a program of a language with decimal commas wrote the file.
std::string with_point(std::string value) {
  const std::size_t comma = value.find(',');
  const bool is_decimal = comma != std::string::npos && comma > 0 &&
                          value.find_first_not_of("+-0123456789eE,") == std::string::npos &&
                          value.find(',', comma + 1) == std::string::npos;
  if (is_decimal) value[comma] = '.';
  return value;
}

}  // namespace

ConfigFile::ConfigFile(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || line[0] == '#' || line[0] == ';') continue;
    const std::string value = trimmed(line.substr(equals + 1));
    values_[trimmed(line.substr(0, equals))] = without_comment(value);
  }
}

std::optional<std::string> ConfigFile::text(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> ConfigFile::number(const std::string& key) const {
  const auto value = text(key);
  return value ? parse_number(with_point(*value)) : std::nullopt;
}

std::vector<std::string> ConfigFile::values_without_number(
    std::initializer_list<const char*> keys) const {
  std::vector<std::string> values;
  for (const char* key : keys) {
    const auto value = text(key);
    if (value && !number(key)) values.push_back(std::string(key) + " is '" + *value + "'");
  }
  return values;
}

}  // namespace episcope::io
