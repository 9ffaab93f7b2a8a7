// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/session/labeling_inputs.h"
#include "app/session/session.h"
#include "engine/labeling/labeler.h"
#include "widgets/panels/segment_panel.h"

#include <QObject>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// Finds the disparity for a segmentation, over all views, since labels are carried through them.
/// By default takes the shown result, else the newest result that covers all views; else runs a
/// method once in the background.
class LabelingSource : public QObject {
  Q_OBJECT

 public:
  /// Choices besides the ids of results.
  enum Choice { Automatic = 0, None = -1, Truth = -2 };

  LabelingSource(Session& session, Jobs& jobs, QObject* parent);

  void choose(int choice);
  [[nodiscard]] int choice() const { return choice_; }
  [[nodiscard]] std::vector<SegmentPanel::Source> sources() const;
  /// Inputs for these features; without a field if there is none yet.
  [[nodiscard]] LabelingDisparity find(FeatureSet features) const;
  /// Begins to estimate a missing disparity. Does nothing if that was tried since this scene was
  /// loaded, if the user chose a source, or if a running method may provide it.
  void provide();
  /// Whether a disparity is being computed.
  [[nodiscard]] bool isComing() const;
  /// Whether this job estimates a disparity for labels alone.
  [[nodiscard]] bool isProvidedBy(quint64 job) const { return job != 0 && job == job_; }

 signals:
  /// The disparity found, or the choices, may have changed.
  void changed();

 private:
  void update(Parts parts);
  void leaveGone();
  [[nodiscard]] LabelingDisparity fieldOf(const EstimateEntry* entry) const;
  [[nodiscard]] LabelingDisparity automatic() const;
  [[nodiscard]] LabelingDisparity truth() const;
  [[nodiscard]] bool coversAll(const DisparityField& field) const;

  Session& session_;
  Jobs& jobs_;
  int choice_ = Automatic;
  // Estimated for labels alone, by scene; without a field as long as it is not there.
  std::map<std::uint64_t, LabelingDisparity> own_;
  quint64 job_ = 0;  // the newest of them
};

/// Edge weights from a file beside the light field, read in the background when a scene is opened.
/// They replace computed weights for label boundaries.
class EdgeSource : public QObject {
  Q_OBJECT

 public:
  EdgeSource(Session& session, QObject* parent);

  /// Weights of all views; null if there are none, or not yet.
  [[nodiscard]] std::shared_ptr<const ViewStack<float>> edges() const;
  /// Sentence that tells where the edges come from.
  [[nodiscard]] QString origin() const;

 signals:
  /// Edges were read.
  void changed();
  /// Edges could not be read; `sentence` is for the user.
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
