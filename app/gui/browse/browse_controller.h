// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/session.h"
#include "engine/render/shade.h"

#include <QImage>
#include <QKeySequence>
#include <QList>
#include <QObject>

#include <utility>

namespace episcope {

class ViewCanvas;
class ViewGrid;

/// Walks through the views: current view, cross-hair, EPIs, focus plane, view grid, player,
/// parallax.
class BrowseController : public QObject {
  Q_OBJECT

 public:
  explicit BrowseController(const Workbench& bench);

  void step(int dv, int du);
  void jump(int dv, int du);
  void goToCenter();
  void stepFocus(double steps);
  /// Refocuses the view at the focus plane, or only shears the EPIs.
  void setRefocusing(bool refocuses);
  /// Stops playing, or removes the line drawn in an EPI; false if there was neither.
  bool endWhatIsInHand();

 private:
  void addCommands();
  void addWalkCommands();
  void addStep(const QString& id, const QString& text, const QString& tip, int dv, int du,
               Qt::Key key);
  void addZoomCommands();
  void addZoom(const QString& id, const QString& text, const QString& tip, const QString& icon,
               const QList<QKeySequence>& keys, void (ViewCanvas::*zoom)());
  void addFocusCommands();
  void connectCanvas();
  void showMenu(PixelIndex pixel, QPoint place);
  void measureAt(PixelIndex pixel);
  void connectEpis();
  void update(Parts parts);
  void setPreviewing(bool is_previewing);
  void showScene();
  void showFocusReach();
  void showView();
  void showPicture(const QImage& picture);
  // Both EPIs through the cross-hair, drawn.
  struct EpiPictures {
    Image<std::uint8_t> horizontal, vertical;
  };
  void showEpis();
  void showEpis(EpiPictures epis, ViewIndex view, PixelIndex pixel);
  void clearLinesOfOtherRows();
  void showSlopes();
  void startThumbnails();
  void markPainted();
  void focusAt(PixelIndex pixel);
  /// Focuses at a pixel whose disparity nothing tells.
  void matchAt(PixelIndex pixel);

  Workbench bench_;
  Session& session_;
  ViewerArea& viewer_area_;
  ViewGrid* grid_;
  bool refocuses_ = true;
  ViewIndex parallax_start_;
  std::pair<int, int> horizontal_row_{-1, -1};     // v and y of the EPI that is shown
  std::pair<int, int> vertical_row_{-1, -1};       // u and x
  std::shared_ptr<const render::ToneTable> tone_;  // null = samples as they are
  LatestJob epi_job_;                              // of light fields on disk
  LatestJob refocus_job_;
  LatestJob thumbnail_job_;
  LatestJob match_job_;
};

}  // namespace episcope
