// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/kills/window_state.h"

#include "app/gui/files/autosave.h"
#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/session/session.h"
#include "tests/app/gui/annotate/document_digest.h"

#include <fmt/format.h>

#include <cstdio>

namespace episcope::test {
namespace {

std::string digest_of(const Estimate& estimate) {
  const ViewStack<float>& maps = estimate.field.disparity;
  QCryptographicHash hash(QCryptographicHash::Sha1);
  hash.addData(QByteArray(reinterpret_cast<const char*>(maps.data()),
                          static_cast<qsizetype>(maps.size() * sizeof(float))));
  return hash.result().toHex().left(8).toStdString();
}

std::string text_of(const AnnotationDocument& document) {
  return fmt::format("{} {}", document.history().applied_count(),
                     episcope::digest_of(document).constData());
}

std::string text_of(const SweepPoint& point) {
  std::string text = fmt::format("{:.6g}", point.change_px.value_or(-1));
  for (const auto& [key, value] : point.point) text += " " + key + "=" + to_text(value);
  for (const auto& [key, value] : point.vmv2013) text += fmt::format(" {:.6g}", value);
  return text;
}

// What was decided, not where one happens to look.
std::string choices_of(const ScenePlace& place) {
  const PixelRect& part = place.judged.rectangle;
  std::string text = fmt::format("exposure {} judged {} {} {} mode {}", place.tone.exposure,
                                 static_cast<int>(place.judged.pixels), part.y0, part.x1,
                                 static_cast<int>(place.comparison.mode));
  for (const EpiMeasurement& each : place.measured.list) {
    text += fmt::format(" {}:{:.4f}", each.name, each.disparity_px);
  }
  for (const std::int32_t id : place.label_marks.locked) text += fmt::format(" locked {}", id);
  return text;
}

std::string place_of(const ScenePlace& place) {
  return fmt::format("{},{} at {},{}", place.view.v, place.view.u, place.cross_hair.y,
                     place.cross_hair.x);
}

}  // namespace

std::vector<std::string> WindowWatcher::strokes_around() {
  Session& session = window_.bench().session;
  const ViewIndex view = session.view();
  const PixelIndex pixel = session.cross_hair();
  DocumentController& documents = window_.bench().document;
  const AnnotationDocument& document = *documents.document();
  std::vector<std::string> texts;
  std::size_t undone = 0;
  for (; undone < 2 && document.history().applied_count() > 0; ++undone) {
    documents.undo();
    texts.push_back(text_of(document));
  }
  for (; undone > 0; --undone) documents.redo();
  if (document.history().next_redo()) {
    documents.redo();
    texts.push_back(text_of(document));
    documents.undo();
  }
  session.set_view(view);  // undo shows what it changes
  session.set_cross_hair(pixel);
  return texts;
}

WindowState WindowWatcher::look() {
  const Session& session = window_.bench().session;
  WindowState state;
  for (const OpenScene* scene : session.scenes()) {
    state["scenes"] += scene->name + " ";
    if (scene->id == session.generation() && window_.bench().document.document()) {
      strokes_[scene->name] = text_of(*window_.bench().document.document());
    }
    std::string& results = state[scene->name + "/results"];
    for (const EstimateEntry& each : scene->estimates) {
      if (each.estimate) maps_[each.id] = digest_of(*each.estimate);
      results += fmt::format("[{}|{}|{}]", each.name, each.note, maps_[each.id]);
    }
    state[scene->name + "/strokes"] = strokes_[scene->name];
    state[scene->name + "/choices"] = choices_of(scene->place);
    state[scene->name + "/place"] = place_of(scene->place);
  }
  std::string& sweeps = state["sweeps"];
  for (const Sweep& sweep : window_.bench().scenes.sweeps().all()) {
    for (const SweepScene& scene : sweep.scenes) {
      for (const SweepPoint& point : scene.points) {
        sweeps += fmt::format("[{} {}: {}]", sweep.base.method, scene.name, text_of(point));
      }
    }
  }
  state["project"] = window_.findChild<Autosave*>()->projectFile().filename().string();
  return state;
}

void tell(const WindowState& state) {
  std::string text = "STATE\n";
  for (const auto& [key, value] : state) text += key + "\t" + value + "\n";
  text += "END\n";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace episcope::test
