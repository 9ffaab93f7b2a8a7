// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/parameter/parameter.h"

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// The one description of a parameter struct `P`: keys, labels, help, units, domains; defaults are
/// those of a value-initialised `P`. The form in the window, the options of the command line, JSON
/// and validation all come from it. A parameter's range stands here and nowhere else.
template <class P>
class Schema {
 public:
  struct Text {
    const char* label;
    const char* help;
    const char* unit = "";
  };
  struct Domain {
    double min;
    double max;
    bool logarithmic = false;
  };

  Schema& real(const char* key, double P::*member, Text text, Domain domain) {
    return add(key, member, text, domain);
  }
  Schema& integer(const char* key, int P::*member, Text text, Domain domain) {
    return add(key, member, text, domain);
  }
  Schema& flag(const char* key, bool P::*member, Text text) {
    return add(key, member, text, {0, 1});
  }
  Schema& choice(const char* key, std::string P::*member, Text text,
                 std::vector<std::string> choices) {
    add(key, member, text, {0, 0});
    descriptions_.back().choices = std::move(choices);
    return *this;
  }
  Schema& interval(const char* key, IntervalOrAuto P::*member, Text text, Domain domain) {
    return add(key, member, text, domain);
  }
  Schema& view(const char* key, ViewOrAuto P::*member, Text text) {
    return add(key, member, text, {0, 0});
  }

  /// What else must hold of parameters: `complete` is called on all that `parse` returns, and may
  /// change some by others.
  Schema& completed_by(std::function<void(P&)> complete) {
    complete_ = std::move(complete);
    return *this;
  }

  /// Names the values that a search for the best parameters tries for a number or flag (0, 1), in
  /// place of those named before; the grid of a method is the product over its parameters. Throws
  /// InvalidInput for an unknown key or a value outside the domain.
  Schema& search(const char* key, std::initializer_list<double> values) {
    std::vector<ParameterValue> typed;
    for (const double value : values) typed.push_back(like_default(key, value));
    return search_values(key, std::move(typed));
  }
  /// Likewise for a choice.
  Schema& search_choices(const char* key, std::initializer_list<const char*> values) {
    const std::vector<std::string> strings(values.begin(), values.end());
    return search_values(key, std::vector<ParameterValue>(strings.begin(), strings.end()));
  }

  [[nodiscard]] const std::vector<ParameterDescription>& descriptions() const {
    return descriptions_;
  }

  /// Defaults, overridden by `values`. Throws InvalidInput for an unknown key (naming the nearest),
  /// a wrong type or a value outside its domain.
  [[nodiscard]] P parse(const ParameterSet& values) const {
    P parameters{};
    for (const auto& [key, value] : values) {
      const std::size_t index = index_of(key);
      check_parameter(descriptions_[index], value);
      write_[index](parameters, value);
    }
    if (complete_) complete_(parameters);
    return parameters;
  }

  /// Every parameter with its value, in the order of the schema.
  [[nodiscard]] ParameterSet values(const P& parameters) const {
    ParameterSet set;
    for (std::size_t i = 0; i < descriptions_.size(); ++i) {
      set.emplace_back(descriptions_[i].key, read_[i](parameters));
    }
    return set;
  }

 private:
  template <class T>
  Schema& add(const char* key, T P::*member, Text text, Domain domain) {
    descriptions_.push_back({key,
                             text.label,
                             text.help,
                             text.unit,
                             P{}.*member,
                             domain.min,
                             domain.max,
                             domain.logarithmic,
                             {},
                             {}});
    read_.push_back([member](const P& p) { return ParameterValue(p.*member); });
    write_.push_back([member](P& p, const ParameterValue& v) { p.*member = std::get<T>(v); });
    return *this;
  }

  [[nodiscard]] ParameterValue like_default(const char* key, double value) const {
    const ParameterValue& like = descriptions_[index_of(key)].default_value;
    if (std::holds_alternative<bool>(like)) return value != 0;
    if (std::holds_alternative<int>(like)) return static_cast<int>(value);
    return value;
  }

  Schema& search_values(const char* key, std::vector<ParameterValue> values) {
    ParameterDescription& description = descriptions_[index_of(key)];
    for (const auto& value : values) check_parameter(description, value);
    description.searched = std::move(values);
    return *this;
  }

  [[nodiscard]] std::size_t index_of(const std::string& key) const {
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < descriptions_.size(); ++i) {
      if (descriptions_[i].key == key) return i;
      keys.push_back(descriptions_[i].key);
    }
    const std::string nearest = nearest_name(key, keys);
    throw InvalidInput("there is no parameter '" + key + "'" +
                       (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }

  std::vector<ParameterDescription> descriptions_;
  std::vector<std::function<ParameterValue(const P&)>> read_;
  std::vector<std::function<void(P&, const ParameterValue&)>> write_;
  std::function<void(P&)> complete_;
};

}  // namespace episcope
