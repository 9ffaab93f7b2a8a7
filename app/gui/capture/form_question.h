// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QString>

#include <functional>
#include <vector>

class QWidget;

namespace episcope {

/// Values that are asked for in a dialog that blocks nothing.
struct FormQuestion {
  QString name;  ///< Of the dialog, as an object.
  QString title;
  QString accept;  ///< Text of the button that goes on.
  std::vector<ParameterDescription> parameters;
  ParameterSet values{};  ///< To begin with, in place of defaults.
};

/// `answer` is called with all values if the user goes on.
void ask_for_values(QWidget* window, const FormQuestion& question,
                    std::function<void(const ParameterSet& values)> answer);

}  // namespace episcope
