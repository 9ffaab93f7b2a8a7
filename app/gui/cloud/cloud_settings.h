// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_choice.h"
#include "widgets/cloud/cloud_look.h"

namespace episcope {

/// What a user chose of the 3D view, kept from run to run.
struct CloudSettings {
  CloudChoice choice;
  CloudLook look;  ///< Stretch and cuts belong to a scene and are not kept.
  bool is_large = false;
};

[[nodiscard]] CloudSettings read_cloud_settings();
void write_cloud_settings(const CloudSettings& settings);

}  // namespace episcope
