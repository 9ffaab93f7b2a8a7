// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/session/session.h"

#include <QImage>
#include <QObject>

#include <optional>
#include <vector>

namespace episcope {

/// Walks through the views: current view, cross-hair, EPIs, focus plane, view grid, playing,
/// parallax.
class BrowseController : public QObject {
  Q_OBJECT

 public:
  BrowseController(Session& session, const Panels& panels, QObject* parent);

  /// Shows a picture that does not belong to the session yet; it cannot be browsed.
  void showPreview(const QImage& picture, const QString& caption);
  /// Back to the session.
  void endPreview();
  [[nodiscard]] bool isPreviewing() const { return is_previewing_; }

  void step(int dv, int du);
  void jump(int dv, int du);
  void goToCenter();
  void togglePlay();
  void stepFocus(double steps);
  void resetFocus();
  /// Whether the view is refocused with the focus plane, or only the EPIs are sheared.
  void setRefocusing(bool refocuses);
  /// Ends playing or forgets the line drawn in an EPI; false if there was nothing to end.
  bool endWhatIsInHand();

 signals:
  /// A sentence for the user that is no failure.
  void hint(const QString& sentence);

 private:
  void connectCanvas();
  void connectEpis();
  void update(Parts parts);
  void showScene();
  void showView();
  void showPicture(const QImage& picture);
  void showEpis();
  void showSlopes();
  void startThumbnails();
  void focusAt(PixelIndex pixel);

  Session& session_;
  Panels panels_;
  bool is_previewing_ = false;
  bool refocuses_ = true;
  ViewIndex parallax_start_;
  LatestJob refocus_job_;
  LatestJob thumbnail_job_;
};

}  // namespace episcope
