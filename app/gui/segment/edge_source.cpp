// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment/edge_source.h"

#include "app/session/labels/labeling_inputs.h"
#include "engine/core/error.h"

namespace episcope {

EdgeSource::EdgeSource(Session& session, QObject* parent)
    : QObject(parent), session_(session), read_job_(this) {
  session_.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) read();
  });
}

std::shared_ptr<const ViewStack<float>> EdgeSource::edges() const {
  return generation_ == session_.generation() ? edges_ : nullptr;
}

QString EdgeSource::origin() const {
  return edges() ? tr("Boundaries follow the edge weights of the file beside the light field.")
                 : tr("Boundaries follow edges computed from the image and, where it is known, the "
                      "disparity.");
}

void EdgeSource::read() {
  edges_ = nullptr;
  generation_ = session_.generation();
  read_job_.drop();
  const auto& scene = session_.scene();
  if (!scene || !has_edge_probabilities(*scene)) return;
  read_job_.start<Read>(
      [scene](const Progress& progress) -> Read {
        try {
          return {find_edge_probabilities(*scene, progress), {}};
        } catch (const IoError& error) {
          return {nullptr, error.what()};
        }
      },
      [this](const Read& read) { take(read); });
}

void EdgeSource::take(const Read& read) {
  edges_ = read.edges;
  if (edges_) {
    emit changed();
  } else {
    emit failed(tr("%1. Edges are computed instead.").arg(QString::fromStdString(read.failure)));
  }
}

}  // namespace episcope

#include "moc_edge_source.cpp"
