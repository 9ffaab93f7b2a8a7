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

std::string unique_name(const std::vector<EstimateEntry>& entries, const std::string& name) {
  std::string candidate = name;
  for (int number = 2; std::ranges::count(entries, candidate, &EstimateEntry::name) > 0; ++number) {
    candidate = name + " " + std::to_string(number);
  }
  return candidate;
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

ParameterSet Session::reading_options() const {
  return now_->scene ? now_->scene->light_field->info().reading.options : ParameterSet();
}

LightFieldPtr Session::light_field() const {
  return now_->scene ? now_->scene->light_field : nullptr;
}

int Session::add_estimate(EstimatePtr estimate, Interval display_range, std::uint64_t generation) {
  OpenScene* scene = open_scene(generation);
  if (!scene || !estimate) return 0;
  const std::string name = unique_name(scene->estimates, name_of_method(estimate->method));
  scene->estimates.push_back({++last_id_, name, std::move(estimate), display_range});
  changed(Part::Scenes);
  if (scene == now_) {
    changed(Part::Estimates);
    show_estimate(last_id_);
  } else {
    if (!scene->is_compared_chosen) scene->compared = scene->shown;
    scene->shown = last_id_;
  }
  return last_id_;
}

void Session::remove_estimate(int id) {
  const auto found = std::find_if(now_->estimates.begin(), now_->estimates.end(),
                                  [&](const EstimateEntry& entry) { return entry.id == id; });
  if (found == now_->estimates.end()) return;
  const auto next = now_->estimates.erase(found);
  evaluations_.forget(id);
  changed(Part::Estimates);
  if (now_->shown == id) {
    now_->shown =
        now_->estimates.empty() ? 0 : (next == now_->estimates.end() ? std::prev(next) : next)->id;
  } else if (now_->compared != id) {
    return;
  }
  if (now_->compared == id || now_->compared == now_->shown) {
    now_->compared = 0;
    now_->is_compared_chosen = false;
  }
  changed(Part::Shown);
}

void Session::restore_estimate(EstimateEntry entry, std::size_t place) {
  if (!now_->scene || find_estimate(entry.id)) return;
  const int id = entry.id;
  entry.name = unique_name(now_->estimates, entry.name);
  now_->estimates.insert(
      now_->estimates.begin() + static_cast<long>(std::min(place, now_->estimates.size())),
      std::move(entry));
  changed(Part::Estimates);
  show_estimate(id);
}

EstimateEntry* Session::entry_of(int id) {
  const auto found = std::ranges::find(now_->estimates, id, &EstimateEntry::id);
  return found == now_->estimates.end() ? nullptr : &*found;
}

OpenScene* Session::scene_with(int estimate) const {
  const auto found = std::ranges::find_if(scenes_, [&](const auto& scene) {
    return std::ranges::count(scene->estimates, estimate, &EstimateEntry::id) > 0;
  });
  return found == scenes_.end() ? nullptr : found->get();
}

void Session::rename_estimate(int id, const std::string& name) {
  OpenScene* scene = scene_with(id);
  if (!scene || name.empty()) return;
  EstimateEntry& entry = *std::ranges::find(scene->estimates, id, &EstimateEntry::id);
  if (name == entry.name) return;
  entry.name = unique_name(scene->estimates, name);
  changed(Part::Estimates);
}

void Session::set_note(int id, const std::string& note) {
  OpenScene* scene = scene_with(id);
  if (!scene) return;
  EstimateEntry& entry = *std::ranges::find(scene->estimates, id, &EstimateEntry::id);
  if (note == entry.note) return;
  entry.note = note;
  changed(Part::Estimates);
}

void Session::mark_saved(int id) {
  for (const auto& scene : scenes_) {
    const auto found = std::ranges::find(scene->estimates, id, &EstimateEntry::id);
    if (found != scene->estimates.end()) found->is_saved = true;
  }
}

const EstimateEntry* Session::find_estimate(int id) const {
  if (const EstimateEntry* tried = live(); tried && tried->id == id) return tried;
  const auto found = std::find_if(now_->estimates.begin(), now_->estimates.end(),
                                  [&](const EstimateEntry& entry) { return entry.id == id; });
  return found == now_->estimates.end() ? nullptr : &*found;
}

void Session::set_live(EstimateEntry entry, std::uint64_t scene) {
  clear_live();
  if (!entry.estimate || scene != now_->id) return;
  entry.id = ++last_id_;
  live_ = std::move(entry);
  live_scene_ = scene;
  changed(Part::Live);
}

void Session::clear_live() {
  if (!live_) return;
  evaluations_.forget(live_->id);
  live_.reset();
  changed(Part::Live);
}

const EstimateEntry* Session::live() const {
  return live_ && live_scene_ == now_->id ? &*live_ : nullptr;
}

const EstimateEntry* Session::side_a() const {
  const EstimateEntry* tried = live();
  return tried ? tried : shown();
}

const EstimateEntry* Session::side_b() const {
  return live() ? shown() : compared();
}

void Session::show_estimate(int id) {
  if (id == now_->shown || !entry_of(id)) return;
  if (const EstimateEntry* other = compared();
      !now_->is_compared_chosen || (other && other->id == id)) {
    now_->compared = now_->shown;
  }
  now_->shown = id;
  changed(Part::Shown);
}

void Session::compare_with(int id) {
  if (!entry_of(id)) return;
  if (live()) return show_estimate(id);
  if (id == now_->shown) {
    const EstimateEntry* other = compared();
    if (!other) return;
    now_->shown = other->id;
  }
  now_->compared = id;
  now_->is_compared_chosen = true;
  changed(Part::Shown);
}

const EstimateEntry* Session::compared() const {
  if (const EstimateEntry* chosen = find_estimate(now_->compared)) return chosen;
  for (const EstimateEntry& entry : now_->estimates) {
    if (entry.id != now_->shown) return &entry;
  }
  return nullptr;
}

EvaluationPtr Session::evaluation(const EvaluationKey& key) {
  const EstimateEntry* entry = find_estimate(key.estimate);
  return entry ? evaluations_.find_or_begin(key, entry->estimate, now_->scene, entry->part)
               : nullptr;
}

bool Session::has_truth(ViewIndex view) const {
  return now_->scene && now_->scene->truth->field.contains(view);
}

Interval Session::disparity_range() const {
  return shown_range(known_range(), {});
}

Interval Session::known_range() const {
  if (now_->known_range.length() > 0) return now_->known_range;
  const auto found = std::ranges::find_if(
      now_->estimates, [](const EstimateEntry& each) { return each.display_range.length() > 0; });
  if (found != now_->estimates.end()) return found->display_range;
  const EstimateEntry* tried = live();
  return tried ? tried->display_range : Interval{};
}

void Session::set_bad_threshold(double threshold_px) {
  if (threshold_px == bad_threshold_px_) return;
  bad_threshold_px_ = threshold_px;
  changed(Part::Evaluations);
}

void Session::set_true_labels(TrueLabelsPtr labels) {
  if (!now_->scene) return;
  now_->true_labels = std::move(labels);
  changed(Part::TrueLabels);
}

void Session::set_view(ViewIndex view) {
  if (!now_->scene) return;
  const GridShape grid = now_->scene->light_field->grid();
  view = {std::clamp(view.v, 0, grid.v - 1), std::clamp(view.u, 0, grid.u - 1)};
  if (view == now_->place.view) return;
  now_->place.view = view;
  changed(Part::View);
}

void Session::set_cross_hair(PixelIndex pixel) {
  if (!now_->scene) return;
  pixel = {std::clamp(pixel.y, 0, now_->scene->light_field->height() - 1),
           std::clamp(pixel.x, 0, now_->scene->light_field->width() - 1)};
  if (pixel == now_->place.cross_hair) return;
  now_->place.cross_hair = pixel;
  changed(Part::CrossHair);
}

void Session::set_focus(double focus_px) {
  if (focus_px == now_->place.focus_px) return;
  now_->place.focus_px = focus_px;
  changed(Part::Focus);
}

void Session::set_display(render::Quantity quantity, std::map<render::Quantity, Interval> ranges) {
  ScenePlace place = now_->place;
  place.quantity = quantity;
  place.ranges = std::move(ranges);
  if (place == now_->place) return;
  now_->place = std::move(place);
  changed(Part::Display);
}

void Session::set_comparison(const Comparison& comparison) {
  if (!now_->scene || comparison == now_->place.comparison) return;
  now_->place.comparison = comparison;
  changed(Part::Display);
}

void Session::set_tone(const render::Tone& tone) {
  if (!now_->scene || tone == now_->place.tone) return;
  now_->place.tone = tone;
  changed(Part::Tone);
}

void Session::set_label_marks(const LabelMarks& marks) {
  if (!now_->scene || marks == now_->place.label_marks) return;
  now_->place.label_marks = marks;
  changed(Part::LabelLook);
}

void Session::set_label_drawing(render::LabelDrawing drawing) {
  if (drawing == label_drawing_) return;
  label_drawing_ = drawing;
  changed(Part::LabelLook);
}

void Session::set_measurements(const Measurements& measured) {
  if (!now_->scene || measured == now_->place.measured) return;
  now_->place.measured = measured;
  changed(Part::Measured);
}

void Session::set_capture(const CaptureWork& work) {
  if (now_->scene) set_capture(now_->id, work);
}

void Session::set_capture(std::uint64_t id, const CaptureWork& work) {
  OpenScene* scene = open_scene(id);
  if (!scene) return;
  const bool is_news = work != scene->place.capture;
  scene->place.capture = work;  // poses, which follow from it, may be news although it is none
  if (is_news) changed(Part::Capture);
}

void Session::set_judged(std::uint64_t id, const JudgedPart& part) {
  OpenScene* scene = open_scene(id);
  if (!scene || part == scene->place.judged) return;
  scene->place.judged = part;
  changed(Part::Judged);
}

render::LabelStyle Session::label_style() const {
  return {label_drawing_, now_->place.label_marks.hidden};
}

std::shared_ptr<const DisparityField> Session::known_disparity(ViewIndex view) const {
  const EstimateEntry* entry = shown();
  if (entry && entry->estimate->field.contains(view)) {
    return {entry->estimate, &entry->estimate->field};
  }
  if (!now_->scene || !now_->scene->truth->field.contains(view)) return nullptr;
  return {now_->scene->truth, &now_->scene->truth->field};
}

}  // namespace episcope
