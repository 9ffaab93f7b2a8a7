// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/jobs.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/labeler.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

using LabelingPtr = std::shared_ptr<const Labeling>;

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
/// Whether two inputs are the same but for strokes.
[[nodiscard]] bool is_same_but_strokes(const LabelingInput& a, const LabelingInput& b);

/// The parameters that the input allows: without a disparity, features of images and smoothing view
/// by view.
[[nodiscard]] LabelerParameters possible_parameters(const LabelingInput& input);

/// Segments one view while somebody paints: `on_draft` gets the most probable label of each pixel
/// if smoothing is still to come. `labeler` keeps features between calls; it must have been made
/// for the input's light field, disparity and edges. The labeling covers the view alone. Throws
/// InvalidInput unless two labels are painted, Cancelled.
[[nodiscard]] LabelingPtr label_live(Labeler& labeler, const LabelingInput& input, ViewIndex view,
                                     const std::function<void(LabelingPtr)>& on_draft,
                                     const Progress& progress);

/// Labels of all views and what they were made from.
struct KnownLabeling {
  LabelingPtr labeling;
  std::shared_ptr<const LabelingInput> input;
};

/// Corrects labels of all views after strokes (Labeler::correct): `input` differs from theirs in
/// strokes alone. `on_draft` gets the labels of `first` as soon as they are solved, `on_view` hears
/// of each view that is, from any thread. Null if that cannot be. Throws as `label_live`.
struct CorrectionNews {
  std::function<void(LabelingPtr)> on_draft;
  std::function<void(ViewIndex)> on_view;
};
[[nodiscard]] LabelingPtr correct_all_views(Labeler& labeler, const LabelingInput& input,
                                            const KnownLabeling& before, ViewIndex first,
                                            const CorrectionNews& news, const Progress& progress);

/// Segments all views. Throws as `label_live`.
[[nodiscard]] LabelingPtr label_all_views(const LabelingInput& input, const Progress& progress);

/// Post-processing of labels before they are shown or written.
struct LabelFinish {
  double smoothing_px = 0;                         ///< See smooth_boundaries.
  std::shared_ptr<const ScribbleLayer> painted{};  ///< Pixels that keep their labels; may be null.
  friend bool operator==(const LabelFinish&, const LabelFinish&) = default;
};

/// A segmentation as files hold it.
struct Segmentation {
  LabelingPtr labeling;           ///< Covers one view or all; not null.
  std::vector<LabelInfo> labels;  ///< Names and colors, by id.
  ParameterSet parameters;        ///< It was made with.
  Reading reading{};              ///< How its light field was read.
  LabelFinish finish{};
};

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

  [[nodiscard]] bool empty() const { return !labeling && file.empty(); }
  /// Whether all views are in memory, which take long to segment.
  [[nodiscard]] bool covers_many() const { return labeling && labeling->labels.grid().count() > 1; }
};

/// Hash of the pixels and labels of strokes.
[[nodiscard]] std::uint64_t hash_of(const ScribbleLayer& strokes);

/// Writes labels without their probabilities, which take four bytes for each ray and label. Throws
/// IoError, Cancelled.
void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress);

/// Reads what `write_kept_labels` wrote: it has no probabilities. Throws IoError, Cancelled.
[[nodiscard]] LabelingPtr read_kept_labels(const std::filesystem::path& path,
                                           const Progress& progress);

/// State of a live segmentation.
enum class LiveState : std::uint8_t {
  Idle,       ///< Everything that was asked for is there.
  Training,   ///< The forest learns.
  Labeling,   ///< A first result is on its way,
  Refining,   ///< and a better one.
  OutOfDate,  ///< What is there is of a former input.
  Hint,       ///< Something is missing, e.g. a second label: `sentence` says what to do.
  Failed      ///< `sentence` says why.
};

/// Segments the current view in the background. Only the newest request matters: it cancels the one
/// before within 200 ms. Works on a thread of its own, of lower priority than the owner's. All
/// members are for the owner's thread.
class LiveLabeler {
 public:
  /// Number of views whose labels are kept, so that returning to one need not wait.
  static constexpr std::size_t kKeptViews = 12;
  /// Bytes of former labels of all views, which come back when strokes are undone.
  static constexpr std::size_t kFormerBytes = std::size_t{768} << 20;

  /// `post` brings closures to the owner's thread; `on_changed` is called there after each change
  /// of state or labels that no call of the owner made.
  LiveLabeler(JobRunner::Post post, std::function<void()> on_changed);
  ~LiveLabeler();
  LiveLabeler(const LiveLabeler&) = delete;
  LiveLabeler& operator=(const LiveLabeler&) = delete;

  /// Marks all labels as out of date and cancels the running job, unless the input is the same.
  void set_input(LabelingInput input);
  [[nodiscard]] bool has_input() const { return input_ != nullptr; }
  /// No input, and nothing known: the light field is another one.
  void clear();
  /// Starts to segment a view and cancels the running job, unless the view has refined labels.
  /// Ignored without an input.
  void label(ViewIndex view);
  /// Whether strokes can correct the labels of all views: there are some that lack strokes alone.
  [[nodiscard]] bool can_correct() const;
  /// Starts to correct the labels of all views, `view` first, and cancels the running job, unless
  /// that is a correction for the same input. Precondition: `can_correct()`.
  void correct(ViewIndex view);
  /// Computes ahead what a correction after the next stroke in this view needs, if labels of all
  /// views are up to date and nothing is running.
  void prepare(ViewIndex view);
  /// Views that the running correction has done.
  [[nodiscard]] const std::vector<ViewIndex>& corrected_views() const { return corrected_; }
  /// Replaces all labels by labels of all views, made from `input`. Ignored for an input of another
  /// light field.
  void take(LabelingPtr labeling, const std::shared_ptr<const LabelingInput>& input);
  void cancel();

  [[nodiscard]] const std::shared_ptr<const LabelingInput>& input() const { return input_; }
  [[nodiscard]] LiveState state() const { return state_; }
  [[nodiscard]] bool is_running() const;
  /// Of Hint and Failed.
  [[nodiscard]] const std::string& sentence() const { return sentence_; }
  /// Whether there are labels of any view, maybe out of date.
  [[nodiscard]] bool has_labels() const { return !views_.empty() || all_.labeling; }
  /// The newest labels that cover a view, maybe out of date; null if there are none.
  [[nodiscard]] LabelingPtr labeling(ViewIndex view) const;
  /// Whether those are of the present input.
  [[nodiscard]] bool is_up_to_date(ViewIndex view) const;
  /// Whether those were made with all views, and lack only strokes in other views. The view by
  /// itself would get worse ones.
  [[nodiscard]] bool is_before_strokes(ViewIndex view) const;
  /// The newest labels of all views, if they were segmented, each view with its newest ones; else
  /// `labeling(view)`. Copies labels if some views have newer ones than the others.
  [[nodiscard]] LabelingPtr widest(ViewIndex view) const;
  /// Whether `widest` is of the present input in all its views.
  [[nodiscard]] bool is_widest_up_to_date(ViewIndex view) const;

 private:
  using Known = KnownLabeling;
  [[nodiscard]] const Known* find(ViewIndex view) const;
  /// `all` is corrected, unless it is empty.
  void start(ViewIndex view, const Known& all);
  void keep(Known known);
  void keep_all(Known known);
  [[nodiscard]] bool bring_back_all(const LabelingInput& input);
  void finish(const Outcome<std::string>& outcome);
  void change(LiveState state, std::string sentence = {});

  JobRunner::Post post_;
  std::function<void()> on_changed_;
  std::shared_ptr<const LabelingInput> input_;
  std::shared_ptr<Labeler> labeler_;  // used by one job at a time
  std::list<Known> views_;            // of one view each, the newest comes first
  Known all_;                         // older than those
  std::list<Known> former_;           // of all views, the newest comes first
  std::vector<ViewIndex> corrected_;
  bool is_correcting_ = false;
  LiveState state_ = LiveState::Idle;
  std::string sentence_;
  ViewIndex view_;
  std::uint64_t request_ = 0;
  std::shared_ptr<LiveLabeler*> alive_;  // posted closures outlive this harmlessly
  JobRunner runner_;
};

}  // namespace episcope
