// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate_actions.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/main_window.h"
#include "widgets/annotate/annotation_bar.h"
#include "widgets/annotate/brush_panel.h"

#include <QAction>
#include <QActionGroup>

namespace episcope {
namespace {

constexpr int kLabelKeys = 9;
constexpr const char* kTools[] = {"annotate.brush", "annotate.eraser", "annotate.fill",
                                  "annotate.pick"};

QString tr(const char* source) {
  return MainWindow::tr(source);
}

QString edit_text(EditKind kind) {
  switch (kind) {
    case EditKind::Paint:
      return tr("stroke");
    case EditKind::Erase:
      return tr("erasing");
    case EditKind::Fill:
      return tr("fill");
    case EditKind::AddLabel:
      return tr("new label");
    case EditKind::RenameLabel:
      return tr("name of label");
    case EditKind::RecolorLabel:
      return tr("colour of label");
    case EditKind::RemoveLabel:
      return tr("removal of label");
    case EditKind::Import:
      return tr("import");
  }
  return {};
}

void add_history(ActionTable& table, MainWindow& window) {
  DocumentController& document = window.document();
  const QString menu = tr("Annotate");
  table.add(
      {.id = "annotate.mode",
       .menu = menu,
       .text = tr("Annotate"),
       .tip = tr("Paints labels on the view, or goes back to browsing"),
       .icon = "brush",
       .keys = {tr("Ctrl+B")},
       .run = [&window] { window.annotate().setAnnotating(!window.annotate().isAnnotating()); },
       .is_checkable = true});
  table.add({.id = "annotate.undo",
             .menu = menu,
             .text = tr("Undo"),
             .tip = tr("Takes the last stroke or change of labels back, on whichever view it is"),
             .icon = "undo",
             .keys = {tr("Ctrl+Z")},
             .run = [&document] { document.undo(); },
             .begins_group = true});
  table.add({.id = "annotate.redo",
             .menu = menu,
             .text = tr("Redo"),
             .tip = tr("Makes what was undone again"),
             .icon = "redo",
             .keys = {tr("Ctrl+Y"), tr("Ctrl+Shift+Z")},
             .run = [&document] { document.redo(); }});
}

void add_tool(ActionTable& table, MainWindow& window, const char* id, const QString& text,
              const QString& tip, const QString& icon, Qt::Key key, AnnotationTool tool) {
  table.add({.id = id,
             .menu = tr("Annotate"),
             .text = text,
             .tip = tip,
             .icon = icon,
             .keys = {key},
             .run = [&window, tool] { window.annotate().setTool(tool); },
             .is_checkable = true,
             .begins_group = tool == AnnotationTool::Brush});
}

void add_tools(ActionTable& table, MainWindow& window) {
  const auto add = [&](AnnotationTool tool, const QString& text, const QString& tip,
                       const QString& icon, Qt::Key key) {
    add_tool(table, window, kTools[static_cast<int>(tool)], text, tip, icon, key, tool);
  };
  add(AnnotationTool::Brush, tr("Brush"), tr("Paints the current label; the right button erases"),
      "brush", Qt::Key_B);
  add(AnnotationTool::Eraser, tr("Eraser"), tr("Erases what is painted"), "eraser", Qt::Key_E);
  add(AnnotationTool::Fill, tr("Fill"), tr("Fills a region up to its edges; right: empties it"),
      "fill", Qt::Key_F);
  add(AnnotationTool::Pick, tr("Pick label"), tr("Makes the label under the mouse the current one"),
      "pick", Qt::Key_I);
  AnnotateController& annotate = window.annotate();
  const QString menu = tr("Annotate");
  table.add({.id = "annotate.larger",
             .menu = menu,
             .text = tr("Larger brush"),
             .tip = tr("Makes the brush, or the eraser in hand, larger"),
             .icon = "",
             .keys = {Qt::Key_BracketRight, Qt::Key_Period},
             .run = [&annotate] { annotate.stepSize(1); }});
  table.add({.id = "annotate.smaller",
             .menu = menu,
             .text = tr("Smaller brush"),
             .tip = tr("Makes the brush, or the eraser in hand, smaller"),
             .icon = "",
             .keys = {Qt::Key_BracketLeft, Qt::Key_Comma},
             .run = [&annotate] { annotate.stepSize(-1); }});
  QAction* protect = table.add(
      {.id = "annotate.protect",
       .menu = menu,
       .text = tr("Protect other labels"),
       .tip = tr("Paints over bare pixels only, erases the current label only; Shift does so too"),
       .icon = "",
       .keys = {},
       .run = {},
       .is_checkable = true});
  QObject::connect(protect, &QAction::toggled, &annotate, &AnnotateController::setProtectsOthers);
}

void add_labels(ActionTable& table, MainWindow& window) {
  AnnotateController& annotate = window.annotate();
  const QString menu = tr("Annotate › Label");
  for (int id = 1; id <= kLabelKeys; ++id) {
    table.add({.id = QString("annotate.label_%1").arg(id),
               .menu = menu,
               .text = tr("Label %1").arg(id),
               .tip = tr("Paints with label %1").arg(id),
               .icon = "",
               .keys = {QKeySequence(Qt::Key_0 + id)},
               .run = [&annotate, id] { annotate.chooseLabel(id); }});
  }
  const auto add = [&](const char* id, const QString& text, const QString& tip, const char* icon,
                       QKeySequence key, std::function<void()> run) {
    table.add({.id = id,
               .menu = menu,
               .text = text,
               .tip = tip,
               .icon = icon,
               .keys = key.isEmpty() ? QList<QKeySequence>() : QList<QKeySequence>{key},
               .run = std::move(run),
               .begins_group = QString(id) == "annotate.next_label"});
  };
  add("annotate.next_label", tr("Next label"), tr("Paints with the next label"), "", Qt::Key_N,
      [&annotate] { annotate.chooseNextLabel(); });
  add("annotate.swap_labels", tr("Swap labels"), tr("Goes back to the label used before"), "",
      Qt::Key_X, [&annotate] { annotate.swapLabels(); });
  add("annotate.add_label", tr("Add label"), tr("Adds a label and paints with it"), "add",
      tr("Ctrl+Shift+N"), [&annotate] { annotate.addLabel(); });
  add("annotate.rename_label", tr("Rename label"), tr("Edits the name of the current label"),
      "rename", Qt::Key_F2, [&annotate] { annotate.renameLabel(); });
  add("annotate.recolor_label", tr("Change colour…"), tr("Changes the colour of the current label"),
      "", {}, [&annotate] { annotate.recolorLabel(annotate.label()); });
  add("annotate.remove_label", tr("Remove label"),
      tr("Removes the current label and what is painted with it"), "trash", {},
      [&annotate] { annotate.removeLabel(annotate.label()); });
}

void add_carrying(ActionTable& table, MainWindow& window) {
  QAction* carry = table.add({.id = "annotate.carry",
                              .menu = tr("Annotate"),
                              .text = tr("Carry to all views"),
                              .tip = tr("Shows on every view what is painted on the others"),
                              .icon = "carry",
                              .keys = {Qt::Key_C},
                              .run = {},
                              .is_checkable = true,
                              .begins_group = true});
  QObject::connect(carry, &QAction::toggled, &window.scribbles(), &ScribbleController::setCarried);
}

void show_history(ActionTable& table, const AnnotationDocument* document) {
  const Edit* undo = document ? document->history().next_undo() : nullptr;
  const Edit* redo = document ? document->history().next_redo() : nullptr;
  QAction* back = table.find("annotate.undo");
  back->setEnabled(undo);
  back->setText(undo ? tr("Undo %1").arg(edit_text(undo->kind)) : tr("Undo"));
  QAction* again = table.find("annotate.redo");
  again->setEnabled(redo);
  again->setText(redo ? tr("Redo %1").arg(edit_text(redo->kind)) : tr("Redo"));
}

void show_state(ActionTable& table, MainWindow& window) {
  const AnnotationDocument* document = std::as_const(window.document()).document();
  show_history(table, document);
  for (const Command& command : table.commands()) {
    const bool is_history = command.id == "annotate.undo" || command.id == "annotate.redo";
    if (command.id.startsWith("annotate.") && !is_history) {
      table.find(command.id)->setEnabled(document != nullptr);
    }
  }
  for (int id = 1; id <= kLabelKeys; ++id) {
    const LabelInfo* label = document ? document->labels().find(id) : nullptr;
    QAction* action = table.find(QString("annotate.label_%1").arg(id));
    action->setText(label ? QString::fromStdString(label->name) : tr("Label %1").arg(id));
    action->setVisible(label != nullptr || !document);
  }
  const bool has_label = window.annotate().label() != 0;
  for (const char* id : {"annotate.next_label", "annotate.swap_labels", "annotate.rename_label",
                         "annotate.recolor_label", "annotate.remove_label"}) {
    table.find(id)->setEnabled(has_label);
  }
  table.find("annotate.mode")->setChecked(window.annotate().isAnnotating());
  table.find(kTools[static_cast<int>(window.annotate().tool())])->setChecked(true);
  table.find("annotate.protect")->setChecked(window.annotate().protectsOthers());
  table.find("annotate.carry")->setChecked(window.scribbles().isCarried());
}

void show_size_keys(const ActionTable& table, BrushPanel& panel) {
  QStringList keys{table.keyText("annotate.smaller"), table.keyText("annotate.larger")};
  keys.removeAll({});
  panel.setSizeKeys(keys.join(tr(" and ")));
}

}  // namespace

void add_annotate_actions(ActionTable& table, MainWindow& window) {
  add_history(table, window);
  add_tools(table, window);
  add_carrying(table, window);
  add_labels(table, window);
}

void add_scribble_file_actions(ActionTable& table, MainWindow& window) {
  AnnotationFiles& files = window.annotationFiles();
  const QString menu = tr("File");
  table.add({.id = "file.save_scribbles",
             .menu = menu,
             .text = tr("Save scribbles"),
             .tip = tr("Saves labels and scribbles, beside the light field if that can be written"),
             .icon = "save",
             .keys = {QKeySequence::Save},
             .run = [&files] { files.save(); },
             .begins_group = true});
  table.add({.id = "file.save_scribbles_as",
             .menu = menu,
             .text = tr("Save scribbles as…"),
             .tip = tr("Saves labels and scribbles in another file"),
             .icon = "",
             .keys = {tr("Ctrl+Shift+S")},
             .run = [&files] { files.saveAsDialog(); }});
  table.add({.id = "file.import_scribbles",
             .menu = menu,
             .text = tr("Import scribbles…"),
             .tip = tr("Adds scribbles of another file where nothing is painted"),
             .icon = "open",
             .keys = {},
             .run = [&files] { files.importDialog(); }});
  table.add({.id = "file.compare_labels",
             .menu = menu,
             .text = tr("Compare with true labels…"),
             .tip = tr("Holds the segmentation against GT_LABELS of another file"),
             .icon = "open",
             .keys = {},
             .run = [&files] { files.compareDialog(); }});
  table.add({.id = "file.export_scribbles",
             .menu = menu,
             .text = tr("Export scribbles as pictures…"),
             .tip = tr("Writes a PNG picture of each painted view"),
             .icon = "picture",
             .keys = {},
             .run = [&files] { files.exportDialog(); }});
}

void follow_document(ActionTable& table, MainWindow& window) {
  BrushPanel* panel = window.panels().brush;
  auto* tools = new QActionGroup(&table);
  for (const char* id : kTools) {
    tools->addAction(table.find(id));
    panel->addAction(table.find(id), QString("button.%1").arg(id));
  }
  panel->addGap();
  for (const char* id : {"annotate.undo", "annotate.redo"}) {
    panel->addAction(table.find(id), QString("button.%1").arg(id));
  }
  for (const char* id : {"file.save_scribbles", "file.import_scribbles", "file.export_scribbles"}) {
    window.panels().annotation->addAction(table.find(id), QString("button.%1").arg(id));
  }
  const auto show_keys = [&table, panel] { show_size_keys(table, *panel); };
  QObject::connect(&table, &ActionTable::keysChanged, panel, show_keys);
  show_keys();
  const auto show = [&table, &window] { show_state(table, window); };
  const auto* document = &window.document();
  QObject::connect(document, &DocumentController::replaced, &table, show);
  QObject::connect(document, &DocumentController::changed, &table, show);
  const auto* annotate = &window.annotate();
  for (const auto signal : {&AnnotateController::modeChanged, &AnnotateController::toolChanged,
                            &AnnotateController::labelChanged}) {
    QObject::connect(annotate, signal, &table, show);
  }
  QObject::connect(&window.scribbles(), &ScribbleController::carriedChanged, &table, show);
  show();
}

}  // namespace episcope
