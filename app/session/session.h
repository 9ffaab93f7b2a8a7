// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge/evaluation_cache.h"
#include "app/session/parts.h"
#include "app/session/picture/map_source.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// An estimate of the session. Ids are never given twice.
struct EstimateEntry {
  int id = 0;
  std::string name;  ///< Unique in the list: "EPI_L", "EPI_L 2", or as the user calls it.
  EstimatePtr estimate;
  Interval display_range;  ///< Disparities that most pixels of the estimate lie in.
  bool is_saved = false;   ///< A file holds it.
};

/// What is open and what is known about it: scene, estimates, evaluations, and the current view and
/// pixel. Belongs to one thread. Changes are collected and reported once per turn of that thread's
/// event loop.
class Session {
 public:
  using Listener = std::function<void(Parts)>;

  /// `post` brings a closure to the owner's thread, to be run after the current turn.
  explicit Session(JobRunner::Post post);

  /// Listeners live as long as the session.
  void on_changed(Listener listener) { listeners_.push_back(std::move(listener)); }

  /// Replaces the scene; drops the estimates of the former one. `input` is what opens it again.
  void open(std::shared_ptr<const Scene> scene, std::string input);
  void close();
  /// Null if nothing is open.
  [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
  [[nodiscard]] LightFieldPtr light_field() const;
  [[nodiscard]] const std::string& input() const { return input_; }
  /// The reading options that the scene was read with, the focus plane among them.
  [[nodiscard]] ParameterSet reading_options() const;
  /// Increases with every scene: results begun under another number belong to a former light field.
  [[nodiscard]] std::uint64_t generation() const { return generation_; }

  /// Adds an estimate and shows it. Returns its id, or 0 if `generation` is a former one: the
  /// estimate is dropped.
  int add_estimate(EstimatePtr estimate, Interval display_range, std::uint64_t generation);
  /// Shows the neighbour if the removed one was shown. Unknown ids are ignored.
  void remove_estimate(int id);
  /// Brings back a removed entry, with its id, at its former place in the list, and shows it. Its
  /// name gets a number if it was given away meanwhile.
  void restore_estimate(EstimateEntry entry, std::size_t place);
  /// Unknown ids and empty names are ignored; a name that is taken gets a number.
  void rename_estimate(int id, const std::string& name);
  /// Notes that a file holds it. Unknown ids are ignored.
  void mark_saved(int id);
  [[nodiscard]] const std::vector<EstimateEntry>& estimates() const { return estimates_; }
  [[nodiscard]] const EstimateEntry* find_estimate(int id) const;

  /// Unknown ids are ignored. Showing the compared estimate swaps the two.
  void show_estimate(int id);
  /// The shown estimate, else null.
  [[nodiscard]] const EstimateEntry* shown() const { return find_estimate(shown_); }
  /// Chooses what the shown estimate is compared with; it stays until another one is chosen, it is
  /// shown itself or removed. Unknown ids are ignored. Comparing the shown one swaps the two.
  void compare_with(int id);
  /// The estimate to compare with: the one chosen, else the one shown before, else any other; null
  /// if there is no other.
  [[nodiscard]] const EstimateEntry* compared() const;

  /// The evaluation if it is there; else null, and it is begun in the background if there is truth
  /// for that view: Part::Evaluations tells when it is there.
  [[nodiscard]] EvaluationPtr evaluation(const EvaluationKey& key);
  /// Whether evaluations are under way.
  [[nodiscard]] bool is_evaluating() const { return evaluations_.pending() > 0; }
  [[nodiscard]] bool has_truth(ViewIndex view) const;

  /// Errors beyond it make a pixel bad, in maps and in statistics of what is in sight. Kept from
  /// scene to scene.
  void set_bad_threshold(double threshold_px);
  [[nodiscard]] double bad_threshold_px() const { return bad_threshold_px_; }

  /// Compares with other labels than those that came with the scene, until another is opened.
  void set_true_labels(TrueLabelsPtr labels);
  /// Null if there are none.
  [[nodiscard]] const TrueLabelsPtr& true_labels() const { return true_labels_; }

  /// Disparities that pictures of this scene span: of the truth, else those that the files promise,
  /// else those of the first estimate. It does not change with the shown estimate.
  [[nodiscard]] Interval disparity_range() const;
  /// The same; {0, 0} while nothing is known.
  [[nodiscard]] Interval known_range() const;

  /// View and cross-hair are clamped to the light field.
  void set_view(ViewIndex view);
  void set_cross_hair(PixelIndex pixel);
  void set_focus(double focus_px);
  [[nodiscard]] ViewIndex view() const { return view_; }
  [[nodiscard]] PixelIndex cross_hair() const { return cross_hair_; }
  [[nodiscard]] double focus_px() const { return focus_px_; }

 private:
  void changed(Parts parts);
  void deliver();
  [[nodiscard]] EstimateEntry* entry_of(int id);
  [[nodiscard]] std::string unique_name(const std::string& name) const;

  JobRunner::Post post_;
  std::vector<Listener> listeners_;
  Parts gathered_;
  std::shared_ptr<const Scene> scene_;
  std::string input_;
  std::uint64_t generation_ = 0;
  Interval known_range_{};  // of truth or files; empty if neither says
  std::vector<EstimateEntry> estimates_;
  int last_id_ = 0;
  int shown_ = 0;
  int compared_ = 0;
  bool is_compared_chosen_ = false;
  double bad_threshold_px_ = kBadPixelThreshold_px;
  TrueLabelsPtr true_labels_;
  ViewIndex view_;
  PixelIndex cross_hair_;
  double focus_px_ = 0;
  std::shared_ptr<Session*> alive_;  // posted closures outlive the session harmlessly
  EvaluationCache evaluations_;
};

}  // namespace episcope
