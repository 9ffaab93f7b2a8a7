// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_documents.h"

#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"

#include <QCoreApplication>

#include <cmath>
#include <cstddef>
#include <memory>
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

namespace {

constexpr std::size_t kMovingFaces = 60'000;

// A canvas counts from the corner of a pixel.
QPointF on_canvas(double x_px, double y_px) {
  return {x_px + 0.5, y_px + 0.5};
}

}  // namespace

CloudPartsPtr mesh_parts(const capture::TriangleMesh& mesh) {
  CloudPart part{make_mesh_cloud(mesh.vertices, mesh.faces), {}};
  if (mesh.faces.size() > kMovingFaces) {
    const capture::TriangleMesh coarse = capture::cluster_vertices(mesh, kMovingFaces);
    part.few = make_mesh_cloud(coarse.vertices, coarse.faces);
  }
  auto parts = std::make_shared<CloudParts>();
  parts->push_back(std::move(part));
  return parts;
}

std::array<double, 3> in_mesh_view(const capture::Point3& point) {
  return {point.x, -point.y, -point.z};
}

std::vector<CaptureRow> pair_rows(const std::vector<capture::PointPair>& pairs,
                                  const std::optional<capture::SolvedPose>& pose) {
  std::vector<CaptureRow> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    CaptureRow row{.name = QString::fromStdString(pair.name),
                   .pixel = {pair.x_px, pair.y_px},
                   .point = {pair.point.x, pair.point.y, pair.point.z},
                   .off_px = {},
                   .is_locked = pair.is_locked};
    if (pose) {
      row.off_px = pose->pairs[i].residual_px;
      row.is_outlier = pose->pairs[i].is_outlier;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

PairMarks pair_marks(const std::vector<capture::PointPair>& pairs, const capture::RigidPose* pose,
                     const std::optional<Pinhole>& pinhole,
                     const std::function<bool(int)>& is_emphasised) {
  PairMarks marks;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const capture::PointPair& pair = pairs[i];
    const bool is_strong = is_emphasised(static_cast<int>(i));
    CanvasMark mark{
        on_canvas(pair.x_px, pair.y_px), {}, QString::fromStdString(pair.name), is_strong};
    if (pose && pinhole) {
      const auto [dx, dy] = capture::reprojection_residual(pair, *pose, *pinhole);
      if (std::isfinite(dx)) mark.wanted = on_canvas(pair.x_px + dx, pair.y_px + dy);
    }
    marks.on_view.push_back(std::move(mark));
    marks.on_mesh.push_back({in_mesh_view(pair.point), pair.name, is_strong});
  }
  return marks;
}

}  // namespace episcope

#include "moc_capture_documents.cpp"
