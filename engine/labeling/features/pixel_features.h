// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <string>
#include <vector>

namespace episcope {

/// Features of the pixels of one view, `[y][feature][x]`.
using PixelFeatures = Volume<float>;

/// Which features are computed of a view.
struct PixelFeatureSet {
  bool with_disparity = false;  ///< The archive's sets with depth, else the one of a single view.
};

/// First of the three layers of Lab averaged within wider surfaces.
inline constexpr int kWiderSurfaceLayer = 12;

/// First of the two layers of the place, column and row.
inline constexpr int kPlaceLayer = 21;

/// First of the two layers of the disparity's slope, the last ones, with disparity.
inline constexpr int kDisparitySlopeLayer = 23;

/// What each layer of PixelFeatures holds, in their order: "red", "lightness, smoothed", …
[[nodiscard]] std::vector<std::string> pixel_feature_names(PixelFeatureSet set);

/// Computes the features of a view. Of the image: RGB and CIE Lab/100, Lab smoothed by a fine
/// Gaussian, and averaged within surfaces by two bilateral filters of 13 px; of lightness at a
/// scale of 1 px the gradient magnitude, the Laplacian, and the eigenvalues of Hessian and
/// structure tensor. The place of the pixel, carried along its ray to the centre view, x + d·(u −
/// u_c) and y + d·(v − v_c) in units of the larger side, so that it means the same in every view.
/// With `set.with_disparity`: how smoothed disparity is inclined along x and y, beside a jump that
/// of the pixel's own surface (disparity_slope.h). Disparity itself would
/// tie labels to the depths at which they were painted: ground at the depth of an object became the
/// object. label_surfaces.h compares it with the strokes instead.
///
/// `disparity` is that of the view, used to carry places in either set; without (empty), places are
/// those in the view itself. Invalid pixels take the disparity of their neighbours in the row.
///
/// The feature groups are those of the archive, "without" and "with depth" [WSG13]; the exact list
/// was not recovered. The usual Gaussian features of wide scales are left out: beside an outline
/// they resemble nothing in the middle of an object, where people paint, and cause halos of other
/// labels (tests/accuracy/tuning.md).
/// Throws InvalidInput if `set` asks for disparity and there is none; Cancelled.
[[nodiscard]] PixelFeatures compute_pixel_features(const LightField& light_field, ViewIndex view,
                                                   const DisparityView& disparity,
                                                   PixelFeatureSet set, const Progress& progress);

/// The disparity of a view without holes: an invalid pixel takes that of the nearest valid one of
/// its row, else of the row above; 0 if there is none at all.
[[nodiscard]] Image<float> filled_disparity(const DisparityView& disparity);

}  // namespace episcope
