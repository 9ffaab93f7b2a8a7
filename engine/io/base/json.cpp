// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/json.h"

#include <nlohmann/json.hpp>

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
  return value.dump();
}

/// Earlier versions spelled the options for brightness with an s.
std::string present_key(std::string key) {
  if (key.ends_with("alise")) key[key.size() - 2] = 'z';
  return key;
}

/// Null for what is no JSON.
OrderedJson parsed(const std::string& text) {
  try {
    return parse_json<OrderedJson>(text);
  } catch (const OrderedJson::exception&) {
    return {};
  } catch (const InvalidInput&) {
    return {};
  }
}

}  // namespace

OrderedJson parameters_json(const ParameterSet& parameters) {
  OrderedJson object = OrderedJson::object();
  for (const auto& [key, value] : parameters) object[key] = to_json(value);
  return object;
}

std::string parameters_to_json(const ParameterSet& parameters) {
  return parameters_json(parameters).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
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
  return parameters_from(parsed(json));
}

}  // namespace episcope::io
