// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge.h"
#include "app/session/open_scene.h"
#include "engine/evaluation/metrics.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// The scenes that are open, one of which is shown, and what is known about them: estimates,
/// evaluations, the current view and pixel. Unless said otherwise, functions are about the scene
/// that is shown; unknown ids are ignored. Belongs to one thread. Changes are collected and
/// reported once per turn of that thread's event loop.
class Session {
 public:
  using Listener = std::function<void(Parts)>;

  /// `post` brings a closure to the owner's thread, to be run after the current turn.
  explicit Session(JobRunner::Post post);

  /// Listeners live as long as the session.
  void on_changed(Listener listener) { listeners_.push_back(std::move(listener)); }

  /// Opens a scene in the place of the one that is shown, which is closed with its estimates.
  /// `input` is what opens it again.
  void open(std::shared_ptr<const Scene> scene, std::string input);
  /// Opens one more scene and shows it; the one that was shown is set aside.
  void add(std::shared_ptr<const Scene> scene, std::string input);
  /// Closes the scene that is shown: nothing is shown then.
  void close();

  /// All open scenes, in the order in which they were opened.
  [[nodiscard]] std::vector<const OpenScene*> scenes() const;
  /// Null for an unknown id.
  [[nodiscard]] const OpenScene* find_scene(std::uint64_t id) const { return open_scene(id); }
  /// Id of the open scene of this input; 0 if there is none.
  [[nodiscard]] std::uint64_t scene_of(const std::string& input) const;
  /// Shows another scene; the one that was shown is set aside. Precondition: it is in memory.
  void choose(std::uint64_t id);
  /// Adds one that is on disk only, set aside; its ids are given anew. Returns its id.
  std::uint64_t add_aside(OpenScene scene);
  /// Releases the memory of a scene that is set aside. Precondition: files keep its estimates.
  void unload(std::uint64_t id);
  /// Brings back what `unload` released, or what `add_aside` came without: the scene, and estimates
  /// by id. Entries without an estimate move to `OpenScene::unread`, and a place outside the scene
  /// moves into it.
  void load(std::uint64_t id, std::shared_ptr<const Scene> scene,
            const std::map<int, EstimatePtr>& estimates);
  /// Closes a scene that is set aside.
  void remove(std::uint64_t id);
  void set_sample_hash(std::uint64_t id, std::uint64_t hash);
  /// Sets the input of a scene on disk only, whose light field has moved.
  void set_input(std::uint64_t id, std::string input);
  /// Notes that strokes of its project cannot be taken over and stay where they are.
  void set_unread_strokes(std::uint64_t id, std::filesystem::path file);
  /// Notes the file that keeps an estimate of any open scene for the project.
  void set_kept(int estimate, const std::filesystem::path& file);

  /// Null if nothing is shown.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return now_->scene; }
  [[nodiscard]] LightFieldPtr light_field() const;
  [[nodiscard]] const std::string& input() const { return now_->input; }
  /// The reading options that the scene was read with, the focus plane among them.
  [[nodiscard]] ParameterSet reading_options() const;
  /// OpenScene::id: what was begun under another one belongs to another light field.
  [[nodiscard]] std::uint64_t generation() const { return now_->id; }

  /// Adds an estimate to the open scene of this id and shows it there, unless another is being
  /// compared: with one that was chosen for it, or in a mode that shows two sides, be it with the
  /// truth. It then is marked as new until it is chosen, as it is if it `stays_aside`. Returns its
  /// id, or 0 if that scene was closed: the estimate is dropped.
  int add_estimate(EstimatePtr estimate, Interval display_range, std::uint64_t generation,
                   bool stays_aside = false);
  /// Shows the neighbor if the removed one was shown.
  void remove_estimate(int id);
  /// Brings back a removed entry, with its id, at its former place in the list, and shows it. Its
  /// name gets a number if it was given away meanwhile.
  void restore_estimate(EstimateEntry entry, std::size_t place);
  /// Of any open scene. Unknown ids and empty names are ignored; a name that is taken there gets a
  /// number.
  void rename_estimate(int id, const std::string& name);
  /// What the user writes about an estimate of any open scene.
  void set_note(int id, const std::string& note);
  /// Notes the file of an estimate that belongs to another light field.
  void set_foreign_file(int id, const std::filesystem::path& file);
  /// Notes that a file of the user's holds an estimate of any open scene.
  void mark_saved(int id, bool is_saved = true);
  /// Marks a result of the scene in front that came unseen, until `see`.
  void mark_new(int id);
  /// Notes that a result of the scene in front was looked at.
  void see(int id);
  [[nodiscard]] const std::vector<EstimateEntry>& estimates() const { return now_->estimates; }
  /// Among them, or the live one; else null.
  [[nodiscard]] const EstimateEntry* find_estimate(int id) const;

  /// Showing the compared estimate swaps the two.
  void show_estimate(int id);
  /// Shows an estimate that was opened for itself, but not in place of one that is beside another.
  void show_opened_estimate(int id);
  /// The shown estimate, else null.
  [[nodiscard]] const EstimateEntry* shown() const { return find_estimate(now_->shown); }
  /// Chooses what the shown estimate is compared with; it stays until another one is chosen, it is
  /// shown itself or removed. Comparing the shown one swaps the two.
  void compare_with(int id);
  /// The estimate to compare with: the one chosen, else the one shown before, else any other that
  /// is not new; null if there is no other.
  [[nodiscard]] const EstimateEntry* compared() const;

  /// Puts an estimate before the shown one while parameters are tried: it is in no list and in no
  /// project, and the one before it is forgotten. Null takes it away. Dropped unless `scene` is
  /// shown; it goes away with that. Of `entry`, the id is given here.
  void set_live(EstimateEntry entry, std::uint64_t scene);
  void clear_live();
  /// Null if there is none.
  [[nodiscard]] const EstimateEntry* live() const;
  /// The estimate on screen: the live one, else the shown one; null if there is neither.
  [[nodiscard]] const EstimateEntry* side_a() const;
  /// What `side_a` is compared with: a live estimate with the shown one, else `compared`.
  [[nodiscard]] const EstimateEntry* side_b() const { return live() ? shown() : compared(); }

  /// The evaluation if it is there; else null, and it is begun in the background if the view has
  /// truth. Part::Evaluations reports its end.
  [[nodiscard]] EvaluationPtr evaluation(const EvaluationKey& key);
  /// Whether evaluations are running.
  [[nodiscard]] bool is_evaluating() const { return evaluations_.pending() > 0; }
  [[nodiscard]] bool has_truth(ViewIndex view) const;

  /// Errors beyond it make a pixel bad, in maps and in statistics of what is in sight. Kept from
  /// scene to scene.
  void set_bad_threshold(double threshold_px) {
    set(bad_threshold_px_, threshold_px, Part::Evaluations);
  }
  [[nodiscard]] double bad_threshold_px() const { return bad_threshold_px_; }

  /// Compares with other labels than those that came with the scene, until another is opened.
  void set_true_labels(TrueLabelsPtr labels, std::vector<LabelInfo> infos);
  /// Null if there are none.
  [[nodiscard]] const TrueLabelsPtr& true_labels() const { return now_->true_labels; }
  [[nodiscard]] const std::vector<LabelInfo>& true_label_infos() const {
    return now_->true_label_infos;
  }

  /// Disparities that pictures of this scene span: of the truth, else as the files promise, else of
  /// the first estimate. It does not change with the shown estimate.
  [[nodiscard]] Interval disparity_range() const;
  /// As `disparity_range`, but {0, 0} while nothing is known.
  [[nodiscard]] Interval known_range() const;
  /// Keeps the range that was found from the images of a scene (search_range). Dropped if it was
  /// closed.
  void set_found_range(std::uint64_t scene, Interval range);
  /// {0, 0} while none was found.
  [[nodiscard]] Interval found_range() const { return now_->found_range; }

  /// View and cross-hair are clamped to the light field.
  void set_view(ViewIndex view);
  void set_cross_hair(PixelIndex pixel);
  void set_focus(double focus_px) { set(now_->place.focus_px, focus_px, Part::Focus); }
  [[nodiscard]] ViewIndex view() const { return now_->place.view; }
  [[nodiscard]] PixelIndex cross_hair() const { return now_->place.cross_hair; }
  [[nodiscard]] double focus_px() const { return now_->place.focus_px; }
  /// Sets what is drawn over the view and in which color ranges, to come back with the scene.
  void set_display(render::Quantity quantity, std::map<render::Quantity, Interval> ranges);
  /// Sets how results are compared, to come back with the scene.
  void set_comparison(const Comparison& comparison) {
    set(&ScenePlace::comparison, comparison, Part::Display);
  }
  /// Sets how views are brightened for display.
  void set_tone(const render::Tone& tone) { set(&ScenePlace::tone, tone, Part::Tone); }
  [[nodiscard]] const ScenePlace& place() const { return now_->place; }
  /// Sets which labels are hidden or locked.
  void set_label_marks(const LabelMarks& marks) {
    set(&ScenePlace::label_marks, marks, Part::LabelLook);
  }
  /// Sets how areas of labels are drawn. Kept from scene to scene.
  void set_label_drawing(render::LabelDrawing drawing) {
    set(label_drawing_, drawing, Part::LabelLook);
  }
  /// Drawing of labels together with the hidden ones.
  [[nodiscard]] render::LabelStyle label_style() const {
    return {label_drawing_, now_->place.label_marks.hidden};
  }

  /// Sets what was measured by hand in EPIs.
  void set_measurements(const Measurements& measured) {
    set(&ScenePlace::measured, measured, Part::Measured);
  }
  /// Sets the work between photographs and ground truth.
  void set_capture(const CaptureWork& work) {
    if (now_->scene) set_capture(now_->id, work);
  }
  /// Sets the work of any open scene.
  void set_capture(std::uint64_t scene, const CaptureWork& work);
  /// Sets which pixels metrics of an open scene cover.
  void set_judged(std::uint64_t scene, const JudgedPart& part);

  /// Notes the disparity of all views that was estimated for the labels of an open scene; it stays
  /// in memory with the scene.
  void set_label_disparity(std::uint64_t scene, std::shared_ptr<const DisparityField> field);
  /// Null if there is none.
  [[nodiscard]] const std::shared_ptr<const DisparityField>& label_disparity() const {
    return now_->label_disparity;
  }
  /// What is known of the disparity of a view: the shown estimate, which is held, else the truth,
  /// else `label_disparity`; null if none has that view.
  [[nodiscard]] std::shared_ptr<const DisparityField> known_disparity(ViewIndex view) const;

  /// Keeps a segmentation with an open scene, in the place of another.
  void set_labels(std::uint64_t scene, KeptLabels labels);
  /// Notes the file that keeps it for the project; ignored if another one is kept meanwhile.
  void set_labels_file(std::uint64_t scene, const LabelingPtr& labeling,
                       const std::filesystem::path& file);
  [[nodiscard]] const KeptLabels& labels() const { return now_->labels; }
  /// Notes that a file of the user's holds the labels of an open scene; ignored if others are kept
  /// meanwhile.
  void mark_labels_saved(std::uint64_t scene, const LabelingPtr& labeling);

 private:
  void changed(Parts parts);
  template <class T>
  void set(T& value, const T& wanted, Part part) {
    if (value == wanted) return;
    value = wanted;
    changed(part);
  }
  /// Of the scene that is shown; ignored if there is none.
  template <class T>
  void set(T ScenePlace::*value, const T& wanted, Part part) {
    if (now_->scene) set(now_->place.*value, wanted, part);
  }
  void deliver();
  void show_nothing();
  [[nodiscard]] OpenScene* open_scene(std::uint64_t id) const;
  /// Null for an unknown id.
  [[nodiscard]] EstimateEntry* entry_of_any_scene(int id) const;
  /// Whether the user chose what to compare in the scene.
  [[nodiscard]] static bool is_comparing(const OpenScene& scene);
  /// The user has chosen it.
  void see(EstimateEntry& entry);

  JobRunner::Post post_;
  std::vector<Listener> listeners_;
  Parts gathered_;
  std::vector<std::unique_ptr<OpenScene>> scenes_;
  OpenScene none_;  // shown while nothing is open
  OpenScene* now_ = &none_;
  std::uint64_t last_scene_ = 0;
  std::uint64_t uses_ = 0;
  int last_id_ = 0;
  std::optional<EstimateEntry> live_;
  std::uint64_t live_scene_ = 0;
  double bad_threshold_px_ = kBadPixelThreshold_px;
  render::LabelDrawing label_drawing_ = render::LabelDrawing::Fill;
  std::shared_ptr<Session*> alive_;  // posted closures outlive the session harmlessly
  EvaluationCache evaluations_;
};

}  // namespace episcope
