// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/python/values.h"
#include "engine/core/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace episcope::python {

/// A light field as Python sees it, with what was read beside it. Immutable but for what is kept of
/// arrays that took a copy.
struct OpenedScene {
  std::shared_ptr<const Scene> scene;
  std::string input{};  ///< What opens it again; empty for an array.
  py::object truth{};   ///< The array of the true disparity, once it was asked for.

  [[nodiscard]] const LightField& light_field() const { return *scene->light_field; }
  /// What a user should know of how it was read, a sentence each.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Adds the class LightField, and `open`, `demo`, `epi`.
void add_light_fields(py::module_& module);

}  // namespace episcope::python
