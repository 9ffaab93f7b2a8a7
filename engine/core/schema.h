// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/parameter.h"

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace episcope {

/// A value of an enumeration with the name it has on command lines and in files, and the label that
/// users read; without a label of its own, that is the name.
template <class E>
struct Named {
  E value;
  const char* name;
  const char* label = name;
};

/// All values of an enumeration, in the order in which users see them.
template <class E>
using Names = std::vector<Named<E>>;

/// An enumeration that users choose from. Beside it, in its namespace, stands the one list of its
/// names, a function that never looks at its argument:
///
///     enum class Profile { Tuned, Paper };
///     Names<Profile> names_of(Profile);
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires(E value) {
  { names_of(value) } -> std::same_as<Names<E>>;
};

/// The name of a value, which must have one.
template <NamedEnum E>
[[nodiscard]] std::string name_of(E value) {
  for (const Named<E>& each : names_of(value)) {
    if (each.value == value) return each.name;
  }
  assert(false);
  return {};
}

/// The names of all values.
template <NamedEnum E>
[[nodiscard]] std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Named<E>& each : names_of(E{})) names.emplace_back(each.name);
  return names;
}

/// The value of that name. Throws InvalidInput if there is none, naming the nearest.
template <NamedEnum E>
[[nodiscard]] E value_named(const std::string& name) {
  for (const Named<E>& each : names_of(E{})) {
    if (name == each.name) return each.value;
  }
  throw InvalidInput(no_such_name("value", name, all_names<E>()));
}

/// The single description of a parameter struct `P`: keys, labels, help, units, domains; defaults
/// come from a value-initialized `P`. The form in the window, the options of the command line,
/// JSON and validation are all derived from it. A struct may be composed of others that have
/// schemas of their own (`part`). Keys must be distinct.
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
  /// A flag that is off by default and that a command line sets by its bare name: `--key`.
  Schema& toggle(const char* key, bool P::*member, Text text) {
    flag(key, member, text);
    descriptions_.back().is_toggle = true;
    return *this;
  }
  /// One of the values of an enumeration; outside the struct it goes by its name.
  template <NamedEnum E>
  Schema& choice(const char* key, E P::*member, Text text) {
    add_as(
        key, text, {0, 0}, [member](const P& p) { return ParameterValue(name_of(p.*member)); },
        [member](P& p, const ParameterValue& value) {
          p.*member = value_named<E>(std::get<std::string>(value));
        });
    for (const Named<E>& each : names_of(E{})) {
      descriptions_.back().choices.emplace_back(each.name);
      descriptions_.back().choice_labels.emplace_back(each.label);
    }
    return *this;
  }
  /// Any text.
  Schema& text(const char* key, std::string P::*member, Text text) {
    return add(key, member, text, {0, 0});
  }
  Schema& interval(const char* key, IntervalOrAuto P::*member, Text text, Domain domain) {
    return add(key, member, text, domain);
  }
  Schema& view(const char* key, ViewOrAuto P::*member, Text text) {
    return add(key, member, text, {0, 0});
  }

  /// All parameters of a member that is a parameter struct of its own, as `schema` describes them.
  /// Defaults come from the member in a value-initialised `P`. Presets stay; searched values are
  /// dropped.
  template <class Part>
  Schema& part(Part P::*member, const Schema<Part>& schema) {
    for (std::size_t i = 0; i < schema.descriptions_.size(); ++i) {
      ParameterDescription description = schema.descriptions_[i];
      description.default_value = schema.read_[i](P{}.*member);
      description.searched.clear();
      for (Preset& preset : description.presets) preset.searched.clear();
      descriptions_.push_back(std::move(description));
      read_.push_back([member, read = schema.read_[i]](const P& p) { return read(p.*member); });
      write_.push_back([member, write = schema.write_[i]](P& p, const ParameterValue& value) {
        write(p.*member, value);
      });
    }
    return *this;
  }

  /// Moves a parameter before all others.
  Schema& begin_with(const char* key) {
    const auto index = static_cast<std::ptrdiff_t>(index_of(key));
    const auto move_first = [index](auto& list) {
      std::rotate(list.begin(), list.begin() + index, list.begin() + index + 1);
    };
    move_first(descriptions_);
    move_first(read_);
    move_first(write_);
    return *this;
  }

  /// With `choice` for the parameter `key`, other parameters have these defaults; whatever is given
  /// beside it still wins. Values of a whole join those of its parts. Throws InvalidInput for an
  /// unknown key or a value that a parameter does not take.
  Schema& preset(const char* key, const char* choice, const ParameterSet& values) {
    Preset& changed = preset_of(key, choice);
    for (const auto& given : values) {
      check_parameter(descriptions_[index_of(given.first)], given.second);
      std::erase_if(changed.values, [&](const auto& known) { return known.first == given.first; });
      changed.values.push_back(given);
    }
    return *this;
  }
  /// Values that a search tries for a number that the preset sets; without them it is not searched.
  Schema& preset_search(const char* key, const char* choice, const char* searched,
                        std::initializer_list<double> values) {
    std::vector<ParameterValue> typed;
    for (const double value : values) {
      typed.push_back(like_default(searched, value));
      check_parameter(descriptions_[index_of(searched)], typed.back());
    }
    preset_of(key, choice).searched.emplace_back(searched, std::move(typed));
    return *this;
  }

  /// Sets the values that a parameter search tries for a number or flag (0, 1), replacing any set
  /// before; the grid of a method is the product over its parameters. Throws InvalidInput for an
  /// unknown key or a value outside the domain.
  Schema& search(const char* key, std::initializer_list<double> values) {
    ParameterDescription& description = descriptions_[index_of(key)];
    std::vector<ParameterValue> typed;
    for (const double value : values) {
      typed.push_back(like_default(key, value));
      check_parameter(description, typed.back());
    }
    description.searched = std::move(typed);
    return *this;
  }

  [[nodiscard]] const std::vector<ParameterDescription>& descriptions() const& {
    return descriptions_;
  }
  [[nodiscard]] std::vector<ParameterDescription> descriptions() && {
    return std::move(descriptions_);
  }

  /// Throws InvalidInput for an unknown key, naming the nearest.
  [[nodiscard]] const ParameterDescription& description(const std::string& key) const {
    return descriptions_[index_of(key)];
  }

  /// Defaults, overridden by the presets that are chosen, and both by `values`. Throws InvalidInput
  /// for an unknown key (naming the nearest), a wrong type or a value outside its domain.
  [[nodiscard]] P parse(const ParameterSet& values) const {
    P parameters{};
    for (const ParameterSet& set : {preset_values(descriptions_, values), values}) {
      for (const auto& [key, value] : set) {
        const std::size_t index = index_of(key);
        check_parameter(descriptions_[index], value);
        write_[index](parameters, value);
      }
    }
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

  /// Those that are not the defaults.
  [[nodiscard]] ParameterSet changed_values(const P& parameters) const {
    ParameterSet set = values(parameters);
    std::erase_if(set, [this](const auto& each) {
      return each.second == description(each.first).default_value;
    });
    return set;
  }

 private:
  template <class>
  friend class Schema;

  using Read = std::function<ParameterValue(const P&)>;
  using Write = std::function<void(P&, const ParameterValue&)>;

  template <class T>
  Schema& add(const char* key, T P::*member, Text text, Domain domain) {
    return add_as(
        key, text, domain, [member](const P& p) { return ParameterValue(p.*member); },
        [member](P& p, const ParameterValue& value) { p.*member = std::get<T>(value); });
  }

  Schema& add_as(const char* key, Text text, Domain domain, Read read, Write write) {
    descriptions_.push_back({.key = key,
                             .label = text.label,
                             .help = text.help,
                             .unit = text.unit,
                             .default_value = read(P{}),
                             .min = domain.min,
                             .max = domain.max,
                             .logarithmic = domain.logarithmic});
    read_.push_back(std::move(read));
    write_.push_back(std::move(write));
    return *this;
  }

  [[nodiscard]] ParameterValue like_default(const char* key, double value) const {
    const ParameterValue& like = descriptions_[index_of(key)].default_value;
    if (std::holds_alternative<bool>(like)) return value != 0;
    if (std::holds_alternative<int>(like)) return static_cast<int>(value);
    return value;
  }

  Preset& preset_of(const char* key, const char* choice) {
    ParameterDescription& description = descriptions_[index_of(key)];
    check_parameter(description, std::string(choice));
    for (Preset& preset : description.presets) {
      if (preset.choice == choice) return preset;
    }
    return description.presets.emplace_back(Preset{choice, {}});
  }

  [[nodiscard]] std::size_t index_of(const std::string& key) const {
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < descriptions_.size(); ++i) {
      if (descriptions_[i].key == key) return i;
      keys.push_back(descriptions_[i].key);
    }
    throw InvalidInput(no_such_name("parameter", key, keys));
  }

  std::vector<ParameterDescription> descriptions_;
  std::vector<Read> read_;
  std::vector<Write> write_;
};

}  // namespace episcope
