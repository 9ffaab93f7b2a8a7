// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/controls/theme.h"

#include <QImage>
#include <QStringList>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

class QTabletEvent;

namespace episcope {

class CanvasTool;

/// Shows a picture with an overlay, zoomed and panned down to the single pixel, with a cross-hair.
/// It owns no model: what the user does is emitted, and the host answers with a setter.
///
/// The wheel zooms at the cursor; middle drag or Space+drag pans; click moves the cross-hair;
/// Shift+click focuses; drag is parallax while browsing; double click asks for the center view.
/// Keys are left to the host, whose commands call the slots. With a tool in hand, the left and
/// right buttons belong to it, Ctrl+click moves the cross-hair, and Ctrl+Shift+wheel changes its
/// size.
class ViewCanvas : public QWidget {
  Q_OBJECT

 public:
  enum class State { Empty, Loading, Failed, Picture };
  /// Lines printed inside an enlarged pixel (y, x).
  using PixelText = std::function<QStringList(int y, int x)>;

  explicit ViewCanvas(QWidget* parent = nullptr);

  /// Shows `picture`; fits it if its size differs from the last. A null picture shows the empty
  /// state. `to_qimage` converts an Image without a copy.
  void setPicture(const QImage& picture);
  /// Sets the overlay, stretched to the picture; null = none.
  void setOverlay(const QImage& overlay);
  void setOverlayOpacity(double opacity);
  /// Draws the picture grey wherever an overlay lies over it, as qGray has it.
  void setGreyUnderOverlay(bool is_grey);
  void setCrossHair(std::optional<PixelIndex> pixel);
  void setPixelText(PixelText text);
  /// Caption in the upper left corner, e.g. "view (4, 4)", after the badge of a side; empty = none.
  void setCaption(const QString& caption, Side side = Side::None);
  [[nodiscard]] const QString& caption() const { return caption_; }
  /// Draws `overlay` instead of the overlay right of a divider at `position` (part of the width,
  /// clamped to [0, 1]), with `caption` in the upper right corner.
  void setWipe(double position, const QImage& overlay, const QString& caption);
  void endWipe();
  /// Scribbles drawn over the overlay, as large as the picture; null = none.
  void setScribbles(const QImage& scribbles);
  /// Replaces a rectangle of the scribbles and redraws only that.
  void patchScribbles(QPoint at, const QImage& patch);
  void setScribbleOpacity(double opacity);
  /// Outlines a place of interest; empty = none.
  void setOutline(PixelEdges outline);
  /// Outlines the region that numbers refer to; empty = none.
  void setRegion(PixelEdges region);
  /// Named points over the picture; empty = none.
  void setMarks(std::vector<CanvasMark> marks);
  /// Gives the mouse to a tool, which outlives this; null removes it.
  void setTool(CanvasTool* tool);
  /// Whether a left drag is parallax (default) instead of a pan.
  void setParallaxEnabled(bool enabled) { parallax_enabled_ = enabled; }

  /// Shows no picture, but a hint.
  void showEmpty() { showMessage(State::Empty, empty_hint_); }
  /// Hint shown without a picture.
  void setEmptyHint(const QString& hint);
  /// Shows the name of what is being loaded and its progress in [0, 1]; negative = unknown.
  void showLoading(const QString& name, double fraction);
  /// Shows an error instead of a picture.
  void showError(const QString& sentence) { showMessage(State::Failed, sentence); }

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const QImage& picture() const { return picture_; }
  [[nodiscard]] double overlayOpacity() const { return overlay_opacity_; }
  [[nodiscard]] const QImage& scribbles() const { return scribbles_; }
  [[nodiscard]] const PixelEdges& outline() const { return outline_; }
  [[nodiscard]] const PixelEdges& region() const { return region_; }
  [[nodiscard]] const std::vector<CanvasMark>& marks() const { return marks_; }
  /// Index of the mark at a widget position; none if there is none.
  [[nodiscard]] std::optional<int> markAt(QPointF position) const;
  [[nodiscard]] CanvasTool* tool() const { return tool_; }
  [[nodiscard]] std::optional<PixelIndex> crossHair() const { return cross_hair_; }
  [[nodiscard]] CanvasTransform canvasTransform() const { return transform_; }
  /// Scale at which the whole picture fits.
  [[nodiscard]] double fitScale() const { return fit_transform(picture_.size(), size()).scale; }
  /// Visible pixels; empty without a picture.
  [[nodiscard]] QRect visiblePixels() const;
  /// Position of the divider; none without a wipe.
  [[nodiscard]] std::optional<double> wipePosition() const { return wipe_position_; }
  [[nodiscard]] bool isFitted() const { return fitted_; }
  /// Pixel under a widget position; none outside the picture.
  [[nodiscard]] std::optional<PixelIndex> pixelAt(QPointF position) const;
  /// Center of a pixel in widget coordinates.
  [[nodiscard]] QPointF positionOf(PixelIndex pixel) const;

  [[nodiscard]] QSize sizeHint() const override { return {640, 480}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 120}; }

 public slots:
  /// Follows a linked viewport; does not emit `transformChanged` for an equal value.
  void setCanvasTransform(const episcope::CanvasTransform& transform);
  void zoomIn() { zoomAt(cursor_.value_or(QRectF(rect()).center()), kCanvasZoomStep); }
  void zoomOut() { zoomAt(cursor_.value_or(QRectF(rect()).center()), 1 / kCanvasZoomStep); }
  /// Fits the whole picture, also after resizing until the user zooms or pans.
  void zoomToFit() { changeTransform(fit_transform(picture_.size(), size()), true); }
  /// 100 %: one image pixel per screen pixel.
  void zoomToActualSize();
  /// Pans as little as needed to make a pixel visible.
  void ensureVisible(episcope::PixelIndex pixel);

 signals:
  /// The picture has another size.
  void pictureResized();
  void transformChanged(const episcope::CanvasTransform& transform);
  /// The user clicked a pixel.
  void crossHairRequested(episcope::PixelIndex pixel);
  void focusRequested(episcope::PixelIndex pixel);
  void centerRequested();
  /// A menu is wanted for a pixel, at a place of the screen. Not while a tool has the mouse.
  void menuRequested(episcope::PixelIndex pixel, QPoint place);
  /// Pixel under the mouse, or none.
  void cursorMoved(std::optional<episcope::PixelIndex> pixel);
  /// A left drag in browse mode: begin, movement since then. `views` is (du, dv), not rounded;
  /// points nearer than the zero plane follow the hand.
  void parallaxStarted();
  void parallaxDragged(QPointF views);
  /// The user dragged the divider to a part of the width.
  void wipeMoved(double position);
  /// Space was pressed and released without a drag. Held Space pans; shortcuts on Space do not
  /// reach the canvas.
  void spaceTapped();
  /// Alt+wheel or Ctrl+wheel: focus plane steps, positive = nearer.
  void focusStepped(double steps);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void tabletEvent(QTabletEvent* event) override;
  void leaveEvent(QEvent*) override { followCursor(std::nullopt); }
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  enum class Gesture { None, Press, Pan, Parallax, Wipe, Tool };

  void changeTransform(const CanvasTransform& transform, bool fitted);
  void zoomAt(QPointF anchor, double factor);
  void beginDrag();
  void drag(QPointF position);
  [[nodiscard]] bool pressTool(QPointF position, Qt::MouseButton button,
                               Qt::KeyboardModifiers modifiers, bool is_double = false);
  void endTool();
  void updatePixels(const QRect& pixels);
  void updateMark();
  void updateCursorShape();
  void showMessage(State state, const QString& text);
  [[nodiscard]] double dividerX() const;
  [[nodiscard]] bool isOnDivider(QPointF position) const;
  void makeGrey();
  [[nodiscard]] const QImage& pictureUnder(const QImage& overlay) const;
  void paintPicture(QPainter& painter, const QRect& exposed, const QImage& overlay) const;
  void paintWipe(QPainter& painter, const QRect& exposed) const;
  void paintPixelTexts(QPainter& painter, const QRect& exposed) const;
  void paintCrossHair(QPainter& painter) const;
  void paintEdges(QPainter& painter, const PixelEdges& edges, const QPen& pen) const;
  void paintMark(QPainter& painter) const;
  void paintMarks(QPainter& painter) const;
  void paintShape(QPainter& painter) const;
  void paintCaption(QPainter& painter) const;
  void paintMessage(QPainter& painter) const;
  void followCursor(std::optional<QPointF> position);

  State state_ = State::Empty;
  QString message_;
  QString empty_hint_ = tr("Open a light field to see it here.");
  double loading_fraction_ = -1;
  QString caption_;
  Side side_ = Side::None;
  std::optional<double> wipe_position_;
  QImage wipe_overlay_;
  QString wipe_caption_;
  QImage picture_;
  QImage grey_picture_;  // null while none is wanted
  bool is_grey_under_overlay_ = false;
  QImage overlay_;
  double overlay_opacity_ = 0.7;
  QImage scribbles_;
  double scribble_opacity_ = 0.7;
  PixelEdges outline_;
  PixelEdges region_;
  std::vector<CanvasMark> marks_;
  std::optional<PixelIndex> cross_hair_;
  PixelText pixel_text_;
  CanvasTransform transform_;
  bool fitted_ = true;
  bool parallax_enabled_ = true;

  CanvasTool* tool_ = nullptr;
  QRect mark_rect_;       // as it was drawn last
  bool has_pen_ = false;  // a pen is drawing
  Gesture gesture_ = Gesture::None;
  Qt::MouseButton gesture_button_ = Qt::NoButton;  // that ends it
  Qt::KeyboardModifiers press_modifiers_;
  QPointF press_position_;
  QPointF last_position_;
  std::optional<QPointF> cursor_;
  std::optional<PixelIndex> hovered_;
  bool space_held_ = false;
  bool space_used_ = false;
};

}  // namespace episcope
