// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/collection/collection.h"

#include "app/gui/collection/collection_controller.h"
#include "app/gui/collection/frame_controller.h"

namespace episcope {

void add_collection(const Workbench& bench) {
  new CollectionController(bench);
  new FrameController(bench);
}

}  // namespace episcope
