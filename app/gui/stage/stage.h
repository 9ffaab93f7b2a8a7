// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QRect>
#include <QWidget>

namespace episcope {

class ColorBar;
class EpiPane;
class OverlayBar;
class TileWall;
class ViewCanvas;

/// Where the light field is seen: the view with the vertical EPI beside it, the horizontal one
/// under it and the legend between, or a wall of tiles in the place of view and vertical EPI. While
/// a preview is on the canvas, which is not of the session, nobody else draws there.
class Stage : public QWidget {
  Q_OBJECT

 public:
  explicit Stage(QWidget* parent);

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
  void previewChanged(bool is_previewing);

 private:
  ViewCanvas* canvas_;
  TileWall* wall_;
  EpiPane* horizontal_epi_;
  EpiPane* vertical_epi_;
  ColorBar* color_bar_;
  OverlayBar* overlay_bar_;
  bool is_previewing_ = false;
};

}  // namespace episcope
