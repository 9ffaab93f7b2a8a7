// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/mesh_shelf.h"

#include "app/gui/capture/capture_documents.h"
#include "app/gui/capture/pair_marks.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/scene_summary.h"
#include "app/session/session.h"
#include "engine/capture/mesh_file.h"
#include "engine/capture/pose_file.h"
#include "engine/io/formats/write_scene.h"

#include <QFileInfo>

namespace episcope {

MeshResults::MeshResults(const Workbench& bench, const CaptureDocuments& documents,
                         const MeshShelf& shelf, QObject* parent)
    : QObject(parent), bench_(bench), documents_(documents), shelf_(shelf) {}

std::vector<PosedMesh> MeshResults::posedMeshes() const {
  std::vector<PosedMesh> posed;
  QStringList left_out;
  for (const CaptureObject& object : documents_.now().work().objects) {
    const ReadMesh* read = shelf_.find(object.mesh);
    if (read && object.pose) {
      posed.push_back({read->mesh, object.pose->pose});
    } else {
      left_out << QString::fromStdString(object.name);
    }
  }
  if (!posed.empty() && !left_out.isEmpty()) {
    bench_.messages.warn(
        tr("Left out, for lack of a mesh or a pose: %1.").arg(left_out.join(QStringLiteral(", "))));
  }
  return posed;
}

void MeshResults::showOverView() {
  const std::vector<PosedMesh> meshes = posedMeshes();
  if (meshes.empty()) return;
  const quint64 job = bench_.jobs.start<EstimatePtr>(
      Lane::Estimate, job_title(tr("Depth of the mesh"), bench_.session),
      [meshes, scene = bench_.session.scene()](const Progress& progress) {
        return std::make_shared<const Estimate>(mesh_estimate(meshes, *scene, progress));
      },
      [this, scene = bench_.session.generation()](const EstimatePtr& estimate) {
        int& result = results_[scene];
        if (scene == bench_.session.generation()) bench_.session.remove_estimate(result);
        result = bench_.session.add_estimate(estimate, display_range(*estimate), scene);
      });
  bench_.jobs.setScene(job, bench_.session.generation());
}

void MeshResults::writeTruth(const QString& path) {
  const std::vector<PosedMesh> meshes = posedMeshes();
  if (meshes.empty() || !is_new_light_field(path, bench_.messages)) return;
  write_in_background(
      bench_.jobs, bench_.messages, path,
      [file = path_of(path), meshes, scene = bench_.session.scene()](const Progress& progress) {
        const Scene made = with_mesh_truth(meshes, *scene, progress.part(0, 0.9));
        io::write_archive(file, made, progress.part(0.9, 1));
      });
}

void MeshResults::savePose(const QString& path) {
  const CaptureObject* object = documents_.now().work().object();
  if (!object || !object->pose || !has_suffix(path, {"json"}, bench_.messages)) return;
  const capture::PoseStory story{object->mesh, bench_.session.input(),
                                 bench_.session.light_field()->info().camera, object->pairs,
                                 *object->pose};
  write_in_background(
      bench_.jobs, bench_.messages, path,
      [file = path_of(path), story](const Progress&) { capture::write_pose(file, story); });
}

MeshShelf::MeshShelf(const Workbench& bench, QObject* parent) : QObject(parent), bench_(bench) {
  connect(&bench.jobs, &Jobs::failed, this, [this](const QString&, quint64 job) {
    for (const auto& [file, reading] : reading_) {
      if (reading == job) broken_.insert(file);
    }
  });
}

void MeshShelf::read(const std::string& file, const std::function<void()>& then) {
  reading_[file] = bench_.jobs.start<ReadMesh>(
      Lane::Load, tr("Opening %1").arg(QFileInfo(QString::fromStdString(file)).fileName()),
      [file](const Progress& progress) {
        ReadMesh read;
        read.mesh = std::make_shared<const capture::TriangleMesh>(
            capture::read_mesh(file, progress.part(0, 0.8)));
        read.cloud = mesh_parts(*read.mesh);
        return read;
      },
      [this, file, then](const ReadMesh& read) {
        reading_.erase(file);
        broken_.erase(file);
        meshes_[file] = read;
        then();
      },
      [this, file] {
        if (reading_.erase(file) > 0) emit changed();
      });
}

void MeshShelf::keep(const std::set<std::string>& files) {
  std::erase_if(meshes_, [&](const auto& each) { return !files.contains(each.first); });
  for (const std::string& file : files) {
    if (file.empty() || find(file) || isReading(file) || isBroken(file)) continue;
    read(file, [this] { emit changed(); });
  }
}

const ReadMesh* MeshShelf::find(const std::string& file) const {
  const auto found = meshes_.find(file);
  return found == meshes_.end() ? nullptr : &found->second;
}

}  // namespace episcope

#include "moc_mesh_shelf.cpp"
