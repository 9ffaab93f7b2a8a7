// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/session.h"

#include "app/session/scene/scene_range.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

std::string name_of_method(const std::string& id) {
  for (const Estimator& estimator : registered_estimators()) {
    if (estimator.info.id == id) return estimator.info.name;
  }
  return id;
}

}  // namespace

Session::Session(JobRunner::Post post)
    : post_(std::move(post)),
      alive_(std::make_shared<Session*>(this)),
      evaluations_(post_, [this] { changed(Part::Evaluations); }) {}

void Session::changed(Parts parts) {
  const bool is_posted = !gathered_.empty();
  gathered_ |= parts;
  if (is_posted) return;
  post_([weak = std::weak_ptr<Session*>(alive_)] {
    if (const auto session = weak.lock()) (*session)->deliver();
  });
}

void Session::deliver() {
  const Parts parts = std::exchange(gathered_, Parts());
  for (const Listener& listener : listeners_) listener(parts);
}

void Session::open(std::shared_ptr<const Scene> scene, std::string input) {
  close();
  scene_ = std::move(scene);
  input_ = std::move(input);
  if (!scene_) return;
  known_range_ = known_disparity_range(*scene_);
  true_labels_ = true_labels_of(scene_->truth);
  view_ = scene_->light_field->center();
  cross_hair_ = {scene_->light_field->height() / 2, scene_->light_field->width() / 2};
}

void Session::close() {
  for (const EstimateEntry& entry : estimates_) evaluations_.forget(entry.id);
  estimates_.clear();
  scene_.reset();
  true_labels_.reset();
  input_.clear();
  shown_ = compared_ = 0;
  is_compared_chosen_ = false;
  known_range_ = {};
  focus_px_ = 0;
  ++generation_;
  changed(Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations | Part::View |
          Part::CrossHair | Part::Focus | Part::TrueLabels);
}

ParameterSet Session::reading_options() const {
  return scene_ ? scene_->light_field->info().reading.options : ParameterSet();
}

LightFieldPtr Session::light_field() const {
  return scene_ ? scene_->light_field : nullptr;
}

std::string Session::unique_name(const std::string& name) const {
  const auto is_taken = [this](const std::string& candidate) {
    return std::any_of(estimates_.begin(), estimates_.end(),
                       [&](const EstimateEntry& entry) { return entry.name == candidate; });
  };
  std::string candidate = name;
  for (int number = 2; is_taken(candidate); ++number) {
    candidate = name + " " + std::to_string(number);
  }
  return candidate;
}

int Session::add_estimate(EstimatePtr estimate, Interval display_range, std::uint64_t generation) {
  if (generation != generation_ || !scene_ || !estimate) return 0;
  const std::string name = unique_name(name_of_method(estimate->method));
  estimates_.push_back({++last_id_, name, std::move(estimate), display_range});
  changed(Part::Estimates);
  show_estimate(last_id_);
  return last_id_;
}

void Session::remove_estimate(int id) {
  const auto found = std::find_if(estimates_.begin(), estimates_.end(),
                                  [&](const EstimateEntry& entry) { return entry.id == id; });
  if (found == estimates_.end()) return;
  const auto next = estimates_.erase(found);
  evaluations_.forget(id);
  changed(Part::Estimates);
  if (shown_ == id) {
    shown_ = estimates_.empty() ? 0 : (next == estimates_.end() ? std::prev(next) : next)->id;
  } else if (compared_ != id) {
    return;
  }
  if (compared_ == id || compared_ == shown_) {
    compared_ = 0;
    is_compared_chosen_ = false;
  }
  changed(Part::Shown);
}

void Session::restore_estimate(EstimateEntry entry, std::size_t place) {
  if (!scene_ || find_estimate(entry.id)) return;
  const int id = entry.id;
  entry.name = unique_name(entry.name);
  estimates_.insert(estimates_.begin() + static_cast<long>(std::min(place, estimates_.size())),
                    std::move(entry));
  changed(Part::Estimates);
  show_estimate(id);
}

EstimateEntry* Session::entry_of(int id) {
  const auto found = std::ranges::find(estimates_, id, &EstimateEntry::id);
  return found == estimates_.end() ? nullptr : &*found;
}

void Session::rename_estimate(int id, const std::string& name) {
  EstimateEntry* entry = entry_of(id);
  if (!entry || name.empty() || name == entry->name) return;
  entry->name = unique_name(name);
  changed(Part::Estimates);
}

void Session::mark_saved(int id) {
  if (EstimateEntry* entry = entry_of(id)) entry->is_saved = true;
}

const EstimateEntry* Session::find_estimate(int id) const {
  const auto found = std::find_if(estimates_.begin(), estimates_.end(),
                                  [&](const EstimateEntry& entry) { return entry.id == id; });
  return found == estimates_.end() ? nullptr : &*found;
}

void Session::show_estimate(int id) {
  if (id == shown_ || !find_estimate(id)) return;
  if (const EstimateEntry* other = compared(); !is_compared_chosen_ || (other && other->id == id)) {
    compared_ = shown_;
  }
  shown_ = id;
  changed(Part::Shown);
}

void Session::compare_with(int id) {
  if (!find_estimate(id)) return;
  if (id == shown_) {
    const EstimateEntry* other = compared();
    if (!other) return;
    shown_ = other->id;
  }
  compared_ = id;
  is_compared_chosen_ = true;
  changed(Part::Shown);
}

const EstimateEntry* Session::compared() const {
  if (const EstimateEntry* chosen = find_estimate(compared_)) return chosen;
  for (const EstimateEntry& entry : estimates_) {
    if (entry.id != shown_) return &entry;
  }
  return nullptr;
}

EvaluationPtr Session::evaluation(const EvaluationKey& key) {
  const EstimateEntry* entry = find_estimate(key.estimate);
  return entry ? evaluations_.find_or_begin(key, entry->estimate, scene_) : nullptr;
}

bool Session::has_truth(ViewIndex view) const {
  return scene_ && scene_->truth->field.contains(view);
}

Interval Session::disparity_range() const {
  return shown_range(known_range(), {});
}

Interval Session::known_range() const {
  if (known_range_.length() > 0) return known_range_;
  const auto found = std::ranges::find_if(
      estimates_, [](const EstimateEntry& each) { return each.display_range.length() > 0; });
  return found == estimates_.end() ? Interval{} : found->display_range;
}

void Session::set_bad_threshold(double threshold_px) {
  if (threshold_px == bad_threshold_px_) return;
  bad_threshold_px_ = threshold_px;
  changed(Part::Evaluations);
}

void Session::set_true_labels(TrueLabelsPtr labels) {
  if (!scene_) return;
  true_labels_ = std::move(labels);
  changed(Part::TrueLabels);
}

void Session::set_view(ViewIndex view) {
  if (!scene_) return;
  const GridShape grid = scene_->light_field->grid();
  view = {std::clamp(view.v, 0, grid.v - 1), std::clamp(view.u, 0, grid.u - 1)};
  if (view == view_) return;
  view_ = view;
  changed(Part::View);
}

void Session::set_cross_hair(PixelIndex pixel) {
  if (!scene_) return;
  pixel = {std::clamp(pixel.y, 0, scene_->light_field->height() - 1),
           std::clamp(pixel.x, 0, scene_->light_field->width() - 1)};
  if (pixel == cross_hair_) return;
  cross_hair_ = pixel;
  changed(Part::CrossHair);
}

void Session::set_focus(double focus_px) {
  if (focus_px == focus_px_) return;
  focus_px_ = focus_px;
  changed(Part::Focus);
}

}  // namespace episcope
