// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"
#include "annotation/likeness.h"
#include "app/gui/annotate/wand.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/shell/workbench.h"
#include "app/session/quantity_map.h"
#include "app/session/session.h"
#include "widgets/canvas/canvas_tool.h"

#include <QObject>

#include <memory>

namespace episcope {

class BrushPanel;
class ViewCanvas;

enum class AnnotationTool { Brush, Eraser, Fill, Wand, Polygon, Lasso, Pick };

/// Painting on the view: the mode (browse or annotate), the current tool, sizes, strokes, fills and
/// outlines.
class AnnotateController : public QObject {
  Q_OBJECT

 public:
  AnnotateController(const Workbench& bench, BrushPanel* panel);
  ~AnnotateController() override;

  /// Turns the mouse into a painting tool and shows the tab. Does nothing without a light field.
  void setAnnotating(bool is_annotating);
  [[nodiscard]] bool isAnnotating() const { return is_annotating_; }

  /// Chooses a tool and switches to annotating.
  void setTool(AnnotationTool tool);
  [[nodiscard]] AnnotationTool tool() const { return tool_; }
  /// Resizes the tool in use, brush or eraser.
  void stepSize(double steps);
  void setProtectsOthers(bool protects);
  [[nodiscard]] bool protectsOthers() const { return protects_others_; }

 signals:
  /// The wand needs the disparity of all views.
  void disparityWanted();

 private:
  void addCommands();
  void addModeCommand();
  void addHistoryCommands();
  void addToolCommands();
  void addPolygonCommands();
  void addSizeCommands();
  [[nodiscard]] bool hasDocument() const { return document_.document() != nullptr; }
  /// Precondition: there is a document.
  [[nodiscard]] const History<Edit>& history() const;

  void connectTools();
  void connectPanel();
  void showMode();
  void showSizeKeys();
  void showColor();
  /// Shows strokes only with the tab that edits them; elsewhere they would hide the view.
  void showScribbles();
  [[nodiscard]] bool isTabShown() const;
  [[nodiscard]] CanvasTool* canvasTool() const;
  /// Ends what the mouse is about as a release would, but fills nothing: a region is filled where
  /// it was shown, or not at all.
  void endGesture();
  [[nodiscard]] PaintStyle styleOf(const StrokeStart& start) const;
  /// Ensures that the current label can be painted: adds a label if there is none and shows a
  /// hidden one. Returns false and tells the user if the label is locked.
  bool requireLabel();
  void paintOutlined(const OutlineTool& tool, EditKind kind);
  void fill(const StrokeStart& start);
  [[nodiscard]] PixelRegion regionAt(PixelIndex seed);
  [[nodiscard]] const Likeness& likeness();
  /// The labels shown, with smooth boundaries.
  [[nodiscard]] ImageView<const std::int32_t> segments(const MapSource& source);
  void connectFill();
  void previewFill(PixelIndex seed);
  /// Paints what the fill or the wand shows under the cursor, if anything.
  void fillShown() {
    if (is_fill_shown_) fill({.at = {fill_seed_.x + 0.5, fill_seed_.y + 0.5}});
  }
  /// Superpixels that the wand selects at a pixel.
  [[nodiscard]] std::vector<std::uint8_t> wandAt(PixelIndex seed);
  /// Makes the wand ready if it is in use; tells why it must be waited for.
  void prepareWand();
  [[nodiscard]] int segmentAt(PixelIndex pixel) const;
  void pick(QPointF image);
  void goTo(const DocumentChange& change);

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  ViewCanvas* canvas_;
  BrushPanel* panel_;
  StrokeTool* stroke_tool_;
  FillTool* fill_tool_;
  PolygonTool* polygon_tool_;
  LassoTool* lasso_tool_;
  PointTool* pick_tool_;
  /// What it was made of; nothing else is kept by it.
  struct LikenessKey {
    std::weak_ptr<const LightField> light_field;
    ViewIndex view;
    std::weak_ptr<const DisparityField> disparity;
  };
  Wand wand_;
  LikenessKey likeness_key_;
  std::unique_ptr<const Likeness> likeness_;
  struct SegmentsKey {
    std::weak_ptr<const Labeling> labeling;
    LabelFinish finish;
    ViewIndex view;
  };
  SegmentsKey segments_key_;
  Image<std::int32_t> segments_;
  double tolerance_at_press_ = 0;
  PixelIndex fill_seed_;
  bool is_fill_shown_ = false;
  ViewIndex polygon_view_;  // where it was begun
  bool is_polygon_open_ = false;
  AnnotationTool tool_ = AnnotationTool::Brush;
  bool protects_others_ = false;
  bool is_annotating_ = false;
};

/// Sections of the menu Annotate, in their order.
namespace annotate_section {

inline constexpr int kMode = 0;
inline constexpr int kHistory = 1;
inline constexpr int kTools = 2;
inline constexpr int kCarry = 3;

}  // namespace annotate_section

/// Sections of the submenu Labels.
namespace label_section {

inline constexpr int kLabels = 0;
inline constexpr int kEdit = 1;
inline constexpr int kLook = 2;
inline constexpr int kFiles = 3;

}  // namespace label_section

}  // namespace episcope
