// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// What the name of a picture says about the views in it.
enum class MosaicName {
  Plain,     ///< Nothing.
  Mosaic,    ///< "lf.bmp", "lf.png", …: all views, in a way that is not told.
  Lenslets,  ///< "*_macpi.*", "*_lenslet.*", "*_lenslets.*".
  Eslf       ///< "*_eslf.*": lenslets of a Lytro camera.
};

/// Regardless of case. Plain for a file that is no image.
[[nodiscard]] MosaicName mosaic_name(const std::filesystem::path& path);

/// What the scene is called: "flower" of "Flower_eslf.png" and of "flower.png", in small letters.
[[nodiscard]] std::string scene_of_mosaic(const std::filesystem::path& path);

}  // namespace episcope::io
