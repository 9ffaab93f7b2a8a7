// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <memory>
#include <optional>
#include <string>

namespace episcope {

/// A reading option: differences of brightness between views are left to the method.
inline constexpr const char* kKeepBrightness = "no-equalize";

/// A light field whose views are of one brightness, and how much they differed.
struct EvenLightField {
  LightField light_field;
  std::string note;  ///< For an estimate.
};

/// The views in one brightness: orientations of lines and differences between views, of which most
/// methods are made, take a gain for structure. A copy without the gains (measure_view_gains), if
/// one of them differs by more than 2 % from the gain of the center view; else nothing. Light
/// fields read with kKeepBrightness stay as they are. Measured, for which those on disk are read as
/// a whole, and copied once, to disk if it does not fit, and kept with the light field
/// (LightField::beside). Throws Cancelled, IoError if there is no room on the disk.
[[nodiscard]] std::shared_ptr<const std::optional<EvenLightField>> even_brightness(
    const LightField& light_field, const Progress& progress);

}  // namespace episcope
