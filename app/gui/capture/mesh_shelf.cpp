// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/mesh_shelf.h"

#include "app/gui/capture/pair_marks.h"
#include "app/gui/frame/jobs.h"
#include "engine/capture/mesh/mesh_file.h"

#include <QFileInfo>

namespace episcope {

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
