// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QPointer>
#include <QRect>
#include <QWidget>

#include <utility>

class QSplitter;
class QStackedLayout;

namespace episcope {

class ColorBar;
class EpiPane;
class OverlayBar;
class Panes;
class Session;
class TileWall;
class ViewCanvas;

/// Where the light field is seen: the view, the vertical EPI beside it, the horizontal EPI below
/// and the legend between, in adjustable sizes. Until the user drags between them, the EPIs also
/// take room that would be dark around the view. A wall of tiles or a guest can replace view and
/// vertical EPI. While a preview is on the canvas, nothing else is drawn there.
class ViewerArea : public QWidget {
  Q_OBJECT

 public:
  explicit ViewerArea(QWidget* parent);

  [[nodiscard]] ViewCanvas* canvas() const { return canvas_; }
  [[nodiscard]] TileWall* wall() const { return wall_; }
  [[nodiscard]] EpiPane* horizontalEpi() const { return horizontal_epi_; }
  [[nodiscard]] EpiPane* verticalEpi() const { return vertical_epi_; }
  [[nodiscard]] ColorBar* colorBar() const { return color_bar_; }
  /// Map, opacity and focus plane, for the tool bar.
  [[nodiscard]] OverlayBar* overlayBar() const { return overlay_bar_; }

  /// Shows the wall instead of the canvas, and moves the keyboard focus along.
  void setWallShown(bool is_shown);
  [[nodiscard]] bool isWallShown() const { return is_wall_shown_; }
  /// Shows a foreign widget in place of canvas or wall until `releaseGuest`, or until its owner
  /// reparents it. Moves the keyboard focus along.
  void setGuest(QWidget* guest);
  /// Shows canvas or wall again. The guest stays a hidden child.
  void releaseGuest();
  [[nodiscard]] QWidget* guest() const { return guest_; }
  /// Divides the room between view and EPIs anew, unless the user did.
  void fitEpis();
  /// Adds the EPIs to the panes that can be detached.
  void addPanesTo(Panes& panes);

  /// Widget that owns the keyboard: the canvas, a tile, or the guest.
  [[nodiscard]] QWidget* keyboardHome() const;
  /// The canvas, or the active tile of the wall.
  [[nodiscard]] ViewCanvas* activeCanvas() const;
  /// Visible pixels of the view.
  [[nodiscard]] QRect pixelsInSight() const;

  /// Requests the end of a wall or a wipe.
  void requestSingleView() { emit singleViewRequested(); }

  /// Shows a picture that is not part of the session yet; it cannot be browsed.
  void showPreview(const QImage& picture, const QString& caption);
  /// Shows EPIs beside the preview; ignored without one.
  void showPreviewEpis(const QImage& horizontal, const QImage& vertical);
  /// Returns to the session; listeners of `previewChanged` redraw it.
  void endPreview() {
    if (std::exchange(is_previewing_, false)) emit previewChanged(false);
  }
  [[nodiscard]] bool isPreviewing() const { return is_previewing_; }

 signals:
  void singleViewRequested();
  /// Something else is requested in place of the guest.
  void guestDismissed();
  void previewChanged(bool is_previewing);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void showInCenter(QWidget* widget);
  void fitPlaces();
  /// Keeps the columns of both rows equally wide, so that view and EPI are aligned.
  void alignColumns();

  ViewCanvas* canvas_;
  TileWall* wall_;
  EpiPane* horizontal_epi_;
  EpiPane* vertical_epi_;
  ColorBar* color_bar_;
  OverlayBar* overlay_bar_;
  QSplitter* rows_;
  QSplitter* upper_;
  QSplitter* lower_;
  QStackedLayout* center_ = nullptr;  // canvas, wall or guest
  QWidget* vertical_place_;
  QWidget* horizontal_place_;
  QWidget* legend_;
  QPointer<QWidget> guest_;
  bool is_wall_shown_ = false;
  bool is_previewing_ = false;
};

/// What to say where something needs a light field and none is open.
[[nodiscard]] QString open_a_light_field();
/// Why no method runs on the light field in front: there is none, or the one being read covers it.
/// Empty if methods can run.
[[nodiscard]] QString why_nothing_runs(const Session& session, const ViewerArea& area);

}  // namespace episcope
