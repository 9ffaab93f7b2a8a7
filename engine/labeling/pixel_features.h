// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/volume.h"

#include <string>
#include <vector>

namespace episcope {

/// Features of the pixels of one view, `[y][feature][x]`.
using PixelFeatures = Volume<float>;

/// Which features are computed of a view.
struct PixelFeatureSet {
  bool with_disparity = false;  ///< The archive's sets with depth, else the one of a single view.
};

/// What each layer of PixelFeatures holds, in their order: "red", "lightness, smoothed 1 px", …
[[nodiscard]] std::vector<std::string> pixel_feature_names(PixelFeatureSet set);

/// Computes the features of a view. Of the image: RGB in [0, 1]; CIE Lab in 1/100, plain and
/// smoothed by Gaussians; of lightness at several scales σ the gradient magnitude, the Laplacian of
/// Gaussian, and the eigenvalues of Hessian and structure tensor, made comparable between scales by
/// factors σ and σ². The place of the pixel, carried along its ray to the centre view, x + d·(u −
/// u_c) and y + d·(v − v_c) in units of the larger side, so that it means the same in every view.
/// With `set.with_disparity`: disparity, smoothed disparity and its gradient magnitude.
///
/// `disparity` is that of the view, used to carry places in either set; without (empty), places are
/// those in the view itself. Invalid pixels take the disparity of their neighbours in the row.
/// The feature groups are those of the archive ("without" and "with depth") [WSG13]; the list was
/// not recovered. Chosen of groups usual for pixel classification (Sommer et al. 2011, ilastik):
/// places raise accuracy most, since strokes lie where their objects are.
/// Throws InvalidInput if `set` asks for disparity and there is none.
[[nodiscard]] PixelFeatures compute_pixel_features(const LightField& light_field, ViewIndex view,
                                                   const DisparityView& disparity,
                                                   PixelFeatureSet set);

/// The disparity of a view without holes: an invalid pixel takes that of the nearest valid one of
/// its row, else of the row above; 0 if there is none at all.
[[nodiscard]] Image<float> filled_disparity(const DisparityView& disparity);

}  // namespace episcope
