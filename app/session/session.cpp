// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/session.h"

#include "app/session/scene_summary.h"
#include "app/session/user_folders.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

std::string name_of_method(const std::string& id) {
  const Estimator* method = known_estimator(id);
  return method ? method->info.name : id;
}

std::string new_name(const std::vector<EstimateEntry>& entries, const std::string& wanted) {
  return unique_name(wanted, " ", [&](const std::string& name) {
    return std::ranges::count(entries, name, &EstimateEntry::name) > 0;
  });
}

EstimateEntry* entry_in(OpenScene& scene, int id) {
  const auto found = std::ranges::find(scene.estimates, id, &EstimateEntry::id);
  return found == scene.estimates.end() ? nullptr : &*found;
}

Parts everything() {
  return Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations | Part::View |
         Part::CrossHair | Part::Focus | Part::TrueLabels | Part::Scenes | Part::Tone |
         Part::LabelLook | Part::Measured | Part::Capture | Part::Live | Part::Judged;
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

int Session::add_estimate(EstimatePtr estimate, Interval display_range, std::uint64_t generation,
                          bool stays_aside) {
  OpenScene* scene = open_scene(generation);
  if (!scene || !estimate) return 0;
  const std::string name = new_name(scene->estimates, name_of_method(estimate->method));
  const bool has_other = !scene->estimates.empty() || (scene == now_ && live());
  const bool is_new = has_other && (stays_aside || is_comparing(*scene));
  scene->estimates.push_back({++last_id_, name, std::move(estimate), display_range});
  changed(Part::Scenes);
  if (scene == now_) changed(Part::Estimates);
  if (is_new) {
    scene->estimates.back().is_new = true;
  } else if (scene == now_) {
    show_estimate(last_id_);
  } else {
    if (!scene->is_compared_chosen) scene->compared = scene->shown;
    scene->shown = last_id_;
  }
  return last_id_;
}

bool Session::is_comparing(const OpenScene& scene) {
  const bool is_b_chosen = scene.is_compared_chosen &&
                           std::ranges::count(scene.estimates, scene.compared, &EstimateEntry::id);
  return is_b_chosen || scene.place.comparison.shows_both();
}

void Session::remove_estimate(int id) {
  const auto found = std::ranges::find(now_->estimates, id, &EstimateEntry::id);
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
  entry.name = new_name(now_->estimates, entry.name);
  now_->estimates.insert(
      now_->estimates.begin() + static_cast<long>(std::min(place, now_->estimates.size())),
      std::move(entry));
  changed(Part::Estimates);
  show_estimate(id);
}

void Session::rename_estimate(int id, const std::string& name) {
  for (const auto& scene : scenes_) {
    EstimateEntry* entry = entry_in(*scene, id);
    if (!entry || name.empty() || name == entry->name) continue;
    entry->name = new_name(scene->estimates, name);
    changed(Part::Estimates);
  }
}

EstimateEntry* Session::entry_of_any_scene(int id) const {
  for (const auto& scene : scenes_) {
    if (EstimateEntry* entry = entry_in(*scene, id)) return entry;
  }
  return nullptr;
}

void Session::set_note(int id, const std::string& note) {
  if (EstimateEntry* entry = entry_of_any_scene(id)) set(entry->note, note, Part::Estimates);
}

void Session::set_foreign_file(int id, const std::filesystem::path& file) {
  if (EstimateEntry* entry = entry_of_any_scene(id)) {
    set(entry->foreign_file, file, Part::Estimates);
  }
}

void Session::mark_saved(int id, bool is_saved) {
  if (EstimateEntry* entry = entry_of_any_scene(id)) entry->is_saved = is_saved;
}

void Session::mark_new(int id) {
  if (EstimateEntry* entry = entry_in(*now_, id)) entry->is_new = true;
  changed(Part::Estimates);
}

void Session::see(int id) {
  if (EstimateEntry* entry = entry_in(*now_, id)) see(*entry);
}

const EstimateEntry* Session::find_estimate(int id) const {
  if (const EstimateEntry* tried = live(); tried && tried->id == id) return tried;
  return entry_in(*now_, id);
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

void Session::see(EstimateEntry& entry) {
  if (std::exchange(entry.is_new, false)) changed(Part::Estimates);
}

void Session::show_opened_estimate(int id) {
  if (!now_->place.comparison.shows_both()) show_estimate(id);
}

void Session::show_estimate(int id) {
  EstimateEntry* entry = entry_in(*now_, id);
  if (!entry) return;
  see(*entry);
  if (id == now_->shown) return;
  if (const EstimateEntry* other = compared();
      !now_->is_compared_chosen || (other && other->id == id)) {
    now_->compared = now_->shown;
  }
  now_->shown = id;
  changed(Part::Shown);
}

void Session::compare_with(int id) {
  EstimateEntry* entry = entry_in(*now_, id);
  if (!entry) return;
  if (live()) return show_estimate(id);
  see(*entry);
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
    if (entry.id != now_->shown && !entry.is_new) return &entry;
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

void Session::set_found_range(std::uint64_t scene, Interval range) {
  if (OpenScene* open = open_scene(scene)) set(open->found_range, range, Part::FoundRange);
}

void Session::set_true_labels(TrueLabelsPtr labels, std::vector<LabelInfo> infos) {
  if (!now_->scene) return;
  now_->true_label_infos = std::move(infos);
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

void Session::set_display(render::Quantity quantity, std::map<render::Quantity, Interval> ranges) {
  ScenePlace place = now_->place;
  place.quantity = quantity;
  place.ranges = std::move(ranges);
  if (place == now_->place) return;
  now_->place = std::move(place);
  changed(Part::Display);
}

void Session::set_capture(std::uint64_t id, const CaptureWork& work) {
  OpenScene* scene = open_scene(id);
  if (!scene) return;
  const bool is_news = work != scene->place.capture;
  scene->place.capture = work;  // poses, which follow from it, may be news although it is none
  if (is_news) changed(Part::Capture);
}

void Session::set_judged(std::uint64_t id, const JudgedPart& part) {
  if (OpenScene* scene = open_scene(id)) set(scene->place.judged, part, Part::Judged);
}

std::shared_ptr<const DisparityField> Session::known_disparity(ViewIndex view) const {
  const EstimateEntry* entry = shown();
  if (entry && entry->estimate->field.contains(view)) {
    return {entry->estimate, &entry->estimate->field};
  }
  if (!now_->scene) return nullptr;
  if (now_->scene->truth->field.contains(view)) {
    return {now_->scene->truth, &now_->scene->truth->field};
  }
  const auto& of_labels = now_->label_disparity;
  return of_labels && of_labels->contains(view) ? of_labels : nullptr;
}

void Session::open(std::shared_ptr<const Scene> scene, std::string input) {
  const auto place = std::ranges::find(scenes_, now_->id, &OpenScene::id) - scenes_.begin();
  close();
  if (!scene) return;
  add(std::move(scene), std::move(input));
  if (place < std::ssize(scenes_)) {
    std::rotate(scenes_.begin() + place, scenes_.end() - 1, scenes_.end());
  }
}

void Session::add(std::shared_ptr<const Scene> scene, std::string input) {
  auto added = std::make_unique<OpenScene>();
  const LightField& light_field = *scene->light_field;
  added->id = ++last_scene_;
  added->name = light_field.info().name;
  added->input = std::move(input);
  added->reading = light_field.info().reading.options;
  added->known_range = known_disparity_range(*scene);
  added->true_labels = true_labels_of(scene->truth);
  added->true_label_infos = scene->scribbles.labels;
  added->place.view = light_field.center();
  added->place.cross_hair = {light_field.height() / 2, light_field.width() / 2};
  added->scene = std::move(scene);
  scenes_.push_back(std::move(added));
  choose(last_scene_);
}

void Session::close() {
  if (const std::uint64_t id = now_->id; now_ != &none_) {
    show_nothing();
    remove(id);
  }
  show_nothing();
}

void Session::show_nothing() {
  none_ = {};
  none_.id = ++last_scene_;
  now_ = &none_;
  changed(everything());
}

std::vector<const OpenScene*> Session::scenes() const {
  std::vector<const OpenScene*> all;
  for (const auto& each : scenes_) all.push_back(each.get());
  return all;
}

OpenScene* Session::open_scene(std::uint64_t id) const {
  const auto found = std::ranges::find(scenes_, id, &OpenScene::id);
  return found == scenes_.end() ? nullptr : found->get();
}

std::uint64_t Session::scene_of(const std::string& input) const {
  const auto found = std::ranges::find(scenes_, input, &OpenScene::input);
  return found == scenes_.end() ? 0 : (*found)->id;
}

void Session::choose(std::uint64_t id) {
  OpenScene* chosen = open_scene(id);
  if (!chosen || !chosen->scene || chosen == now_) return;
  now_ = chosen;
  now_->last_used = ++uses_;
  changed(everything());
}

std::uint64_t Session::add_aside(OpenScene scene) {
  scene.id = ++last_scene_;
  const int shown = scene.shown;
  const int compared = scene.compared;
  for (EstimateEntry& entry : scene.estimates) {
    const int former = std::exchange(entry.id, ++last_id_);
    if (former == shown) scene.shown = entry.id;
    if (former == compared) scene.compared = entry.id;
  }
  scenes_.push_back(std::make_unique<OpenScene>(std::move(scene)));
  changed(Part::Scenes);
  return last_scene_;
}

void Session::unload(std::uint64_t id) {
  OpenScene* scene = open_scene(id);
  if (!scene || scene == now_) return;
  scene->scene.reset();
  scene->true_labels.reset();
  scene->label_disparity.reset();
  for (EstimateEntry& entry : scene->estimates) {
    evaluations_.forget(entry.id);
    entry.estimate.reset();
  }
  if (!scene->labels.file.empty()) scene->labels.labeling.reset();
  changed(Part::Scenes);
}

void Session::load(std::uint64_t id, std::shared_ptr<const Scene> scene,
                   const std::map<int, EstimatePtr>& estimates) {
  OpenScene* loaded = open_scene(id);
  if (!loaded || !scene) return;
  loaded->known_range = known_disparity_range(*scene);
  loaded->true_labels = true_labels_of(scene->truth);
  loaded->true_label_infos = scene->scribbles.labels;
  loaded->place = within(*scene->light_field, loaded->place);
  loaded->scene = std::move(scene);
  for (EstimateEntry& entry : loaded->estimates) {
    const auto found = estimates.find(entry.id);
    if (!entry.estimate && found != estimates.end()) entry.estimate = found->second;
  }
  auto& entries = loaded->estimates;
  const auto unread =
      std::stable_partition(entries.begin(), entries.end(),
                            [](const EstimateEntry& entry) { return entry.estimate != nullptr; });
  loaded->unread.insert(loaded->unread.end(), std::move_iterator(unread),
                        std::move_iterator(entries.end()));
  entries.erase(unread, entries.end());
  if (std::ranges::count(entries, loaded->shown, &EstimateEntry::id) == 0) {
    loaded->shown = entries.empty() ? 0 : entries.front().id;
  }
  changed(Part::Scenes);
}

void Session::remove(std::uint64_t id) {
  const auto found = std::ranges::find(scenes_, id, &OpenScene::id);
  if (found == scenes_.end() || found->get() == now_) return;
  for (const EstimateEntry& entry : (*found)->estimates) evaluations_.forget(entry.id);
  scenes_.erase(found);
  changed(Part::Scenes);
}

void Session::set_sample_hash(std::uint64_t id, std::uint64_t hash) {
  if (OpenScene* scene = open_scene(id)) scene->sample_hash = hash;
}

void Session::set_input(std::uint64_t id, std::string input) {
  OpenScene* scene = open_scene(id);
  if (!scene || scene->scene) return;
  scene->input = std::move(input);
  changed(Part::Scenes);
}

void Session::set_unread_strokes(std::uint64_t id, std::filesystem::path file) {
  if (OpenScene* scene = open_scene(id)) scene->unread_strokes = std::move(file);
}

void Session::set_kept(int estimate, const std::filesystem::path& file) {
  const auto keep = [&](std::vector<EstimateEntry>& entries) {
    const auto found = std::ranges::find(entries, estimate, &EstimateEntry::id);
    if (found == entries.end() || found->kept == file) return;
    found->kept = file;
    changed(Part::Scenes);
  };
  for (const auto& scene : scenes_) {
    keep(scene->estimates);
    keep(scene->unread);
  }
}

void Session::set_labels(std::uint64_t id, KeptLabels labels) {
  OpenScene* scene = open_scene(id);
  if (!scene) return;
  scene->labels = std::move(labels);
  changed(Part::Labels);
}

void Session::set_label_disparity(std::uint64_t id, std::shared_ptr<const DisparityField> field) {
  OpenScene* scene = open_scene(id);
  if (!scene) return;
  scene->label_disparity = std::move(field);
  if (scene == now_) changed(Part::Estimates);
}

void Session::set_labels_file(std::uint64_t id, const LabelingPtr& labeling,
                              const std::filesystem::path& file) {
  OpenScene* scene = open_scene(id);
  if (!scene || scene->labels.labeling != labeling) return;
  scene->labels.file = file;
  changed(Part::Scenes);
}

void Session::mark_labels_saved(std::uint64_t id, const LabelingPtr& labeling) {
  OpenScene* scene = open_scene(id);
  if (!scene || scene->labels.labeling != labeling) return;
  scene->labels.is_saved = true;
  changed(Part::Labels);
}

}  // namespace episcope
