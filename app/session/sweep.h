// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/run_estimator.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/core/text_table.h"
#include "engine/evaluation/metrics.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// A parameter and the values that are tried.
struct SweptParameter {
  std::string key;
  std::vector<ParameterValue> values;  ///< Ascending, see `parse_sweep_values`.
};

/// The points of a sweep: `search_grid` over one or two parameters, all others as in `base`. The
/// first point is `base` itself, whether or not it lies on the grid. A point holds the swept
/// parameters. Throws InvalidInput for more than `kMaxSearchPoints` of them.
[[nodiscard]] std::vector<ParameterSet> sweep_points(
    const std::vector<ParameterDescription>& descriptions, const ParameterSet& base,
    const std::vector<SweptParameter>& swept);

struct SweepPoint {
  ParameterSet point{};    ///< The swept parameters.
  EstimatePtr estimate{};  ///< Of the center view; null if the run failed or it was dropped.
  Interval display_range{};
  double seconds = 0;
  Metrics vmv2013{};        ///< Empty without ground truth.
  Metrics benchmark2016{};  ///< Empty also for small views, see `judge_by_both`.
  /// Median of |disparity − disparity of the first point| over pixels with a value in both, px.
  std::optional<double> change_px{};
  std::string problem{};  ///< Why it failed, a sentence; empty = it did not.
};

/// Results of a sweep on one light field.
struct SweepScene {
  std::uint64_t scene = 0;  ///< OpenScene::id.
  std::string name;         ///< Of the light field.
  /// In the order of `sweep_points`; may be incomplete.
  std::vector<SweepPoint> points{};
};

/// Whether points were judged.
[[nodiscard]] bool has_truth(const SweepScene& scene);

/// A method with a grid of values of its parameters on one or several of the open light fields:
/// what was asked for, and the points that are there.
struct Sweep {
  std::uint64_t id = 0;  ///< Never given twice.
  EstimateRequest base;
  std::vector<SweptParameter> swept;  ///< One or two.
  std::vector<SweepScene> scenes;
  bool is_saved = false;  ///< A file of the user's holds what is there.
};

[[nodiscard]] bool is_of_scene(const Sweep& sweep, std::uint64_t scene);

/// Points of all scenes.
[[nodiscard]] std::size_t point_count(const Sweep& sweep);

/// Runs a point on the center view and judges it. `reference` is the estimate of the first point;
/// null while there is none. What the method throws is the problem of the point; throws Cancelled.
[[nodiscard]] SweepPoint run_sweep_point(const Scene& scene, const EstimateRequest& base,
                                         const ParameterSet& point, const Estimate* reference,
                                         const Progress& progress);

/// `values` overridden by `point`.
[[nodiscard]] ParameterSet values_at(const ParameterSet& values, const ParameterSet& point);

struct SweepPlace {
  std::size_t scene = 0;  ///< Among Sweep::scenes.
  std::size_t point = 0;
  friend bool operator==(const SweepPlace&, const SweepPlace&) = default;
};

/// The sweeps over open scenes. Unknown ids and places are ignored.
class SweepList {
 public:
  /// Maps beyond it are computed again when they are asked for: 64 of 512×512 px fit.
  static constexpr std::size_t kMapBudget = std::size_t{256} << 20;

  /// After every change that a project would keep. Listeners live as long as this.
  void on_changed(std::function<void()> listener) { listeners_.push_back(std::move(listener)); }

  [[nodiscard]] const std::vector<Sweep>& all() const { return sweeps_; }
  /// Null for an unknown id.
  [[nodiscard]] const Sweep* find(std::uint64_t id) const;
  /// Null for one that is not there.
  [[nodiscard]] const SweepPoint* find(std::uint64_t id, SweepPlace place) const;

  /// Returns the id that it is given. Of `sweep`, maps are not kept.
  std::uint64_t add(Sweep sweep);
  /// Adds the next point of a scene. Keeps its map if there is room.
  void add_point(std::uint64_t id, std::uint64_t scene, SweepPoint point);
  /// Sets the map of a point that was computed again.
  void set_map(std::uint64_t id, SweepPlace place, EstimatePtr map);
  void remove(std::uint64_t id);
  /// Notes that a file of the user's holds `written`; ignored if points came since.
  void mark_saved(const Sweep& written);
  /// Drops what was found on scenes that are not `open` any more.
  void keep_scenes(const std::vector<std::uint64_t>& open);

 private:
  [[nodiscard]] Sweep* find_own(std::uint64_t id);
  void changed() const {
    for (const auto& listener : listeners_) listener();
  }
  void keep_map(SweepPoint& point, EstimatePtr map) const;

  std::vector<std::function<void()>> listeners_;
  std::vector<Sweep> sweeps_;
  std::uint64_t last_id_ = 0;
};

enum class SweepMeasure { MseTimes100, BadPix007, BadPix003, BadPix001, Seconds, Change };

/// MSE by vmv2013; BadPix by benchmark2016, in low resolution where the official one differs, and
/// of the foreground of two layers. None if the point has none.
[[nodiscard]] std::optional<double> measure_of(const SweepPoint& point, SweepMeasure measure);

/// The points along the first parameter with one value of the second.
struct SweepLine {
  std::optional<ParameterValue> second{};  ///< Value of the second parameter; none with one.
  struct Place {
    double x;
    std::size_t point;  ///< Index among the points of the sweep.
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

/// Whether a sweep can vary a parameter: it is a number.
[[nodiscard]] bool can_sweep(const ParameterDescription& description);

/// Reads what a sweep tries: values after commas or spaces, "0.1, 0.2, 0.4"; or a range with the
/// number of values, "0.1:1.6:5", evenly or in powers as the description says. Ascending, none
/// twice. Throws InvalidInput, a sentence, for what is not a value of the parameter or in no form.
[[nodiscard]] std::vector<ParameterValue> parse_sweep_values(
    const ParameterDescription& description, const std::string& text);

/// What to try first, as text that can be read back: what a search tries, else five values around
/// the present one within the domain.
[[nodiscard]] std::string proposed_sweep_values(const ParameterDescription& description);

/// A number of a value that `can_sweep`.
[[nodiscard]] double number_of(const ParameterValue& value);

}  // namespace episcope
