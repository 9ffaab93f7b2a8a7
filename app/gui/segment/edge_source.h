// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/jobs.h"
#include "app/session/session.h"

#include <QObject>

#include <cstdint>
#include <memory>
#include <string>

namespace episcope {

/// The edge weights that lie beside the light field, read in the background when a scene is opened:
/// boundaries between labels go by them instead of computed ones.
class EdgeSource : public QObject {
  Q_OBJECT

 public:
  EdgeSource(Session& session, QObject* parent);

  /// Of all views; null if there are none, or not yet.
  [[nodiscard]] std::shared_ptr<const ViewStack<float>> edges() const;
  /// What edges are taken from, as a sentence.
  [[nodiscard]] QString origin() const;

 signals:
  /// Edges are there.
  void changed();
  /// They could not be read: a sentence for the user.
  void failed(const QString& sentence);

 private:
  struct Read {
    std::shared_ptr<const ViewStack<float>> edges;
    std::string failure;
  };
  void read();
  void take(const Read& read);

  Session& session_;
  std::shared_ptr<const ViewStack<float>> edges_;
  std::uint64_t generation_ = 0;  // of the session that they belong to
  LatestJob read_job_;
};

}  // namespace episcope
