// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/annotate.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_controller.h"
#include "app/gui/annotate/label_look_controller.h"
#include "app/gui/annotate/recovery_controller.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/frame/frame.h"
#include "widgets/annotate/annotation_bar.h"
#include "widgets/annotate/brush_panel.h"
#include "widgets/annotate/label_palette.h"

#include <QVBoxLayout>

namespace episcope {

void add_annotating(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  auto* brush = new BrushPanel(tab);
  auto* palette = new LabelPalette(tab);
  auto* bar = new AnnotationBar(tab);
  auto* room = new QVBoxLayout;
  auto* layout = new QVBoxLayout(tab);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(brush);
  layout->addWidget(palette, 1);
  layout->addLayout(room);
  layout->addWidget(bar);
  bench.frame.addTab({.id = "annotate",
                      .title = AnnotateController::tr("Annotate"),
                      .command_text = AnnotateController::tr("Annotate tab"),
                      .command_tip = AnnotateController::tr("Shows the labels and painting tools"),
                      .widget = tab,
                      .room = room});
  new AnnotateController(bench, brush);
  new LabelController(bench, palette);
  new LabelLookController(bench, palette);
  new ScribbleController(bench, bar);
  new AnnotationFiles(bench, bar);
  new RecoveryController(bench);
}

}  // namespace episcope
