// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotate_section.h"
#include "app/gui/frame/commands.h"
#include "widgets/annotate/brush_panel.h"
#include "widgets/canvas/tools/polygon_tool.h"

#include <QAction>

#include <utility>

namespace episcope {
namespace {

QString edit_text(EditKind kind) {
  switch (kind) {
    case EditKind::Paint:
      return AnnotateController::tr("stroke");
    case EditKind::Erase:
      return AnnotateController::tr("erasing");
    case EditKind::Fill:
      return AnnotateController::tr("fill");
    case EditKind::AddLabel:
      return AnnotateController::tr("new label");
    case EditKind::RenameLabel:
      return AnnotateController::tr("label name");
    case EditKind::RecolorLabel:
      return AnnotateController::tr("label colour");
    case EditKind::RemoveLabel:
      return AnnotateController::tr("label removal");
    case EditKind::Import:
      return AnnotateController::tr("import");
    case EditKind::SmoothBoundaries:
      return AnnotateController::tr("smooth boundaries");
    case EditKind::Polygon:
      return AnnotateController::tr("polygon");
    case EditKind::Lasso:
      return AnnotateController::tr("lasso");
  }
  return {};
}

}  // namespace

void AnnotateController::addModeCommand() {
  bench_.commands.add({.id = "annotate.mode",
                       .menu = Menu::Annotate,
                       .text = tr("Annotate"),
                       .tip = tr("Switches between painting labels and browsing"),
                       .icon = "brush",
                       .keys = {tr("Ctrl+B")},
                       .run = [this] { setAnnotating(!is_annotating_); },
                       .section = annotate_section::kMode,
                       .bar = BarSection::Files,
                       .enabled = [this] { return hasDocument(); },
                       .checked = [this] { return is_annotating_; }});
}

void AnnotateController::addHistoryCommands() {
  const auto undone = [this] { return hasDocument() ? history().next_undo() : nullptr; };
  const auto redone = [this] { return hasDocument() ? history().next_redo() : nullptr; };
  bench_.commands.add(
      {.id = "annotate.undo",
       .menu = Menu::Annotate,
       .text = tr("Undo"),
       .tip = tr("Undoes the last stroke or change of labels, on whichever view it was made"),
       .icon = "undo",
       .keys = {tr("Ctrl+Z")},
       .run = [this] { document_.undo(); },
       .section = annotate_section::kHistory,
       .enabled = [undone] { return undone() != nullptr; },
       .live_text =
           [undone] {
             return undone() ? tr("Undo %1").arg(edit_text(undone()->kind)) : tr("Undo");
           }});
  bench_.commands.add({.id = "annotate.redo",
                       .menu = Menu::Annotate,
                       .text = tr("Redo"),
                       .tip = tr("Redoes the last undone change"),
                       .icon = "redo",
                       .keys = {tr("Ctrl+Y"), tr("Ctrl+Shift+Z")},
                       .run = [this] { document_.redo(); },
                       .section = annotate_section::kHistory,
                       .enabled = [redone] { return redone() != nullptr; },
                       .live_text =
                           [redone] {
                             return redone() ? tr("Redo %1").arg(edit_text(redone()->kind))
                                             : tr("Redo");
                           }});
}

void AnnotateController::addToolCommands() {
  struct Row {
    AnnotationTool tool;
    QString id;
    QString text;
    QString tip;
    Qt::Key key;
  };
  for (const Row& row : std::initializer_list<Row>{
           {AnnotationTool::Brush, "brush", tr("Brush"),
            tr("Paints the current label; the right button erases"), Qt::Key_B},
           {AnnotationTool::Eraser, "eraser", tr("Eraser"), tr("Erases what is painted"),
            Qt::Key_E},
           {AnnotationTool::Fill, "fill", tr("Fill"),
            tr("Fills a region up to its edges; the right button clears it"), Qt::Key_F},
           {AnnotationTool::Polygon, "polygon", tr("Polygon"),
            tr("Paints what is inside a polygon: click its corners, then double-click or press "
               "Return; begun with the right button, it erases"),
            Qt::Key_O},
           {AnnotationTool::Lasso, "lasso", tr("Lasso"),
            tr("Paints what a drag goes around; the right button erases it"), Qt::Key_Q},
           {AnnotationTool::Pick, "pick", tr("Pick label"),
            tr("Selects the label under the cursor"), Qt::Key_I}}) {
    QAction* action =
        bench_.commands.add({.id = "annotate." + row.id,
                             .menu = Menu::Annotate,
                             .text = row.text,
                             .tip = row.tip,
                             .icon = row.id,
                             .keys = {row.key},
                             .run = [this, tool = row.tool] { setTool(tool); },
                             .section = annotate_section::kTools,
                             .enabled = [this] { return hasDocument(); },
                             .checked = [this, tool = row.tool] { return tool_ == tool; }});
    panel_->addAction(action, "button.annotate." + row.id);
  }
}

void AnnotateController::addPolygonCommands() {
  const auto is_drawing = [this] { return polygon_tool_->isDrawing(); };
  bench_.commands.add({.id = "annotate.close_polygon",
                       .menu = Menu::Annotate,
                       .text = tr("Close the polygon"),
                       .tip = tr("Paints what is inside the polygon that is being drawn"),
                       .keys = {Qt::Key_Return, Qt::Key_Enter},
                       .run = [this] { polygon_tool_->closeUp(); },
                       .section = annotate_section::kTools,
                       .scope = KeyScope::Viewer,
                       .enabled = is_drawing});
  bench_.commands.add({.id = "annotate.take_corner_back",
                       .menu = Menu::Annotate,
                       .text = tr("Take the last corner back"),
                       .tip = tr("Removes the corner of the polygon that was set last"),
                       .keys = {Qt::Key_Backspace},
                       .run = [this] { polygon_tool_->takeBack(); },
                       .section = annotate_section::kTools,
                       .scope = KeyScope::Viewer,
                       .enabled = is_drawing});
}

void AnnotateController::addSizeCommands() {
  const auto has_document = [this] { return hasDocument(); };
  bench_.commands.add({.id = "annotate.larger",
                       .menu = Menu::Annotate,
                       .text = tr("Larger brush"),
                       .tip = tr("Enlarges the brush, or the eraser while it is in use"),
                       .keys = {Qt::Key_BracketRight, Qt::Key_Period},
                       .run = [this] { stepSize(1); },
                       .section = annotate_section::kTools,
                       .enabled = has_document});
  bench_.commands.add({.id = "annotate.smaller",
                       .menu = Menu::Annotate,
                       .text = tr("Smaller brush"),
                       .tip = tr("Shrinks the brush, or the eraser while it is in use"),
                       .keys = {Qt::Key_BracketLeft, Qt::Key_Comma},
                       .run = [this] { stepSize(-1); },
                       .section = annotate_section::kTools,
                       .enabled = has_document});
  bench_.commands.add({.id = "annotate.protect",
                       .menu = Menu::Annotate,
                       .text = tr("Protect other labels"),
                       .tip = tr("Paints only unpainted pixels and erases only the current label; "
                                 "holding Shift does the same"),
                       .run = [this] { setProtectsOthers(!protects_others_); },
                       .section = annotate_section::kTools,
                       .enabled = has_document,
                       .checked = [this] { return protects_others_; }});
}

const History<Edit>& AnnotateController::history() const {
  return std::as_const(document_).document()->history();
}

void AnnotateController::addCommands() {
  addModeCommand();
  addHistoryCommands();
  addToolCommands();
  addPolygonCommands();
  addSizeCommands();
  panel_->addGap();
  for (const char* id : {"annotate.undo", "annotate.redo"}) {
    panel_->addAction(bench_.commands.find(id), QString("button.%1").arg(id));
  }
}

}  // namespace episcope
