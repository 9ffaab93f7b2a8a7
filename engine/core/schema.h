// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/parameter.h"

#include <cassert>
#include <concepts>
#include <cstddef>
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

/// What the schemas of all structs share: descriptions, and where the values lie in the struct.
class AnySchema {
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

 protected:
  /// A member of the struct: its place, in bytes from the beginning, and how it is read and
  /// written.
  struct Field {
    std::size_t place;
    ParameterValue (*read)(const void* member);
    void (*write)(void* member, const ParameterValue& value);
  };

  void add(const char* key, Text text, Domain domain, Field field, const void* defaults);
  void add_part(const AnySchema& part, std::size_t place, const void* defaults);
  void add_choice_names(const char* name, const char* label);
  void move_first(const char* key);
  void set_preset(const char* key, const char* choice, const ParameterSet& values);
  void set_preset_search(const char* key, const char* choice, const char* searched,
                         std::initializer_list<double> values);
  void set_search(const char* key, std::initializer_list<double> values);
  void write(const ParameterSet& values, void* parameters) const;
  [[nodiscard]] ParameterSet read(const void* parameters) const;
  [[nodiscard]] ParameterSet read_changed(const void* parameters) const;

  std::vector<ParameterDescription> descriptions_;

 private:
  [[nodiscard]] std::size_t index_of(const std::string& key) const;
  [[nodiscard]] std::vector<ParameterValue> like_default(
      const char* key, std::initializer_list<double> values) const;
  [[nodiscard]] Preset& preset_of(const char* key, const char* choice);

  std::vector<Field> fields_;
};

/// The single description of a parameter struct `P`: keys, labels, help, units, domains; defaults
/// come from a value-initialized `P`. The form in the window, the options of the command line,
/// JSON and validation are all derived from it. A struct may be composed of others that have
/// schemas of their own (`part`). Keys must be distinct.
template <class P>
class Schema : public AnySchema {
 public:
  Schema& real(const char* key, double P::*member, Text text, Domain domain) {
    return add_value(key, member, text, domain);
  }
  Schema& integer(const char* key, int P::*member, Text text, Domain domain) {
    return add_value(key, member, text, domain);
  }
  Schema& flag(const char* key, bool P::*member, Text text) {
    return add_value(key, member, text, {0, 1});
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
    const auto read = [](const void* from) {
      return ParameterValue(name_of(*static_cast<const E*>(from)));
    };
    const auto write = [](void* to, const ParameterValue& value) {
      *static_cast<E*>(to) = value_named<E>(std::get<std::string>(value));
    };
    add(key, text, {0, 0}, {place_of(member), read, write}, &defaults());
    for (const Named<E>& each : names_of(E{})) add_choice_names(each.name, each.label);
    return *this;
  }
  /// Any text.
  Schema& text(const char* key, std::string P::*member, Text text) {
    return add_value(key, member, text, {0, 0});
  }
  Schema& interval(const char* key, IntervalOrAuto P::*member, Text text, Domain domain) {
    return add_value(key, member, text, domain);
  }
  Schema& view(const char* key, ViewOrAuto P::*member, Text text) {
    return add_value(key, member, text, {0, 0});
  }

  /// All parameters of a member that is a parameter struct of its own, as `schema` describes them.
  /// Defaults come from the member in a value-initialized `P`. Presets stay; searched values are
  /// dropped.
  template <class Part>
  Schema& part(Part P::*member, const Schema<Part>& schema) {
    add_part(schema, place_of(member), &(defaults().*member));
    return *this;
  }

  /// Moves a parameter before all others.
  Schema& begin_with(const char* key) {
    move_first(key);
    return *this;
  }

  /// With `choice` for the parameter `key`, other parameters have these defaults; whatever is given
  /// beside it still wins. Values of a whole join those of its parts. Throws InvalidInput for an
  /// unknown key or a value that a parameter does not take.
  Schema& preset(const char* key, const char* choice, const ParameterSet& values) {
    set_preset(key, choice, values);
    return *this;
  }
  /// Values that a search tries for a number that the preset sets; without them it is not searched.
  Schema& preset_search(const char* key, const char* choice, const char* searched,
                        std::initializer_list<double> values) {
    set_preset_search(key, choice, searched, values);
    return *this;
  }
  /// Sets the values that a parameter search tries for a number or flag (0, 1), replacing any set
  /// before; the grid of a method is the product over its parameters. Throws InvalidInput for an
  /// unknown key or a value outside the domain.
  Schema& search(const char* key, std::initializer_list<double> values) {
    set_search(key, values);
    return *this;
  }

  /// Defaults, overridden by the presets that are chosen, and both by `values`. Throws InvalidInput
  /// for an unknown key (naming the nearest), a wrong type or a value outside its domain.
  [[nodiscard]] P parse(const ParameterSet& values) const {
    P parameters{};
    write(values, &parameters);
    return parameters;
  }
  /// Every parameter with its value, in the order of the schema.
  [[nodiscard]] ParameterSet values(const P& parameters) const { return read(&parameters); }
  /// Those that are not the defaults.
  [[nodiscard]] ParameterSet changed_values(const P& parameters) const {
    return read_changed(&parameters);
  }

 private:
  static const P& defaults() {
    static const P the_defaults{};
    return the_defaults;
  }

  template <class T>
  static std::size_t place_of(T P::*member) {
    const auto address = [](const auto& of) { return reinterpret_cast<const std::byte*>(&of); };
    return static_cast<std::size_t>(address(defaults().*member) - address(defaults()));
  }

  template <class T>
  Schema& add_value(const char* key, T P::*member, Text text, Domain domain) {
    const auto read = [](const void* from) { return ParameterValue(*static_cast<const T*>(from)); };
    const auto write = [](void* to, const ParameterValue& value) {
      *static_cast<T*>(to) = std::get<T>(value);
    };
    add(key, text, domain, {place_of(member), read, write}, &defaults());
    return *this;
  }
};

}  // namespace episcope
