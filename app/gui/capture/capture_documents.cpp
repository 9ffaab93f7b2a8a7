// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_documents.h"

#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"

#include <QCoreApplication>

#include <utility>

namespace episcope {

CaptureDocuments::CaptureDocuments(const Workbench& bench, QObject* parent)
    : QObject(parent), bench_(bench) {
  documents_[0];
  follow();
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) follow();
    if (!parts.has(Part::Scenes)) return;
    std::erase_if(documents_, [this](const auto& each) {
      return each.first != 0 && each.first != scene_ && !bench_.session.find_scene(each.first);
    });
  });
}

std::set<std::string> CaptureDocuments::meshes() const {
  std::set<std::string> files;
  for (const auto& [scene, document] : documents_) {
    for (const CaptureObject& object : document.work().objects) files.insert(object.mesh);
  }
  return files;
}

CaptureWork CaptureDocuments::firstWork() const {
  CaptureWork work = bench_.session.place().capture;
  if (!work.empty()) return work;
  const CaptureWork& former = now().work();
  if (scene_ == 0) return former;
  if (bench_.session.scene() && !bench_.session.light_field()->info().camera.pinhole) {
    work.lens = former.lens;
    work.pattern = former.pattern;
    work.rectify = former.rectify;
  }
  return work;
}

void CaptureDocuments::follow() {
  const std::uint64_t scene = bench_.session.generation();
  if (scene == scene_) return;
  if (!documents_.contains(scene)) documents_.emplace(scene, CaptureDocument(firstWork()));
  if (scene_ == 0) documents_[0] = CaptureDocument();
  if (shows_none_) heir_ = {scene_, scene};
  shows_none_ = !bench_.session.scene();
  scene_ = scene;
  settle();
}

void CaptureDocuments::change(const std::function<void(CaptureDocument&)>& change) {
  follow();
  change(documents_[scene_]);
  settle();
}

bool CaptureDocuments::changeOf(std::uint64_t scene,
                                const std::function<void(CaptureDocument&)>& change) {
  follow();
  const std::uint64_t id = scene == heir_.none ? heir_.next : scene;
  if (id == scene_) {
    this->change(change);
    return true;
  }
  const auto found = documents_.find(id);
  if (found == documents_.end() || !bench_.session.find_scene(id)) return false;
  change(found->second);  // its pose is solved when it is shown again
  bench_.session.set_capture(id, found->second.work());
  emit changed();
  return true;
}

void CaptureDocuments::begin(CaptureWork work) {
  follow();
  documents_[scene_] = CaptureDocument(std::move(work));
  settle();
}

void CaptureDocuments::settle() {
  const LightFieldPtr field = bench_.session.light_field();
  CaptureDocument& document = documents_[scene_];
  problem_ = QString::fromStdString(document.solve(field ? field->info().camera : CameraGrid()));
  bench_.session.set_capture(document.work());
  emit changed();
}

namespace {

struct CaptureFilesText {
  Q_DECLARE_TR_FUNCTIONS(episcope::CaptureFiles)
};

}  // namespace

bool is_new_light_field(const QString& path, Messages& messages) {
  if (!has_suffix(path, {"h5"}, messages)) return false;
  if (!std::filesystem::exists(path_of(path))) return true;
  messages.fail(
      CaptureFilesText::tr("%1 exists already; name a new file, so that no light field is lost")
          .arg(path));
  return false;
}

}  // namespace episcope

#include "moc_capture_documents.cpp"
