// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/ray_superpixels.h"
#include "tests/accuracy/label_measure.h"

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::accuracy {

/// Shares of right pixels of the center view that a correcting user wants.
inline constexpr std::array kWantedShares = {0.90, 0.95, 0.98};
/// Strokes after which the user gives up.
inline constexpr int kMostCorrections = 150;

/// Strokes until each of kWantedShares was reached first; nullopt = not by kMostCorrections.
using CorrectionCounts = std::array<std::optional<int>, kWantedShares.size()>;

/// Has a user begin with a bare scene and stroke the largest wrong region of the center view
/// (add_correction) until all of kWantedShares are reached. While one label alone is painted, every
/// pixel has it. The scene's own strokes are not used, but only labels that have one are asked
/// for. With `wand`, superpixels of all views, the user first clicks into the middle of the region
/// with the tolerance that selects most, and takes the brush if that is less than half of the wrong
/// pixels of the label, or more than kWrongSelected of it is wrong at every tolerance. Null = the
/// brush alone.
[[nodiscard]] CorrectionCounts count_corrections(const PaintedScene& painted,
                                                 const LabelerParameters& parameters,
                                                 const LabelingDisparity& disparity,
                                                 const RaySuperpixels* wand = nullptr);
/// Share of what the wand shows that may be wrong for a user to click.
inline constexpr double kWrongSelected = 0.02;

/// Strokes that no way of labeling can do without: as many as there are labels, the largest first,
/// which together have each of kWantedShares of the pixels of `truth` (0 = not judged). A labeler
/// that had all of a label right after its first stroke would reach them. All counts are given.
[[nodiscard]] CorrectionCounts least_corrections(ImageView<const std::int32_t> truth);

/// The count that half of the scenes do not exceed; those that were not reached count as the most.
/// nullopt if that is among these, or if there are no counts.
[[nodiscard]] std::optional<int> median_count(std::vector<std::optional<int>> counts);

/// Writes what `sklearn_forest.py` needs of a scene into a folder named after it:
/// `features.npy` `[feature][y][x]` of the image of the center view, and `truth.npy` `[y][x]`,
/// 0 = not asked for. Throws IoError.
void export_features(const PaintedScene& painted, const std::filesystem::path& folder);

}  // namespace episcope::accuracy
