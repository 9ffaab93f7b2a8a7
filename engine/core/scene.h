// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/view_gain.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

using Rgb = std::array<std::uint8_t, 3>;

/// Name and color of a label.
struct LabelInfo {
  int id = 0;        ///< From 1; 0 is "none".
  std::string name;  ///< UTF-8, one line.
  Rgb color{};
  friend bool operator==(const LabelInfo&, const LabelInfo&) = default;
};

/// Default color of a label id: a fixed palette for 1 … 20, well separated also for those who
/// cannot tell all colors apart, further ones by hue. Black for 0 and negative ids.
[[nodiscard]] Rgb label_color(std::int32_t id);
/// A label that nothing is known of but its id: "label 7" in its default color.
[[nodiscard]] LabelInfo default_label(std::int32_t id);

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
  /// How the labels were computed, likewise.
  std::optional<Provenance> labels_estimated{};

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

/// Use of the files of one kind in a folder.
struct FileUse {
  std::string kind;  ///< "views", "labels"; of files not used: "*.txt", "depth_#.npy".
  int count = 0;
  std::string example;  ///< Name of the first of them.
  bool is_used = true;
};

/// Which views were kept of those stored, in canonical order.
struct ViewCrop {
  GridShape stored;  ///< Empty: all views were kept.
  ViewIndex first;   ///< Place of the first view that was kept,
  GridShape kept;    ///< and how many there are from it.
  /// Whether views were left out.
  [[nodiscard]] bool leaves_out() const { return !(kept == stored); }
};

/// What a file says of its light field, and files written from it go on to say; empty = nothing.
struct StatedFacts {
  std::string origin;   ///< How the light field was made, in a sentence.
  std::string samples;  ///< ConventionReport::samples, such as "uint16, linear".
  std::string sign;     ///< Why a nearer point has positive disparity.
};

/// Which conversion to the canonical convention a reader made, and how it was checked.
struct ConventionReport {
  std::string format;             ///< "archive (lf.h5)", "2016 benchmark folder", "image grid", …
  std::string order;              ///< "as stored", "u reversed (file h axis)", …
  std::string order_check;        ///< "checked against truth: 1.7 grey levels, reversed 4.3", …
  std::string sign;               ///< "checked" if near and far are told apart; empty = not known.
  std::string sign_check;         ///< The evidence, with numbers, or why there is none.
  std::vector<FileUse> files;     ///< Every file of the folder: used as what, or not used.
  std::string samples;            ///< How samples were stored, and what estimators see of them.
  std::string gain;               ///< How much the brightness of the views differs; empty = of
                                  ///< built-in scenes and single views, not at all.
  std::string units;              ///< How depth was turned into disparity,
  std::string units_check;        ///< and what spoke for it; may be empty.
  bool are_axes_unclear = false;  ///< Nothing tells rows of views from columns.
  bool order_was_chosen = false;  ///< The user overruled the reader,
  bool units_were_chosen = false;     ///< and here.
  std::vector<std::string> warnings;  ///< A sentence each.
  double focus_px = 0;  ///< Focus plane that was baked in (shear.h): stored disparities were larger
                        ///< by it.
  bool reversed_u = false;     ///< Whether stored columns of views were reversed, for companions,
  bool reversed_v = false;     ///< and rows.
  ViewCrop crop;               ///< Which views were kept, for companions,
  bool raised_labels = false;  ///< and whether stored labels began at 0 and were raised by one.
  StatedFacts stated;
  /// Files that hold the disparity or depth of the ground truth, if they lie beside the views.
  std::vector<std::filesystem::path> truth_files;
};

/// Sentences for users: `order`, `sign`, or `units` with its check, and who chose it.
[[nodiscard]] std::string order_text(const ConventionReport& report);
[[nodiscard]] std::string sign_text(const ConventionReport& report);
[[nodiscard]] std::string units_text(const ConventionReport& report);

/// "uint8 as stored, taken as gamma-encoded; estimators see value/255", …
[[nodiscard]] std::string stored_samples_text(const LightField::Samples& samples);

/// Scribbles on one view: 0 = unpainted, else a label id.
struct ViewScribbles {
  ViewIndex view;
  Image<std::int32_t> labels;
};

/// Scribbles on a light field.
struct Scribbles {
  std::vector<ViewScribbles> views;  ///< Painted ones, in the order of the grid.
  std::vector<LabelInfo> labels;     ///< Known names and colors, by id.
  [[nodiscard]] bool empty() const { return views.empty(); }
};

/// Contents of large files beside a light field of the archive.
enum class CompanionKind {
  EdgeProbabilities,
  ImageProbabilities,     ///< Of labels, from features of the image,
  DepthProbabilities,     ///< from these and the estimated depth,
  TrueDepthProbabilities  ///< from these and the true depth.
};
/// "edge weights", "probabilities (image)", …
[[nodiscard]] const char* companion_name(CompanionKind kind);

/// A large companion file found beside the light field, read when it is needed.
struct Companion {
  CompanionKind kind = CompanionKind::EdgeProbabilities;
  std::filesystem::path path;
  std::string shape;  ///< As stored, e.g. "9×9×512×512".
};

/// Which light field of a sequence in time a scene is.
struct FrameOfSequence {
  int frame = 0;  ///< From 0.
  int count = 0;  ///< 0 = not one of a sequence.
};

/// All that was read from one light-field file or folder, or made by a built-in scene.
struct Scene {
  LightFieldPtr light_field;
  GroundTruthPtr truth;  ///< Never null; its parts may be missing.
  Scribbles scribbles;
  std::vector<Companion> companions;
  ConventionReport convention;
  FrameOfSequence sequence{};
  /// The views as most methods see them; shared by copies of the scene.
  std::shared_ptr<EvenViews> even = std::make_shared<EvenViews>();

  /// The first companion of this kind; null if there is none.
  [[nodiscard]] const Companion* find_companion(CompanionKind kind) const {
    const auto found = std::ranges::find(companions, kind, &Companion::kind);
    return found == companions.end() ? nullptr : &*found;
  }
};

}  // namespace episcope
