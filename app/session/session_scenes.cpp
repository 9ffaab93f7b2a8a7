// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/session.h"

#include "app/session/scene/scene_range.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

Parts everything() {
  return Part::Scene | Part::Estimates | Part::Shown | Part::Evaluations | Part::View |
         Part::CrossHair | Part::Focus | Part::TrueLabels | Part::Scenes | Part::Tone |
         Part::LabelLook | Part::Measured | Part::Capture | Part::Live | Part::Judged;
}

// The light field may have become another since the place was looked at.
ScenePlace within(const LightField& light_field, ScenePlace place) {
  const int height = light_field.height(), width = light_field.width();
  if (!light_field.grid().contains(place.view)) place.view = light_field.center();
  place.cross_hair = {std::clamp(place.cross_hair.y, 0, height - 1),
                      std::clamp(place.cross_hair.x, 0, width - 1)};
  JudgedPart& judged = place.judged;
  judged.rectangle = clipped(judged.rectangle, height, width);
  if (judged.rectangle.empty() && judged.pixels == JudgedPixels::Rectangle) {
    judged.pixels = JudgedPixels::Whole;
  }
  return place;
}

}  // namespace

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

const OpenScene* Session::find_scene(std::uint64_t id) const {
  return open_scene(id);
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

void Session::set_labels_file(std::uint64_t id, const LabelingPtr& labeling,
                              const std::filesystem::path& file) {
  OpenScene* scene = open_scene(id);
  if (!scene || scene->labels.labeling != labeling) return;
  scene->labels.file = file;
  changed(Part::Scenes);
}

}  // namespace episcope
