// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/label_info.h"

#include <span>

namespace episcope::io {

/// The 14 classes of UrbanLF with their names and colours, ids from 1 on. Source: Sheng et al. 2022
/// (UrbanLF), table of classes.
[[nodiscard]] std::span<const LabelInfo> urban_classes();

/// The class of this colour; 0 if there is none. Black is the class "others".
[[nodiscard]] int urban_class_of(Rgb color);

}  // namespace episcope::io
