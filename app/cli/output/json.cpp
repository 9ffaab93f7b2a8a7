// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>

namespace episcope::cli {
namespace {

using Written = nlohmann::ordered_json;

struct Writer {
  Written operator()(std::monostate) const { return nullptr; }
  Written operator()(const Json::Array& items) const {
    Written array = Written::array();
    for (const Json& item : items) array.push_back(std::visit(*this, item.value()));
    return array;
  }
  Written operator()(const Json::Object& members) const {
    Written object = Written::object();
    for (const auto& [key, member] : members) object[key] = std::visit(*this, member.value());
    return object;
  }
  template <class Plain>
  Written operator()(const Plain& value) const {
    return value;
  }
};

// Of a single, the shortest text that reads back as the same; of a double, without what rounding
// left of sums.
double without_excess_digits(double value) {
  constexpr double kRounding = 1e-12;
  const auto single = static_cast<float>(value);
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
  double shortest = value;
  std::from_chars(text.data(), end, shortest);
  const bool is_same = single == value || std::abs(shortest - value) < kRounding;
  return is_same ? shortest : value;
}

}  // namespace

Json& Json::operator[](const std::string& key) {
  if (std::holds_alternative<std::monostate>(value_)) value_ = Object();
  auto& members = std::get<Object>(value_);
  const auto found = std::ranges::find(members, key, &Object::value_type::first);
  if (found != members.end()) return found->second;
  return members.emplace_back(key, Json()).second;
}

void Json::push_back(Json item) {
  if (std::holds_alternative<std::monostate>(value_)) value_ = Array();
  std::get<Array>(value_).push_back(std::move(item));
}

Json value_json(const ParameterValue& value) {
  struct Maker {
    Json operator()(const IntervalOrAuto& interval) const {
      return interval ? interval_json(*interval) : Json(interval.word());
    }
    Json operator()(const ViewOrAuto& view) const { return view ? view_json(*view) : Json("auto"); }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(bool flag) const { return flag; }
    Json operator()(int number) const { return number; }
    Json operator()(double number) const { return number; }
  };
  return std::visit(Maker{}, value);
}

Json interval_json(const Interval& interval) {
  return Json::array({without_excess_digits(interval.min), without_excess_digits(interval.max)});
}

Json view_json(ViewIndex view) {
  return Json::array({view.v, view.u});
}

Json parameters_json(const ParameterSet& parameters) {
  Json json = Json::object();
  for (const auto& [key, value] : parameters) json[key] = value_json(value);
  return json;
}

void print_json(const Json& json) {
  // Names of files may be any bytes: those that are not UTF-8 become the replacement character.
  std::cout
      << std::visit(Writer{}, json.value()).dump(2, ' ', false, Written::error_handler_t::replace)
      << '\n';
}

}  // namespace episcope::cli
