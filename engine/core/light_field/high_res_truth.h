// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// Scenes of the 2016 benchmark with metrics of their own.
enum class StratifiedScene { None, Backgammon, Dots, Pyramids, Stripes };

/// By its name in the benchmark, "backgammon" …; None for any other.
[[nodiscard]] StratifiedScene stratified_scene(const std::string& name);

/// How many pixels of the high resolution lie along one pixel of the views.
inline constexpr int kHighResScale = 10;

/// Ground truth and region masks of the centre view at `kHighResScale` times its resolution, on
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
  /// also if it has another size than that of the views times `kHighResScale`, or takes more memory
  /// than is granted.
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

/// The same with disparities larger by `by_px`; null stays null.
[[nodiscard]] HighResTruthPtr shifted(HighResTruthPtr truth, float by_px);

}  // namespace episcope
