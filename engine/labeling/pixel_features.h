// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/forest.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace episcope {

/// How edges of image and disparity are distinguished from noise.
struct EdgeParameters {
  double image = 25;     ///< β: larger values respond to weaker image edges; ≥ 0.
  double disparity = 4;  ///< γ, per px of jump: likewise for disparity; ≥ 0.
  /// Weight of an image edge, in [0, 1], where disparity is known and does not jump: most such
  /// edges are texture.
  double texture = 0.4;
};

/// The probability of an edge at every pixel of a view, `[y][x]` in [0, 1], as EDGE_WEIGHTS of the
/// archive: 1 − exp(−β·m·|∇I| − γ·|∇d|), forward differences, samples in [0, 1], |∇I| over all
/// channels; m grows from `texture` to 1 with the largest jump within 2 px, because estimated jumps
/// lie beside the edges that they belong to. Views that `disparity` (which may be empty) does not
/// cover, and pixels where it is invalid, use the image alone. Throws InvalidInput on a wrong size,
/// Cancelled.
///
/// The archive does not say how its own weights were computed; this is the usual exponential of the
/// gradient, with disparity added.
[[nodiscard]] Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                                            const DisparityField& disparity,
                                            const EdgeParameters& parameters);
/// Edge probabilities of all views or of a rectangle of views, `[v][u][y][x]`. With the confidence
/// of the disparity, m tends to 1 and jumps tend to 0 where disparity is not trusted
/// (`disparity_trust`).
[[nodiscard]] ViewStack<float> edge_probabilities(const LightField& light_field,
                                                  const DisparityField& disparity,
                                                  const EdgeParameters& parameters,
                                                  const Progress& progress);
[[nodiscard]] ViewStack<float> edge_probabilities(const LightField& light_field,
                                                  ViewRectangle views,
                                                  const DisparityField& disparity,
                                                  const EdgeParameters& parameters,
                                                  const Progress& progress,
                                                  const ViewStack<float>* confidence = nullptr);

/// How far the disparity of each pixel is trusted as evidence for labels, `[y][x]` in [0, 1]:
/// min(c/(0.43·s), 1)². c is the confidence around the pixel (Gaussian, σ = 2 px); s is exceeded by
/// a tenth of the pixels, since methods scale confidence differently; 0 if s is 0. An estimate
/// without evidence follows its neighbors, and tells about their labels only. `confidence` `[y][x]`
/// in [0, 1].
[[nodiscard]] Image<float> disparity_trust(ImageView<const float> confidence);

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
/// structure tensor. The place of the pixel, carried along its ray to the center view, x + d·(u −
/// u_c) and y + d·(v − v_c) in units of the larger side, so that it means the same in every view.
/// With `set.with_disparity`: slopes of smoothed disparity along x and y, beside a jump the slope
/// of the pixel's own surface (`disparity_slopes`). Disparity itself would tie labels to the depths
/// at which they were painted: ground at the depth of an object became the object.
/// LabelSurfaces compares it with the strokes instead.
///
/// `disparity` of the view moves places to the center view in either set; if it is empty, places
/// are not moved. Invalid pixels take the disparity of their neighbors in the row.
///
/// The feature groups follow the archive, "without" and "with depth" [WSG13]; the exact list
/// was not recovered. The usual Gaussian features of wide scales are left out: beside an outline
/// they resemble nothing in the middle of an object, where people paint, and cause halos of other
/// labels (tests/accuracy/tuning.md).
/// Throws InvalidInput if `set` asks for disparity and there is none; Cancelled.
[[nodiscard]] PixelFeatures compute_pixel_features(const LightField& light_field, ViewIndex view,
                                                   const DisparityView& disparity,
                                                   PixelFeatureSet set, const Progress& progress);

/// The disparity of a view without holes: an invalid pixel takes the disparity of the nearest valid
/// one in its row, else of the row above; 0 if there is none at all.
[[nodiscard]] Image<float> filled_disparity(const DisparityView& disparity);

/// How a surface is inclined, in px of disparity per px along each image axis, `[y][x]`.
struct DisparitySlopes {
  Image<float> x;
  Image<float> y;
};

/// Slopes of a map without holes, positive where disparity grows with x or y. Of the differences to
/// the pixels 3 and 6 px away on either side the one of least magnitude counts, so that a pixel
/// beside a jump has the slope of its own surface; a part narrower than 3 px has the slope of the
/// jump. A map smaller than that along an axis has slope 0 along it.
[[nodiscard]] DisparitySlopes disparity_slopes(ImageView<const float> disparity);

/// L*a*b* (CIE 1976, white D65) divided by 100 of samples in [0, 1] of one channel or three, 32-bit
/// floats; three channels of the same size.
[[nodiscard]] cv::Mat lab_colors(const cv::Mat& samples);

/// Three channels of color, `[y][x]` each.
using ColorPlanes = std::array<Image<float>, 3>;

struct SurfaceFilter {
  double contrast = 0.1;  ///< σ of the difference of colors, summed over the channels; > 0.
  double scale_px = 6;    ///< σ of the distance; > 0.
  int radius_px = 6;      ///< Neighbors that are farther do not count.
  Isa isa = best_isa();   ///< Other than that for tests.
};

/// Colors averaged within a surface and not across its outline: the bilateral filter of Tomasi and
/// Manduchi 1998 with the sum of absolute differences, as cv::bilateralFilter, to about 10⁻⁶, and a
/// third of its time. Pixels beyond the border are those at the border. Throws Cancelled.
[[nodiscard]] ColorPlanes filter_surfaces(const ColorPlanes& colors, const SurfaceFilter& filter,
                                          const Progress& progress);

/// Appends the painted pixels of a view; `ids` (ascending) gives the index of each label.
/// Occasional features are the place, because short strokes say little about where the rest of a
/// label is, and the slope of disparity, because strokes lie in the middle of objects, but all of a
/// thin object lies beside a jump (tests/accuracy/tuning.md).
void append_samples(const ViewScribbles& painted, VolumeView<const float> features,
                    const std::vector<std::int32_t>& ids, ForestSamples& samples);

}  // namespace episcope
