// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/files.h"

#include "app/gui/files/file_controller.h"

namespace episcope {

void add_files(const Workbench& bench) {
  new FileController(bench);
}

}  // namespace episcope
