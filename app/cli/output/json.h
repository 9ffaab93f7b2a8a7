// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/parameter/parameter.h"

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace episcope::cli {

/// A value of an answer in JSON. Objects keep the order in which their keys were added. Plain data,
/// because the header of the library that writes it takes longer to compile than a verb.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;
  using Value =
      std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object>;

  Json() = default;  // null
  Json(bool value) : value_(value) {}
  template <std::integral Integer>
  Json(Integer value) : value_(static_cast<std::int64_t>(value)) {}
  Json(double value) : value_(value) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <class Item>
  Json(const std::vector<Item>& items) : value_(Array(items.begin(), items.end())) {}
  static Json array(Array items = {}) { return Json(Value(std::move(items))); }
  static Json object(Object members = {}) { return Json(Value(std::move(members))); }

  /// The member of that name; makes it, and of null an object, if there is none.
  Json& operator[](const std::string& key);
  /// Makes an array of null.
  void push_back(Json item);

  [[nodiscard]] const Value& value() const { return value_; }

 private:
  explicit Json(Value value) : value_(std::move(value)) {}

  Value value_;
};

/// "auto" or "found" for an interval that is not set, else [A, B].
[[nodiscard]] Json value_json(const ParameterValue& value);
/// Without digits that say nothing: ends of single precision in the shortest text that reads back
/// as the same.
[[nodiscard]] Json interval_json(const Interval& interval);
[[nodiscard]] Json view_json(ViewIndex view);
/// Values by key, for people: what is not set is a word, where files have null
/// (io::parameters_json).
[[nodiscard]] Json parameters_json(const ParameterSet& parameters);
/// The one JSON object of an answer, on standard output.
void print_json(const Json& json);

}  // namespace episcope::cli
