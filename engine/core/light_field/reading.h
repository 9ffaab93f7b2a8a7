// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <algorithm>
#include <string>

namespace episcope {

/// How a light field was read: together with its source, all that is needed to read the same
/// samples again.
struct Reading {
  std::string reader;  ///< Id of the reader (engine/io/open); empty = unknown.
  ParameterSet
      options;  ///< Options that were set, by key (io::OpenOptions); others were automatic.
  friend bool operator==(const Reading&, const Reading&) = default;

  /// Null if the option was not set.
  [[nodiscard]] const ParameterValue* find(const std::string& key) const {
    const auto found = std::ranges::find(options, key, &ParameterSet::value_type::first);
    return found == options.end() ? nullptr : &found->second;
  }

  /// Key of the focus plane that was baked in (shear.h), px per view step.
  static constexpr const char* kFocus = "focus";
  [[nodiscard]] double focus_px() const {
    const ParameterValue* value = find(kFocus);
    const double* number = value ? std::get_if<double>(value) : nullptr;
    return number ? *number : 0;
  }
  void set_focus(double focus_px) {
    std::erase_if(options, [](const auto& option) { return option.first == kFocus; });
    if (focus_px != 0) options.emplace_back(kFocus, focus_px);
  }
};

}  // namespace episcope
