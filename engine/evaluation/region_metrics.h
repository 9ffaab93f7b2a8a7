// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/image.h"
#include "engine/evaluation/metrics.h"
#include "engine/evaluation/resolved_errors.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// Input of region metrics besides the errors of an evaluation.
struct RegionInput {
  const DisparityView& estimate;
  const DisparityView& truth;
  const std::map<std::string, Image<std::uint8_t>>& regions;
  const EvaluationOptions& options;
};

/// Percentage of the judged pixels inside `region` (null = everywhere) with a signed error for
/// which `is_bad` holds. Missing pixels are bad or good as `invalid` says. Empty if no pixel is
/// inside.
template <class IsBad>
std::optional<double> bad_percentage(const Evaluation& evaluation,
                                     const Image<std::uint8_t>* region, InvalidEstimates invalid,
                                     IsBad is_bad) {
  std::size_t count = 0;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
    if (evaluation.judged.data()[i] == 0 || (region && region->data()[i] == 0)) continue;
    ++count;
    const bool counts_as_bad = evaluation.missing.data()[i] != 0
                                   ? invalid == InvalidEstimates::Bad
                                   : is_bad(evaluation.signed_error.data()[i]);
    if (counts_as_bad) ++bad;
  }
  if (count == 0) return std::nullopt;
  return 100.0 * static_cast<double>(bad) / static_cast<double>(count);
}

/// Appends the metrics of surfaces of benchmark2016, bumpiness and angles of normals, for the masks
/// there are. Regions with no judged pixel add nothing.
void append_region_metrics(Evaluation& evaluation, const RegionInput& input);

/// Angle in degrees between the surface normals of two disparity maps of the same size, NaN where
/// one of them has no normal. Normals come from depth by Scharr's kernel with wrapped borders, on
/// points (x, y)·Z as the 2016 benchmark places them: the origin is the first pixel and half the
/// sensor spans the image. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
/// `camera.focal_length` below 32 is in units of the larger side, as archive files store it, else
/// in px. Precondition: `camera.is_known()`.
[[nodiscard]] Image<float> angle_between_normals(const Image<double>& a, const Image<double>& b,
                                                 const CameraGrid& camera);

/// Frobenius norm of the Hessian of a map by the scale of the 2016 benchmark: Scharr's kernel
/// [3, 10, 3]/16 × [1, 0, −1] without the half, applied twice, so every second derivative counts
/// four times; all four terms enter the norm. The border is reflected (… b a | a b …). NaN samples
/// make their surroundings NaN. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
[[nodiscard]] Image<float> hessian_norm(const Image<double>& map);

/// Suffix of keys that the official tool computes in high resolution, for numbers of the low one.
inline constexpr const char* kLowResSuffix = "_lowres";

/// Numbers of benchmark2016 from errors alone.
struct BenchmarkMetrics {
  Metrics general;                 ///< Of all pixels: ResolvedErrors::general.
  Metrics masked;                  ///< Of regions: masked_metrics.
  std::vector<std::string> notes;  ///< Sentences: which numbers are missing, and why.
};

/// The scene of the benchmark whose rules and masks apply: from `options`, else from the names of
/// the masks.
[[nodiscard]] StratifiedScene scene_of(const RegionInput& input);

/// Official keys hold numbers that are computed as by the official tool: masked metrics, and all of
/// backgammon, dots and stripes, in high resolution; general metrics of other scenes in the
/// resolution of the views. Keys of the other numbers of low resolution end in `kLowResSuffix`.
/// High resolution is read here, one map and one mask or two at a time, and released. Files that
/// cannot be read are noted. Throws InvalidInput, Cancelled.
[[nodiscard]] BenchmarkMetrics benchmark_metrics(const RegionInput& input);

using RegionMask = std::shared_ptr<const Image<std::uint8_t>>;

/// The mask of a region at the resolution of the truth; null if the scene has none of this name.
/// Throws Error if it cannot be read.
using RegionLookup = std::function<RegionMask(const std::string& name)>;

/// Metrics of regions that the 2016 benchmark scores in high resolution; those for whose masks
/// there are, pixels nearer than `border` to the border of the truth left out but where said:
///
/// - discontinuities_0070 (region discontinuities), % with |error| > 0.07; fine_fattening_0150
///   (fine_surrounding) and fine_thinning_0150 (fine), % with an error < −0.15 and > 0.15;
/// - backgammon_fattening_0070 (foreground_fattening), % nearer than the middle between truth and
///   foreground, which is the truth of the row in column 14·scale; backgammon_thinning_0070
///   (foreground_thinning), % farther than the middle between truth and background, which is that
///   of the eleventh column from the right, of the truth whatever its scale;
/// - missed_dots_50_0400 (dots_by_size and boxes, which are numbered), % of the dots, one of each
///   size of 1 … 8 in each box, with at least half of their pixels off by more than 0.4 px, also
///   within the border; a dot without pixels is missed; background_mse_100 (background);
/// - low_texture_0070 (low_texture), dark_stripes_0070 (high_contrast) and bright_stripes_0070
///   (low_contrast), % with |error| > 0.07.
///
/// Thresholds in the keys of backgammon are names only. Metrics of backgammon, dots and stripes are
/// those of `scene` alone. Source: [HJKG16], evaluation toolkit. A metric whose mask cannot be read
/// or has another size adds the sentence to `problems`. Throws Cancelled.
[[nodiscard]] Metrics masked_metrics(const ResolvedErrors& errors, int border,
                                     StratifiedScene scene, const RegionLookup& region,
                                     std::vector<std::string>& problems);

}  // namespace episcope
