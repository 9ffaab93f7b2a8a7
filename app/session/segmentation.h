// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/labeler.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

using LabelingPtr = std::shared_ptr<const Labeling>;

/// The labels of one view, `[y][x]`, as a stack that holds this view alone.
[[nodiscard]] ViewStack<std::int32_t> stack_of(const Image<std::int32_t>& labels, ViewIndex view);

/// True labels of the center view or of all views.
using TrueLabelsPtr = std::shared_ptr<const ViewStack<std::int32_t>>;

/// The labels of a ground truth, which they keep alive; null if it has none.
[[nodiscard]] TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth);

/// The input of a segmentation: an immutable snapshot.
struct LabelingInput {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;  ///< Null: images alone.
  /// EDGE_WEIGHTS of all views; null: computed from image and disparity.
  std::shared_ptr<const ViewStack<float>> edges;
  std::shared_ptr<const ScribbleLayer> scribbles;  ///< Null: of labels that are known alone.
  LabelerParameters parameters;
  /// Of the disparity (LabelingDisparity::confidence); null: it is right everywhere.
  std::shared_ptr<const ViewStack<float>> confidence;
};

/// Makes a labeler from the input without its strokes and parameters; `is_same_scene` tells whether
/// a labeler made for `a` also serves `b`.
[[nodiscard]] Labeler new_labeler(const LabelingInput& input);
[[nodiscard]] bool is_same_scene(const LabelingInput& a, const LabelingInput& b);

/// Whether two inputs give the same labels.
[[nodiscard]] bool is_same(const LabelingInput& a, const LabelingInput& b);
[[nodiscard]] bool is_same_but_strokes(const LabelingInput& a, const LabelingInput& b);

/// The parameters that the input allows: without a disparity, features of images and smoothing view
/// by view.
[[nodiscard]] LabelerParameters possible_parameters(const LabelingInput& input);

/// Segments all views. Throws InvalidInput unless two labels are painted, Cancelled.
[[nodiscard]] LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress);

/// Post-processing of labels before they are shown or written.
struct LabelFinish {
  double smoothing_px = 0;                         ///< See smooth_boundaries.
  std::shared_ptr<const ScribbleLayer> painted{};  ///< Pixels that keep their labels; may be null.
  friend bool operator==(const LabelFinish&, const LabelFinish&) = default;
};

struct Segmentation {
  LabelingPtr labeling;           ///< Covers one view or all; not null.
  std::vector<LabelInfo> labels;  ///< Names and colors, by id.
  ParameterSet parameters;        ///< It was made with.
  Reading reading{};              ///< How its light field was read.
  LabelFinish finish{};
  std::uint64_t sources_hash = 0;  ///< See LabelSources; 0 = not known.
};

/// What labels are made from beside the light field and parameters.
struct LabelSources {
  const Scribbles& strokes;
  const DisparityField* disparity = nullptr;          ///< Null unless the user gave one,
  const LabelProbabilities* probabilities = nullptr;  ///< likewise.
};
[[nodiscard]] std::uint64_t hash_of(const LabelSources& sources);

/// The labels of a view with smooth boundaries, `[y][x]`. Precondition: the labeling covers it.
[[nodiscard]] Image<std::int32_t> finished_labels(const Labeling& labeling,
                                                  const LabelFinish& finish, ViewIndex view);

/// The labels of all views that the labeling covers, with smooth boundaries. Throws Cancelled.
[[nodiscard]] ViewStack<std::int32_t> finished_labels(const Labeling& labeling,
                                                      const LabelFinish& finish,
                                                      const Progress& progress);

/// Names and colors of `ids`: from `known`, else defaults.
[[nodiscard]] std::vector<LabelInfo> infos_of(const std::vector<std::int32_t>& ids,
                                              const std::vector<LabelInfo>& known);

/// Whether probabilities are written with the labels: four bytes for each ray and label.
enum class StoredProbabilities { None, All };

/// Writes labels with their names and colors, and probabilities, as `io::write_segmentation` does.
/// `input` is what opens the light field. A labeling without probabilities is written without.
/// Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& input, StoredProbabilities probabilities,
                        const Progress& progress);

/// A view of a file that `write_segmentation` wrote, or of another file with LABELS: the middle one
/// unless another is asked for. Throws IoError, InvalidInput for a view that the file does not
/// hold.
[[nodiscard]] Segmentation read_segmentation(const std::filesystem::path& path,
                                             std::optional<ViewIndex> view);

/// What a file of labels says of the run that made it: method "label", parameters, seconds,
/// version, source and reading. Throws IoError.
[[nodiscard]] Provenance labels_provenance(const std::filesystem::path& path);

/// A view of the first file of label probabilities of the archive that lies beside the light field;
/// its labels count from 1. Throws InvalidInput, naming the light field, if there is no such file
/// or view, IoError.
[[nodiscard]] LabelingPtr read_archive_probabilities(const Scene& scene, ViewIndex view);

/// List of the labels beside their masks.
inline constexpr const char* kListOfMasks = "labels.txt";

/// Writes a mask of every label in every view that the segmentation covers, as 8-bit gray PNG, 255
/// where the pixel has the label, else 0: `folder/01_wall/mask_04_07.png` for label 1, “wall”, in
/// view (4, 7), row and column counted from 0. `labels.txt` beside them lists ids and names. Makes
/// the folders; files of the same names are replaced. Returns how many masks were written. Each
/// file is atomic. Throws IoError, Cancelled.
int write_label_masks(const std::filesystem::path& folder, const Segmentation& segmentation,
                      const Progress& progress);

/// The newest segmentation of a scene, kept with it.
struct KeptLabels {
  LabelingPtr labeling;          ///< Null while it is in its file only.
  std::vector<LabelInfo> infos;  ///< Names and colors.
  std::uint64_t strokes = 0;     ///< `hash_of` the strokes that it was learnt from.
  std::filesystem::path file{};  ///< That keeps it for the project; empty = none yet.
  bool is_saved = false;         ///< A file of the user's holds it.
  bool is_imported = false;      ///< Or read from a project: painting need not give it again.

  [[nodiscard]] bool empty() const { return !labeling && file.empty(); }
  /// Whether all views are in memory, which take long to segment.
  [[nodiscard]] bool covers_many() const { return labeling && labeling->labels.grid().count() > 1; }
  /// Whether painting does not give them again in a moment.
  [[nodiscard]] bool is_worth_keeping() const { return covers_many() || is_imported; }
  [[nodiscard]] bool is_on_disk_alone() const { return !labeling && !file.empty(); }
  /// Whether they would be lost with the window.
  [[nodiscard]] bool is_unsaved() const {
    return !is_saved && (is_worth_keeping() || is_on_disk_alone());
  }
};

[[nodiscard]] std::uint64_t hash_of(const ScribbleLayer& strokes);

/// Writes labels without their probabilities, which take four bytes for each ray and label. Throws
/// IoError, Cancelled.
void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress);

/// Reads what `write_kept_labels` wrote: it has no probabilities. Throws IoError, Cancelled.
[[nodiscard]] LabelingPtr read_kept_labels(const std::filesystem::path& path,
                                           const Progress& progress);

}  // namespace episcope
