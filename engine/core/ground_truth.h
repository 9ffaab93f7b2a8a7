// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/image.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Scenes of the 2016 benchmark with metrics of their own.
enum class StratifiedScene { None, Backgammon, Dots, Pyramids, Stripes };

/// By its name in the benchmark, "backgammon" …; None for any other.
[[nodiscard]] StratifiedScene stratified_scene(const std::string& name);

/// How many pixels of the high resolution lie along one pixel of the views.
inline constexpr int kHighResScale = 10;

/// Ground truth and region masks of the center view at `kHighResScale` times its resolution, on
/// which the 2016 benchmark scores what lies at the borders of objects [HJKG16]. Its 5120×5120
/// samples are 105 MB: every call reads them anew, and the caller releases them. May be called from
/// any thread.
class HighResTruth {
 public:
  HighResTruth() = default;
  HighResTruth(const HighResTruth&) = delete;
  HighResTruth& operator=(const HighResTruth&) = delete;
  virtual ~HighResTruth() = default;

  /// Disparity in px of the views per view step, `[y][x]`; not finite = no truth. Throws IoError,
  /// also if it is not `kHighResScale` times as large as the views, or takes more memory than is
  /// granted.
  [[nodiscard]] virtual Image<float> read_disparity() const = 0;
  /// Names of the region masks, sorted.
  [[nodiscard]] virtual std::vector<std::string> regions() const = 0;
  /// The mask of a region among `regions`, as stored: 0 = outside, else inside, or the number of a
  /// part. Throws IoError.
  [[nodiscard]] virtual Image<std::uint8_t> read_region(const std::string& name) const = 0;
  /// Tells it from other truths without reading it: names, sizes and times of files.
  [[nodiscard]] virtual std::string identity() const = 0;
};

using HighResTruthPtr = std::shared_ptr<const HighResTruth>;

/// A truth whose disparities are larger by `by_px`; null stays null.
[[nodiscard]] HighResTruthPtr shifted(HighResTruthPtr truth, float by_px);

/// The ground truth of a light field, kept apart from it so that no estimator can see it. Every
/// part may be missing. Parts cover all views or the center view only.
struct GroundTruth {
  DisparityField field;  ///< Disparity; `valid` holds the archive's GT_DEPTH_MASK and finiteness.
  DisparityField foreground;       ///< Of transparent scenes: the surface,
  DisparityField background;       ///< and what is seen through it.
  ViewStack<std::int32_t> labels;  ///< Object label per pixel (GT_LABELS, object ids).
  /// Region masks by name ("discontinuities", "planes", …), center view, non-zero = inside; those
  /// whose parts are numbered (`is_numbered_region`) hold the numbers.
  std::map<std::string, Image<std::uint8_t>> regions;
  HighResTruthPtr high_res{};  ///< Of the center view; null = there is none.
  /// The scene of the 2016 benchmark, if its files name one.
  StratifiedScene stratified = StratifiedScene::None;
  /// How the disparity was estimated, if it is a result that took the place of truth.
  std::optional<Provenance> estimated{};

  [[nodiscard]] bool has_disparity() const { return !field.empty(); }
  [[nodiscard]] bool has_layers() const { return !foreground.empty() && !background.empty(); }
};

/// "estimated by plane_pm from cotton/lf.h5".
[[nodiscard]] std::string estimated_text(const Provenance& estimated);

/// Whether the mask of this name tells parts of a scene of the 2016 benchmark apart by numbers.
[[nodiscard]] inline bool is_numbered_region(const std::string& name) {
  return name == "boxes" || name == "dots_by_size" || name == "vertical_bins";
}

using GroundTruthPtr = std::shared_ptr<const GroundTruth>;

}  // namespace episcope
