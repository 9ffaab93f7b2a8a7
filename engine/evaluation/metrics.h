// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/schema.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// Named protocols, never mixed.
enum class Protocol {
  Vmv2013,       ///< All pixels with truth; mean squared error ×100 [WMG13].
  Benchmark2016  ///< A border of 15 px is ignored; BadPix, Q25, region metrics [HJKG16].
};

[[nodiscard]] const char* protocol_name(Protocol protocol);  ///< "vmv2013", "benchmark2016".
[[nodiscard]] Names<Protocol> names_of(Protocol);

/// How evaluated pixels count where the estimate has no value.
enum class InvalidEstimates {
  /// Never an advantage: bad in every percentage, the farthest true disparity for MSE and the error
  /// map, last in the order of Q25, at the clip for bumpiness, 180° for normals.
  Bad,
  /// As in the official 2016 tool: good in BadPix, fattening and thinning, ignored in all others.
  Compatible,
};
[[nodiscard]] Names<InvalidEstimates> names_of(InvalidEstimates);

struct EvaluationOptions {
  Protocol protocol = Protocol::Vmv2013;
  InvalidEstimates invalid = InvalidEstimates::Bad;
  /// For the angular error of normals; absent from the numbers unless `camera.is_known()`.
  CameraGrid camera{};
  /// Pixels of the judged view that the light field shows, 0 = not, which are not judged; empty =
  /// all. Borrowed.
  ImageView<const std::uint8_t> shown{};
  /// Of the judged view: what official keys of some metrics are computed from. Borrowed; may be
  /// null.
  const HighResTruth* high_res = nullptr;
  /// None = the scene of the 2016 benchmark is told by the names of its masks, if it is one.
  StratifiedScene stratified = StratifiedScene::None;
  Progress progress{};  ///< Where evaluations in high resolution learn that they are cancelled.
};

/// Pixels that `Protocol::Benchmark2016` ignores on each side.
inline constexpr int kBenchmarkBorder = 15;

/// Numbers by key ("mse_100", "badpix_0070", "density", …) in the order of tables. A metric that a
/// protocol or a scene lacks is absent, never 0.
using Metrics = std::vector<std::pair<std::string, double>>;

[[nodiscard]] std::optional<double> find_metric(const Metrics& metrics, const std::string& key);

/// Error of one view, and the numbers that were computed from it.
struct Evaluation {
  Metrics metrics;
  Image<float> signed_error;         ///< truth − estimate in px; 0 where not judged.
  Image<std::uint8_t> judged;        ///< 1 = pixel counts in the numbers.
  Image<std::uint8_t> missing;       ///< 1 = judged, but the estimate has no value there.
  std::vector<std::string> notes{};  ///< Sentences: which metrics are missing, and why.
};

/// Judges one view of an estimate against one map of truth. `regions` may be empty.
///
/// Keys of vmv2013: mse_100 over all pixels with truth, mse_100_inset15 without a border of 15 px,
/// density (% of the judged pixels that have a value).
/// If some have none and count as bad, either protocol adds mse_100_present, over the others alone,
/// and benchmark2016 badpix_0070_present; `notes` tell both numbers above 0.1 %.
/// With `options.shown`, either protocol adds "shown" (% of the pixels with truth that are shown).
/// Keys of benchmark2016: mse_100; badpix_0010, badpix_0030, badpix_0070 (% with |error| strictly
/// above); q_25_100 (sorted(|error|·100)[⌊0.25·n⌋]); density; and for the regions there are:
/// bumpiness_planes_100_0050, bumpiness_contin_surfaces_100_0050 (region smooth_surfaces),
/// mae_planes, mae_contin_surfaces (median angle between normals in degrees); of pyramids
/// bumpiness_slanted_100_0050 (sphere_in, sphere_out and pyramids) and bumpiness_parallel_100_0050
/// (plane); and those of `masked_metrics`.
/// A key is the official one only where the computation is: masked metrics, and all of backgammon,
/// dots and stripes but density, need `options.high_res`; the same numbers of the resolution of the
/// views end in "_lowres". Errors are float and thresholds are rounded to float, as in the official
/// tool. Source: Wanner et al. 2013 [WMG13], Honauer et al. 2016 [HJKG16] and the benchmark's
/// evaluation toolkit.
/// Throws InvalidInput if the sizes differ or no pixel can be judged; Cancelled.
[[nodiscard]] Evaluation evaluate(const DisparityView& estimate, const DisparityView& truth,
                                  const std::map<std::string, Image<std::uint8_t>>& regions,
                                  const EvaluationOptions& options);

/// Judges each layer of a two-layer estimate against its own truth with its own mask.
struct LayeredEvaluation {
  Evaluation foreground;
  Evaluation background;
  /// Where the truth has one surface: the foreground, as the single map of methods that estimate
  /// one layer. None if there is no such truth.
  std::optional<Evaluation> single;
  /// Percentage of the pixels with truth whose number of layers is correct; two where both truths
  /// have a value. None if the estimate does not state the number.
  std::optional<double> layers_right;
};

/// All numbers: those of one surface as of any other estimate; those of both layers, whose keys end
/// in "_foreground" and "_background"; then "layers_right".
[[nodiscard]] Metrics layered_metrics(const LayeredEvaluation& evaluation);

/// Region masks of the truth count in its center view only.
/// Throws InvalidInput if estimate or truth lacks a layer in `view`, and as `evaluate`.
[[nodiscard]] LayeredEvaluation evaluate_layers(const LayeredDisparity& estimate,
                                                const GroundTruth& truth, ViewIndex view,
                                                const EvaluationOptions& options);

/// Runtime class of vmv2013: "fast" (< 5 s), "medium" (up to 1 min), "slow".
[[nodiscard]] const char* runtime_class(double seconds);

/// Maps of an evaluation, from the very errors that its numbers were computed from. What
/// `evaluation.judged` leaves out belongs to no map.

/// 1 where the estimate has a value, evaluated or not; elsewhere there is no error to show.
[[nodiscard]] Image<std::uint8_t> present_mask(const Evaluation& evaluation);

/// |truth − estimate| in px.
[[nodiscard]] Image<float> absolute_error_map(const Evaluation& evaluation);

/// Threshold of the map of bad pixels, px; strictly above is bad [HJKG16].
inline constexpr double kBadPixelThreshold_px = 0.07;

/// The places of good and bad pixels in a color map from 0 (green) to 1 (red).
inline constexpr float kGoodPixel = 0.2F;
inline constexpr float kBadPixel = 1.0F;

/// kBadPixel where |error| is strictly above `threshold_px` or the estimate is missing, else
/// kGoodPixel.
[[nodiscard]] Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px);

/// How far the points of one cloud are from another one, in units of the scene.
struct CloudDistance {
  Image<float> distance;   ///< `[y][x]`, of the point of each pixel; NaN = there is none.
  std::size_t points = 0;  ///< How many distances there are.
  double mean = 0;
  double median = 0;
  double percentile95 = 0;  ///< 95 % of the points are at most that far away.
};

/// The distance of every point of `estimate` to the nearest point of `reference`, wherever in the
/// view that is seen (cloud-to-cloud distance): both are maps of one view, placed by
/// `BackProjection`. It is directed: what `reference` has and `estimate` lacks does not count.
/// Exact; a search tree by Boost.Geometry (R*-tree, packed) for each band of rows. Does not depend
/// on the number of threads. Throws InvalidInput if the camera is not known, sizes differ or a map
/// has no point; Cancelled.
[[nodiscard]] CloudDistance cloud_distance(const DisparityView& estimate,
                                           const DisparityView& reference, const CameraGrid& camera,
                                           const Progress& progress);

}  // namespace episcope
