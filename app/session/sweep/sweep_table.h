// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/sweep/sweep.h"
#include "engine/core/text/text_table.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// What a sweep measures of its points.
enum class SweepMeasure { MseTimes100, BadPix007, BadPix003, BadPix001, Seconds, Change };

/// MSE is that of vmv2013, BadPix are those of benchmark2016, in low resolution where the official
/// one is another, and of the front where there are two layers. None if the point has none.
[[nodiscard]] std::optional<double> measure_of(const SweepPoint& point, SweepMeasure measure);

/// The points along the first parameter with one value of the second.
struct SweepLine {
  std::string name;  ///< "scale 0.8"; empty with one parameter.
  struct Place {
    double x;
    std::size_t point;  ///< Among those of the sweep.
  };
  std::vector<Place> places;  ///< In the order of x.
};

/// The points that lie on the grid, a line for each value of the second parameter.
[[nodiscard]] std::vector<SweepLine> lines_of(const std::vector<SweepPoint>& points,
                                              const std::vector<SweptParameter>& swept);

/// Mean of a measure over light fields at a point, which has the same place in all of them; none
/// unless each has that measure there.
[[nodiscard]] std::optional<double> mean_of(const std::vector<SweepScene>& scenes,
                                            std::size_t point, SweepMeasure measure);
/// How many points every one of them has.
[[nodiscard]] std::size_t common_count(const std::vector<SweepScene>& scenes);

/// A row for each point: the light field, the swept values, every metric ("vmv2013.mse_100"),
/// seconds, change and problem, with the same text columns for all after the light field.
[[nodiscard]] TextTable sweep_table(
    const std::vector<SweepScene>& scenes,
    const std::vector<std::pair<std::string, std::string>>& columns_of_all);

}  // namespace episcope
