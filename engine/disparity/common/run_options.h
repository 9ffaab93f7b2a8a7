// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/device.h"
#include "engine/core/parameter/named.h"
#include "engine/core/parameter/schema.h"

namespace episcope {

/// Which views an estimate should cover.
enum class ViewSelection { All, Center };
[[nodiscard]] Names<ViewSelection> names_of(ViewSelection);

[[nodiscard]] Names<Device> names_of(Device);

/// How a method is run, whichever it is.
struct RunOptions {
  ViewSelection views = ViewSelection::All;  ///< A method for single views estimates one anyway.
  Device device = Device::Auto;
  int threads = 0;  ///< At most so many; 0 = as many as its Progress allows.
};

[[nodiscard]] Schema<RunOptions> run_schema();

}  // namespace episcope
