// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parameter.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace episcope::io {

/// Largest JSON file that is read, in bytes; files of Episcope have kilobytes.
inline constexpr std::uintmax_t kLargestJson = std::uintmax_t{32} << 20;
/// Deepest nesting; copying and writing of values recurse once a level.
inline constexpr int kDeepestJson = 64;

/// These are for nlohmann's json and ordered_json, and are compiled for both once.

/// Parses JSON. Throws Json::exception for malformed text, InvalidInput for more than kDeepestJson
/// levels.
template <class Json>
[[nodiscard]] Json parse_json(std::string_view text);
/// As parse_json; null for what that does not read.
template <class Json>
[[nodiscard]] Json json_or_null(std::string_view text);
/// Reads a JSON file. Throws as parse_json; IoError if it cannot be read or is larger than
/// kLargestJson.
template <class Json>
[[nodiscard]] Json read_json(const std::filesystem::path& path);
/// Writes JSON, on one line without an indent; bytes that are not UTF-8 become the replacement
/// character.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json, int indent = -1);

/// A whole number that fits an int. Throws Json::exception if it is no number, InvalidInput if it
/// does not fit, where nlohmann's own conversion is undefined.
template <class Json>
[[nodiscard]] int int_of(const Json& json) {
  const auto number = whole_int(json.template get<double>());
  if (!number) throw InvalidInput("there is " + json_text(json) + " where a whole number belongs");
  return *number;
}

/// JSON object of parameter values by key, in their order, as in result files, projects and answers
/// of the command line: booleans, whole and real numbers, strings, intervals and views `[a, b]`,
/// "auto" or "found" for those that are not set.
[[nodiscard]] nlohmann::ordered_json parameters_json(const ParameterSet& parameters);
/// Writes that object on one line; bytes that are not UTF-8 become the replacement character.
[[nodiscard]] std::string parameters_to_json(const ParameterSet& parameters);

/// Reads what `parameters_json` made, and null, which earlier versions wrote for "auto". Keeps
/// anything else, as foreign files may hold, as its JSON text; no JSON object gives an empty set.
[[nodiscard]] ParameterSet parameters_from(const nlohmann::ordered_json& object);
[[nodiscard]] ParameterSet parameters_from_json(const std::string& json);

}  // namespace episcope::io
