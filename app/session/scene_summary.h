// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace episcope {

/// Facts about a scene beyond its shape. Linear in its pixels.
struct SceneSummary {
  struct Truth {
    std::string views;  ///< "all", "center", or "4,4".
    double valid_percent = 0;
    std::optional<Interval> center;  ///< Disparities in the center view, if it has any.
    Interval all;                    ///< In all views that have truth.
  };
  std::string sample_type;  ///< "uint8", "uint16", "float32".
  std::optional<Truth> truth;
  bool has_layers = false;
  std::string label_views;     ///< As Truth::views.
  std::vector<int> label_ids;  ///< Ascending.
  std::string painted_views;   ///< "4,4 4,5".
  double painted_percent = 0;  ///< Of the pixels of these.
  std::vector<int> scribble_ids;
};

[[nodiscard]] SceneSummary summarize(const Scene& scene);

/// Range and share of the valid values of maps.
struct MapSummary {
  Interval range{};  ///< {0, 0} if none is valid.
  double valid_percent = 0;
};
[[nodiscard]] MapSummary summarize(const DisparityField& field);

/// How samples were stored, and what estimators see of them.
[[nodiscard]] std::string samples_text(const Scene& scene);

/// "uint8", "uint16", "float32".
[[nodiscard]] const char* sample_type_name(SampleType type);

/// Share of pixels of all views that hold something that was seen, in percent.
[[nodiscard]] double valid_percent(const LightField& light_field);

/// Warnings that rows and columns of views may be exchanged, or disparities negated, where nothing
/// told them apart.
[[nodiscard]] std::vector<std::string> order_warnings(const ConventionReport& report);

/// One of a kind that FileUse counts: "mask of valid pixels" of "masks of valid pixels".
[[nodiscard]] std::string singular_kind(std::string kind);

/// "81 views, 1 disparity map; not used: 3 *.txt (notes.txt, …)"; `words` translates kinds and
/// kNotUsed. Empty if no folder was read.
inline constexpr const char* kNotUsed = "not used: ";
[[nodiscard]] std::string files_text(
    const ConventionReport& report,
    const std::function<std::string(const std::string&)>& words = std::identity{});

/// Range of disparities of a scene for display: of the truth in the center view (or the view it
/// covers, and both layers), unless it is impossible, else as the files promise; {0, 0} if neither
/// is known.
[[nodiscard]] Interval known_disparity_range(const Scene& scene);

/// Disparities that 98 % of the valid pixels of one view of an estimate lie in: of the middle one.
[[nodiscard]] Interval display_range(const Estimate& estimate);

/// The range that pictures of disparity span: what is known of the scene, else the display range of
/// an estimate, else −1 … 1 px. Each may be {0, 0}.
[[nodiscard]] Interval shown_range(Interval known, Interval of_estimate);

/// Adds the ids of labels, those above 0, to `ids`, which stays ascending. Returns how many samples
/// carry one. Linear in samples: neighbors mostly have one label, which is looked up once.
std::size_t collect_ids(std::span<const std::int32_t> labels, std::vector<int>& ids);

/// Disparities that the valid pixels of one view lie in; {0, 0} if none is valid. Linear in pixels.
[[nodiscard]] Interval extent(const DisparityView& view);

}  // namespace episcope
