// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/capture_work.h"
#include "app/session/judge.h"
#include "app/session/segmentation.h"
#include "engine/core/camera_grid.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/render/quantity.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace episcope {

/// A disparity that was measured along a line in an EPI.
struct EpiMeasurement {
  std::string name{};
  EpiDirection direction = EpiDirection::Horizontal;
  ViewIndex view{};    ///< Whose row or column of views the EPI runs through,
  PixelIndex pixel{};  ///< and where the line meets it.
  double disparity_px = 0;
  friend bool operator==(const EpiMeasurement&, const EpiMeasurement&) = default;
};

/// Those that are kept with a scene.
struct Measurements {
  std::vector<EpiMeasurement> list;
  int current = -1;  ///< Index of the one that is chosen; −1 = none.
  friend bool operator==(const Measurements&, const Measurements&) = default;
};

/// The one that is chosen; null if none is.
[[nodiscard]] const EpiMeasurement* current_of(const Measurements& measurements);

/// Depth of a measured point, in the unit of the camera's baseline; none if the camera is not known
/// or no point in front of it has that disparity.
[[nodiscard]] std::optional<double> depth_of(const EpiMeasurement& measurement,
                                             const CameraGrid& camera);

/// A table with a header line: name, direction (row or column of views), view v and u, pixel y and
/// x, slope of the line in px per view step, disparity in px per view step, depth where it is
/// known.
[[nodiscard]] std::string measurements_csv(const std::vector<EpiMeasurement>& list,
                                           const CameraGrid& camera);

/// An estimate of the session. Ids are never given twice.
struct EstimateEntry {
  int id = 0;
  std::string name;        ///< Unique in the list: "EPI_L", "EPI_L 2", or as the user calls it.
  EstimatePtr estimate;    ///< Null while its scene is set aside and it is in its file only.
  Interval display_range;  ///< Disparities that most pixels of the estimate lie in.
  bool is_saved = false;   ///< A file of the user's holds it.
  std::filesystem::path kept{};  ///< The file that keeps it for the project; empty = none yet.
  std::string note{};            ///< What the user wrote about it; may have several lines.
  /// File that it was read from although it belongs to another light field; empty = it does not.
  std::filesystem::path foreign_file{};
  PixelRect part{};     ///< The pixels that were estimated; empty = all.
  bool is_new = false;  ///< Came unseen, as during a comparison, and was not looked at since.
};

/// How results are arranged for comparison.
enum class CompareMode {
  Single,  ///< One picture: A, or B while flipped.
  Wipe,    ///< A left and B right of a divider.
  Sides,   ///< A and B side by side.
  Wall     ///< The view, the truth and every result.
};

/// A comparison that is on screen.
struct Comparison {
  CompareMode mode = CompareMode::Single;
  double wipe_position = 0.5;     ///< Of the divider, as part of the width.
  bool shows_difference = false;  ///< A − B instead of the quantity.
  /// Whether A and B are on screen together.
  [[nodiscard]] bool shows_both() const { return mode != CompareMode::Single || shows_difference; }
  friend bool operator==(const Comparison&, const Comparison&) = default;
};

/// What the user set for single labels, by id.
struct LabelMarks {
  std::set<std::int32_t> hidden;  ///< Neither drawn nor painted over.
  std::set<std::int32_t> locked;  ///< Neither painted nor painted over.
  friend bool operator==(const LabelMarks&, const LabelMarks&) = default;
};

/// What is shown of a scene, and how.
struct ScenePlace {
  ViewIndex view;
  PixelIndex cross_hair;
  double focus_px = 0;
  /// What is drawn over the view; none = it was not shown yet.
  std::optional<render::Quantity> quantity;
  std::map<render::Quantity, Interval> ranges;  ///< Color ranges that were edited.
  render::Tone tone{};                          ///< How its views are brightened.
  Comparison comparison{};
  LabelMarks label_marks{};
  Measurements measured{};
  CaptureWork capture{};
  JudgedPart judged{};
  friend bool operator==(const ScenePlace&, const ScenePlace&) = default;
};

/// An open light field with everything known about it and done on it.
struct OpenScene {
  std::uint64_t id = 0;  ///< Never given twice.
  std::string name;
  std::string input;                   ///< What opens it again,
  ParameterSet reading;                ///< with these options.
  std::uint64_t sample_hash = 0;       ///< LightField::sample_hash; 0 = not known yet.
  std::shared_ptr<const Scene> scene;  ///< Null while it is set aside and on disk only.
  Interval known_range{};              ///< Of truth or files; empty if neither says.
  Interval found_range{};              ///< Found from the images; empty = not yet.
  std::vector<EstimateEntry> estimates;
  int shown = 0;
  int compared = 0;
  bool is_compared_chosen = false;
  /// Results of its project that could not be read or do not fit: they stay in it, unchanged.
  std::vector<EstimateEntry> unread{};
  /// Strokes of its project that could not be read; empty = they were taken over, or there are
  /// none.
  std::filesystem::path unread_strokes{};
  TrueLabelsPtr true_labels;
  std::vector<LabelInfo> true_label_infos{};  ///< Names, where files have them.
  KeptLabels labels;
  std::shared_ptr<const DisparityField> label_disparity{};  ///< Estimated for labels alone.
  ScenePlace place;
  std::uint64_t last_used = 0;  ///< Larger = later.
};

/// The place, moved into a light field that may have become another since it was looked at.
[[nodiscard]] ScenePlace within(const LightField& light_field, ScenePlace place);

[[nodiscard]] std::size_t byte_size(const Estimate& estimate);
/// Bytes of memory that the samples, the truth and the estimates of a scene take, about.
[[nodiscard]] std::size_t byte_size(const OpenScene& scene);

/// The coarse parts of a session that change together.
enum class Part : unsigned {
  Scene = 1,            ///< Light field, truth, labels, convention.
  Estimates = 2,        ///< The list of estimates.
  Shown = 4,            ///< Which estimate is shown.
  Evaluations = 8,      ///< An evaluation that was asked for is there.
  View = 16,            ///< The current view.
  CrossHair = 32,       ///< The current pixel.
  Focus = 64,           ///< The focus plane.
  TrueLabels = 128,     ///< The labels that segmentations are compared with.
  Scenes = 256,         ///< The list of open scenes, or what is in memory of those set aside.
  Display = 512,        ///< What is drawn over the view, and its color ranges.
  Tone = 1024,          ///< How views are brightened.
  Labels = 2048,        ///< The segmentation that is kept.
  LabelLook = 4096,     ///< Which labels are hidden or locked, and how labels are drawn.
  Measured = 8192,      ///< The disparities measured by hand that are kept.
  Capture = 16384,      ///< The mesh and the pairs picked on it.
  Live = 32768,         ///< The estimate that is made while parameters are tried.
  Judged = 65536,       ///< The part of the view that metrics are of.
  FoundRange = 131072,  ///< The range of disparities found from the images.
};

class Parts {
 public:
  Parts() = default;
  Parts(Part part) : bits_(static_cast<unsigned>(part)) {}

  [[nodiscard]] bool empty() const { return bits_ == 0; }
  [[nodiscard]] bool has(Part part) const { return (bits_ & static_cast<unsigned>(part)) != 0; }
  [[nodiscard]] bool has_any(Parts parts) const { return (bits_ & parts.bits_) != 0; }
  Parts& operator|=(Parts other) {
    bits_ |= other.bits_;
    return *this;
  }
  friend Parts operator|(Parts a, Parts b) { return a |= b; }
  friend bool operator==(const Parts&, const Parts&) = default;

 private:
  unsigned bits_ = 0;
};

inline Parts operator|(Part a, Part b) {
  return Parts(a) | Parts(b);
}

/// Whether the user did more on a scene than run methods, paint and look: keep lines, pair points,
/// choose pixels to judge, hide or lock labels, set the brightness.
[[nodiscard]] bool has_work(const ScenePlace& place);

}  // namespace episcope
