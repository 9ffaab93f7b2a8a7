// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/plenoptic/lens_grid.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::capture {

struct DecodeOptions {
  /// Views along each axis, odd; 0 = as many as a lens has room for at this step.
  int views = 0;
  /// Distance of neighboring views below a lens, px; 0 = 1, or a 15th of the pitch if that is more.
  double step_px = 0;
  bool is_linear = false;  ///< Leave out the gamma of the camera.
};

[[nodiscard]] Schema<DecodeOptions> decode_schema();

/// Pictures of one exposure. All are of one size and mosaic.
struct PlenopticPictures {
  RawPicture raw;
  std::optional<RawPicture> white;  ///< An even bright area, for vignetting and the lens grid.
  std::optional<RawPicture> dark;   ///< Without light, subtracted from both.
};

/// Throws InvalidInput, which names both, if white or dark picture are of another size or mosaic.
void require_matching(const PlenopticPictures& pictures);

struct Decoded {
  LightFieldPtr light_field;
  LensGrid grid;
  double step_px = 1;  ///< Distance of views on the sensor.
  int first_x = 0;     ///< Of the first pixel, from the one that lens (0, 0) is.
  int first_y = 0;
  double valid_percent = 100;  ///< Of the samples of all views.
  std::size_t hot_pixels = 0;  ///< Replaced by their neighbors.
  double sharpness = 0;        ///< Of the center view: rms of neighbor differences over contrast.
  bool is_gamma_encoded = false;  ///< Else samples are linear.
  std::vector<std::string> warnings;
};

/// The grid of the lenses, out of the white picture, else out of the raw picture itself. Throws
/// InvalidInput, Cancelled.
[[nodiscard]] LensGrid find_lenses(const PlenopticPictures& pictures, const Progress& progress);

/// Decodes a raw picture with the grid of its lenses: divides by the white picture, replaces hot
/// pixels, and samples each lens once for each view, each color between its own pixels below that
/// lens. Rows of views are rows of lenses; hexagonal rows are interpolated (Lanczos) to a square
/// lattice whose pixel is the row distance.
/// Samples are uint16: 1 is the sensor's saturation at the brightest lenses' centers, times the
/// camera's white balance and color matrix, gamma-encoded if the camera says so. Samples that
/// the lens or the main lens shade below 0.3, that lie below a neighboring lens, and lenses cut off
/// by the sensor, are invalid.
/// A pixel right of the lens's center belongs to a view on the right. Throws InvalidInput,
/// Cancelled.
[[nodiscard]] Decoded decode(const PlenopticPictures& pictures, const LensGrid& grid,
                             const DecodeOptions& options, const Progress& progress);

}  // namespace episcope::capture
