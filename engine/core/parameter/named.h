// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/parameter/parameter.h"

#include <cassert>
#include <concepts>
#include <string>
#include <type_traits>
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

}  // namespace episcope
