// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/shell/commands.h"
#include "widgets/panels/segment_panel.h"

#include <QCoreApplication>

#include <initializer_list>

namespace episcope {

namespace {

using render::Quantity;

constexpr int kSegmentSection = 0;

struct SegmentText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SegmentController)
};

void add_runs(Commands& commands, SegmentController& segments) {
  const auto has_input = [&segments] { return segments.labeler().has_input(); };
  commands.add(
      {.menu = Menu::Segmentation, .section = kSegmentSection, .enabled = has_input},
      {{.id = "segment.live",
        .text = SegmentText::tr("Live"),
        .tip = SegmentText::tr("Segments the view again after every stroke"),
        .icon = "live",
        .keys = {Qt::Key_L},
        .run = [&segments] { segments.setLive(!segments.isLive()); },
        .checked = [&segments] { return segments.isLive(); }},
       {.id = "segment.update",
        .text = SegmentText::tr("Update now"),
        .tip = SegmentText::tr("Segments this view from the scribbles"),
        .icon = "run",
        .keys = {Qt::Key_U},
        .run = [&segments] { segments.updateNow(); }},
       {.id = "segment.all",
        .text = SegmentText::tr("Segment all views"),
        .tip = SegmentText::tr("Segments all views, with labels that agree along the rays"),
        .icon = "tiles",
        .keys = {SegmentText::tr("Shift+U")},
        .run = [&segments] { segments.segmentAllViews(); }}});
}

void add_export(const Workbench& bench, SegmentController& segments) {
  bench.commands.add(
      {.id = "segment.export_masks",
       .menu = Menu::Export,
       .text = SegmentText::tr("Masks of labels…"),
       .tip = SegmentText::tr(
           "Writes a black and white PNG of every label in every segmented view to a folder"),
       .icon = "export",
       .run = [bench, &segments] { ask_to_export_masks(bench, segments); },
       .section = section::kLabels,
       .enabled = [&segments] { return segments.hasSegmentation(); }});
}

void add_smoothing(Commands& commands, SegmentController& segments) {
  constexpr double kStep_px = 0.5;
  commands.add(
      {.menu = Menu::Segmentation, .section = kSegmentSection},
      {{.id = "segment.smoother",
        .text = SegmentText::tr("Smoother boundaries"),
        .tip = SegmentText::tr(
            "Smooths the boundaries of all labels by half a pixel more; can be undone"),
        .keys = {SegmentText::tr("Shift+S")},
        .run = [&segments] { segments.smoothBoundaries(segments.smoothing() + kStep_px); },
        .enabled = [&segments] { return segments.labeler().has_input(); }},
       {.id = "segment.less_smooth",
        .text = SegmentText::tr("Less smooth boundaries"),
        .tip = SegmentText::tr("Smooths the boundaries of all labels by half a pixel less"),
        .run = [&segments] { segments.smoothBoundaries(segments.smoothing() - kStep_px); },
        .enabled = [&segments] { return segments.smoothing() > 0; }}});
}

void add_overlays(const Workbench& bench, SegmentPanel& panel) {
  struct Row {
    const char* id;
    Quantity quantity;
    QList<QKeySequence> keys{};
  };
  for (const Row& row :
       std::initializer_list<Row>{{"segment.show", Quantity::Segmentation, {Qt::Key_S}},
                                  {"segment.probability", Quantity::Probability, {Qt::Key_P}},
                                  {"segment.uncertainty", Quantity::Uncertainty},
                                  {"segment.edges", Quantity::Edges},
                                  {"segment.wrong", Quantity::WrongLabels}}) {
    Overlay& overlay = bench.overlay;
    Command command = map_command(overlay, row.quantity, row.id);
    command.keys = row.keys;
    command.run = [&overlay, quantity = row.quantity] {
      overlay.setQuantity(overlay.quantity() == quantity ? Quantity::View : quantity);
    };
    panel.addOverlay(bench.commands.add(command));
  }
}

}  // namespace

void add_segment_commands(const Workbench& bench, SegmentController& segments,
                          SegmentPanel& panel) {
  add_runs(bench.commands, segments);
  add_export(bench, segments);
  add_smoothing(bench.commands, segments);
  add_overlays(bench, panel);
  for (const char* id : {"segment.live", "segment.update", "segment.all"}) {
    panel.addAction(bench.commands.find(id));
  }
}

}  // namespace episcope
