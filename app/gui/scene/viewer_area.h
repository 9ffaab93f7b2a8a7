// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QPointer>
#include <QRect>
#include <QWidget>

class QSplitter;
class QStackedLayout;

namespace episcope {

class ColorBar;
class EpiPane;
class OverlayBar;
class Panes;
class TileWall;
class ViewCanvas;

/// Where the light field is seen: the view with the vertical EPI beside it, the horizontal one
/// under it and the legend between, divided as the user wants it; or a wall of tiles, or a guest,
/// in the place of view and vertical EPI. While a preview is on the canvas, which is not of the
/// session, nobody else draws there.
class ViewerArea : public QWidget {
  Q_OBJECT

 public:
  explicit ViewerArea(QWidget* parent);

  [[nodiscard]] ViewCanvas* canvas() const { return canvas_; }
  [[nodiscard]] TileWall* wall() const { return wall_; }
  [[nodiscard]] EpiPane* horizontalEpi() const { return horizontal_epi_; }
  [[nodiscard]] EpiPane* verticalEpi() const { return vertical_epi_; }
  [[nodiscard]] ColorBar* colorBar() const { return color_bar_; }
  /// Opacity and focus plane; for the tool bar.
  [[nodiscard]] OverlayBar* overlayBar() const { return overlay_bar_; }

  /// Shows the wall instead of the canvas; the keyboard focus moves along.
  void setWallShown(bool is_shown);
  [[nodiscard]] bool isWallShown() const;
  /// Puts a widget of somebody else in the place of the canvas or the wall until `releaseGuest`, or
  /// until who owns it gives it another parent. The keyboard focus moves along.
  void setGuest(QWidget* guest);
  /// The canvas or the wall is seen again. The guest stays a hidden child of this.
  void releaseGuest();
  [[nodiscard]] QWidget* guest() const { return guest_; }
  /// Adds the EPIs to what can be in a window of its own.
  void addPanesTo(Panes& panes);

  /// What the keyboard belongs to: the canvas, a tile, or the guest.
  [[nodiscard]] QWidget* keyboardHome() const;
  /// The canvas, or the active tile of the wall.
  [[nodiscard]] ViewCanvas* activeCanvas() const;
  /// Pixels of the view that are in sight.
  [[nodiscard]] QRect pixelsInSight() const;

  /// Asks whoever shows a wall or a wipe to end that.
  void requestSingleView() { emit singleViewRequested(); }

  /// Shows a picture that does not belong to the session yet; it cannot be browsed.
  void showPreview(const QImage& picture, const QString& caption);
  /// Back to the session, which is drawn anew by those who hear `previewChanged`.
  void endPreview();
  [[nodiscard]] bool isPreviewing() const { return is_previewing_; }

 signals:
  void singleViewRequested();
  /// Something else is asked for in the place of the guest.
  void guestDismissed();
  void previewChanged(bool is_previewing);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrange();
  void showInCenter(QWidget* widget);
  void fitPlaces();
  /// Columns of both rows keep the same widths, so that view and EPI are aligned.
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

}  // namespace episcope
