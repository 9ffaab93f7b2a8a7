// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/opening/scene_opener.h"
#include "app/session/session.h"

#include <QObject>

namespace episcope {

/// Bakes the focus plane in (shear.h): the light field is read again, so that it is interpolated
/// only once however often this is done; results move along in the background.
class FocusController : public QObject {
  Q_OBJECT

 public:
  FocusController(Session& session, Jobs& jobs, OpenController& opener,
                  const DocumentController& document, QObject* parent);

  /// What is in focus gets disparity 0.
  void apply();
  /// Back to the plane of zero disparity of the files.
  void undo();
  [[nodiscard]] bool canApply() const;
  [[nodiscard]] bool canUndo() const;

 signals:
  /// A sentence for the user that is no failure.
  void hint(const QString& sentence);

 private:
  /// What is looked at, and the results.
  struct Kept {
    ViewIndex view;
    PixelIndex cross_hair;
    std::vector<EstimatePtr> estimates;
    std::size_t shown = 0;     ///< Place in `estimates`,
    std::size_t compared = 0;  ///< or their number if there is none.
  };

  void bake(double focus_px);
  [[nodiscard]] Kept kept() const;
  void bringBack(const Kept& kept, double moved_px);
  void moveResults(const Kept& kept, double moved_px);

  Session& session_;
  Jobs& jobs_;
  OpenController& opener_;
  const DocumentController& document_;
};

}  // namespace episcope
