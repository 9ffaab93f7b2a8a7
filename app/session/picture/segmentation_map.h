// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/quantity_map.h"

namespace episcope {

/// Maps of Subject::Segmentation; as `make_map`, which calls it.
[[nodiscard]] std::shared_ptr<QuantityMap> make_segmentation_map(const MapSource& source);

}  // namespace episcope
