// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/json.h"

#include "engine/io/base/files.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace episcope::io {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson to_json(const ParameterValue& value) {
  return std::visit(
      []<class T>(const T& held) -> OrderedJson {
        if constexpr (std::is_same_v<T, IntervalOrAuto>) {
          return held ? OrderedJson::array({held->min, held->max}) : OrderedJson(held.word());
        } else if constexpr (std::is_same_v<T, ViewOrAuto>) {
          return held ? OrderedJson::array({held->v, held->u})
                      : OrderedJson(IntervalOrAuto().word());
        } else {
          return held;
        }
      },
      value);
}

ParameterValue from_json(const OrderedJson& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_integer()) return value.get<int>();
  if (value.is_number()) return value.get<double>();
  if (value == IntervalOrAuto::found().word()) return IntervalOrAuto::found();
  if (value == IntervalOrAuto().word() || value.is_null()) return IntervalOrAuto{};
  if (value.is_string()) return value.get<std::string>();
  const bool is_pair = value.is_array() && value.size() == 2;
  if (is_pair && value[0].is_number_integer() && value[1].is_number_integer()) {
    return ViewOrAuto(ViewIndex{value[0].get<int>(), value[1].get<int>()});
  }
  if (is_pair && value[0].is_number() && value[1].is_number()) {
    return IntervalOrAuto(Interval{value[0].get<double>(), value[1].get<double>()});
  }
  return json_text(value);
}

/// Earlier versions spelled the options for brightness with an s.
std::string present_key(std::string key) {
  if (key.ends_with("alise")) key[key.size() - 2] = 'z';
  return key;
}

}  // namespace

template <class Json>
Json parse_json(std::string_view text) {
  return Json::parse(text, [](int depth, typename Json::parse_event_t, Json&) {
    if (depth <= kDeepestJson) return true;
    throw InvalidInput("lists are nested more than " + std::to_string(kDeepestJson) +
                       " levels deep");
  });
}

template <class Json>
Json json_or_null(std::string_view text) {
  try {
    return parse_json<Json>(text);
  } catch (const typename Json::exception&) {
    return {};
  } catch (const InvalidInput&) {
    return {};
  }
}

template <class Json>
Json read_json(const std::filesystem::path& path) {
  require_readable_file(path);
  if (std::filesystem::file_size(path) > kLargestJson) {
    throw IoError(path, "this file has more than " + std::to_string(kLargestJson >> 20) +
                            " MiB, which is too much for what it should hold; choose another");
  }
  std::ifstream file(path, std::ios::binary);
  return parse_json<Json>(std::string(std::istreambuf_iterator<char>(file), {}));
}

template <class Json>
std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

template nlohmann::json parse_json(std::string_view);
template OrderedJson parse_json(std::string_view);
template nlohmann::json json_or_null(std::string_view);
template OrderedJson json_or_null(std::string_view);
template nlohmann::json read_json(const std::filesystem::path&);
template OrderedJson read_json(const std::filesystem::path&);
template std::string json_text(const nlohmann::json&, int);
template std::string json_text(const OrderedJson&, int);

OrderedJson parameters_json(const ParameterSet& parameters) {
  OrderedJson object = OrderedJson::object();
  for (const auto& [key, value] : parameters) object[key] = to_json(value);
  return object;
}

std::string parameters_to_json(const ParameterSet& parameters) {
  return json_text(parameters_json(parameters));
}

ParameterSet parameters_from(const OrderedJson& object) {
  ParameterSet parameters;
  if (!object.is_object()) return parameters;
  for (const auto& [key, value] : object.items()) {
    parameters.emplace_back(present_key(key), from_json(value));
  }
  return parameters;
}

ParameterSet parameters_from_json(const std::string& json) {
  return parameters_from(json_or_null<OrderedJson>(json));
}

}  // namespace episcope::io
