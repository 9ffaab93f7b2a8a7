// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/session/segmentation.h"
#include "app/session/session.h"

#include <QObject>
#include <QString>

#include <memory>
#include <vector>

namespace episcope {

/// Judges labels against the true ones, in the background, and words what was found.
class LabelScores : public QObject {
  Q_OBJECT

 public:
  explicit LabelScores(const Session& session, QObject* parent);

  /// What is judged: labels of the shown light field (null = none), as their names and boundaries
  /// are now.
  struct Judged {
    LabelingPtr labeling;
    LabelFinish finish;
    std::vector<LabelInfo> labels;
    friend bool operator==(const Judged&, const Judged&) = default;
  };
  /// Judges labels in the shown view and in all that they cover, unless that was done. `disparity`
  /// (may be null) tells how consistent they are.
  void judge(const Judged& judged, std::shared_ptr<const DisparityField> disparity);
  /// "correct: 97.1 % of this view, …"; empty until something is known.
  [[nodiscard]] const QString& text() const { return text_; }

 signals:
  void changed();

 private:
  struct Known {
    Judged judged;
    TrueLabelsPtr truth;
    ViewIndex view;
    friend bool operator==(const Known&, const Known&) = default;
  };

  const Session& session_;
  Known known_;
  QString text_;
  LatestJob job_;
};

}  // namespace episcope
