// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_controller.h"
#include "app/gui/annotate/label_exchange.h"
#include "app/gui/annotate/label_review.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/browse/info_controller.h"
#include "app/gui/browse/measure_controller.h"
#include "app/gui/capture/capture_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/compare/region_controller.h"
#include "app/gui/compare/statistics_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/file_controller.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/manual_window.h"
#include "app/gui/shell/panes.h"
#include "engine/core/version.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/tool_button.h"
#include "widgets/panels/brush_panel.h"
#include "widgets/panels/label_palette.h"
#include "widgets/panels/label_review_panel.h"
#include "widgets/panels/metric_table.h"
#include "widgets/panels/overlay_bar.h"
#include "widgets/panels/statistics_panel.h"

#include <QAbstractItemView>
#include <QCoreApplication>
#include <QMessageBox>
#include <QVBoxLayout>
#include <QWidget>

namespace episcope {
namespace {

template <class Controller>
void add(const Workbench& bench) {
  new Controller(bench);
}

// Painting labels on views: tools, labels, scribbles, their files, and recovery after a crash.
void add_annotating(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  auto* brush = new BrushPanel(tab);
  auto* palette = new LabelPalette(tab);
  auto* bar = new AnnotationBar(tab);
  auto* room = new QVBoxLayout;
  make_column(tab, {brush, {palette, 1}, room, bar});
  bench.frame.addTab({.id = "annotate",
                      .title = AnnotateController::tr("Annotate"),
                      .page = AnnotateController::tr("Paint"),
                      .command_text = AnnotateController::tr("Annotate tab"),
                      .command_tip = AnnotateController::tr("Shows the labels and painting tools"),
                      .widget = tab,
                      .room = room});
  new AnnotateController(bench, brush);
  new LabelController(bench, palette);
  add_label_look(bench, palette);
  new ScribbleController(bench, bar);
  new AnnotationFiles(bench, bar);
  new LabelImporter(bench, bar);
  add_recovery(bench);
}

// Browsing views and EPIs, the focus plane, pixel values, and facts about the light field.
void add_browsing(const Workbench& bench) {
  add_views(bench);
  add_focus(bench);
  new InfoController(bench);
  add_values(bench);
}

void add_capture(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "capture",
                      .title = CaptureController::tr("Capture"),
                      .task = "collection",
                      .command_text = CaptureController::tr("Capture tab"),
                      .command_tip = CaptureController::tr("Makes ground truth from a mesh"),
                      .widget = tab,
                      .waits = true});
  new CaptureController(bench, tab);
}

// Overlays, comparison of results, statistics, the table of metrics, pictures and movies.
void add_comparing(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  auto* bar = new CompareBar(tab);
  auto* statistics = new StatisticsPanel(tab);
  auto* region = new RegionBar(tab);
  auto* metrics = new MetricTable(tab);
  make_column(tab, {bar, statistics, region, {metrics, 1}});
  bench.frame.addTab({.id = "compare",
                      .title = CompareController::tr("Compare"),
                      .page = CompareController::tr("Table"),
                      .command_text = CompareController::tr("Compare tab"),
                      .command_tip = CompareController::tr("Shows the table of metrics"),
                      .widget = tab});
  bench.commands.hearHeldKeys(metrics->findChild<QAbstractItemView*>());
  new CompareController(bench, bar);
  new StatisticsController(bench, statistics);
  const auto* part = new RegionController(bench, region);
  add_metrics(bench, metrics, *part);
  add_error_plots(bench, *part);
  add_picture_export(bench);
  new MovieExport(bench);
}

// The Check tab and its commands.
void add_reviewing(const Workbench& bench) {
  auto* panel = new LabelReviewPanel(&bench.frame);
  bench.frame.addTab({.id = "check",
                      .title = LabelReviewController::tr("Check"),
                      .task = "annotate",
                      .command_text = LabelReviewController::tr("Check tab"),
                      .command_tip = LabelReviewController::tr(
                          "Shows where labels are in doubt, their islands and holes"),
                      .widget = panel});
  new LabelReviewController(bench, panel);
  add_label_strip(bench, panel);
}

// Segmenting from scribbles, live or all views, and showing the result.
void add_segmenting(const Workbench& bench) {
  auto* panel = new SegmentPanel(&bench.frame);
  bench.frame.addToTab("annotate", panel);
  auto* segment = new SegmentController(bench, panel);
  add_segment_commands(bench, *segment, *panel);
  auto* importer = bench.owner.findChild<LabelImporter*>();
  QObject::connect(importer, &LabelImporter::segmented, segment, &SegmentController::takeLabels);
  QObject::connect(bench.owner.findChild<AnnotateController*>(),
                   &AnnotateController::disparityWanted, segment,
                   &SegmentController::provideDisparity);
  add_label_export(bench, *segment);
  panel->addAction(bench.commands.find("segment.export"));
}

}  // namespace

std::span<const Feature> features() {
  static constexpr Feature kFeatures[] = {{"files", add<FileController>},
                                          {"project", add_project},
                                          {"browse", add_browsing},
                                          {"estimate", add<EstimateController>},
                                          {"compare", add_comparing},
                                          {"annotate", add_annotating},
                                          {"segment", add_segmenting},
                                          {"cloud", add_cloud},
                                          {"collection", add_collection},
                                          {"review", add_reviewing},
                                          {"capture", add_capture},
                                          {"measure", add<MeasureController>},
                                          {"help", add_help}};
  return kFeatures;
}

}  // namespace episcope
