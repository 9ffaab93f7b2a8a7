// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/features.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/annotation_files.h"
#include "app/gui/annotate/label_controller.h"
#include "app/gui/annotate/label_exchange.h"
#include "app/gui/annotate/label_review.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/annotate/segment_commands.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/browse/browse_controller.h"
#include "app/gui/browse/cloud_controller.h"
#include "app/gui/browse/focus_controller.h"
#include "app/gui/browse/info_controller.h"
#include "app/gui/browse/measure_controller.h"
#include "app/gui/browse/value_controller.h"
#include "app/gui/capture/capture_controller.h"
#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/metric_controller.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/compare/region_controller.h"
#include "app/gui/compare/statistics_controller.h"
#include "app/gui/estimate/estimate_controller.h"
#include "app/gui/files/autosave.h"
#include "app/gui/files/collection_controller.h"
#include "app/gui/files/file_controller.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/shell/appearance.h"
#include "app/gui/shell/command_palette.h"
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
  new LabelLookController(bench, palette);
  new ScribbleController(bench, bar);
  new AnnotationFiles(bench, bar);
  new LabelImporter(bench, bar);
  new RecoveryController(bench);
}

// Browsing views and EPIs, the focus plane, pixel values, and facts about the light field.
void add_browsing(const Workbench& bench) {
  new BrowseController(bench);
  new FocusController(bench);
  new InfoController(bench);
  new ToneController(bench);
  new ValueController(bench);
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

void add_commands(const Workbench& bench, CloudController* cloud) {
  bench.commands.add(
      {.menu = Menu::Panes},
      {{.id = "cloud.large",
        .text = CloudController::tr("3D in place of the view"),
        .tip = CloudController::tr(
            "Shows the 3D view in place of the current view, or moves it back into its tab"),
        .icon = "cube",
        .keys = {Qt::Key_F4},
        .run = [cloud] { cloud->setLarge(!cloud->isLarge()); },
        .checked = [cloud] { return cloud->isLarge(); }},
       {.id = "cloud.window",
        .text = CloudController::tr("3D in its own window"),
        .tip = CloudController::tr(
            "Detaches the 3D view and its controls into their own window, or docks them again"),
        .icon = "sides",
        .keys = {CloudController::tr("Shift+F4")},
        .run =
            [&frame = bench.frame, cloud] {
              cloud->setLarge(false);
              frame.showTab("cloud");
              frame.panes().toggle("tab.cloud");
            },
        .checked = [&frame = bench.frame] { return frame.panes().isTorn("tab.cloud"); }}});
  bench.commands.add({.id = "cloud.export",
                      .menu = Menu::Export,
                      .text = CloudController::tr("3D view…"),
                      .tip = CloudController::tr("Writes the points or surfaces that the 3D view "
                                                 "shows, in their colors, as PLY"),
                      .icon = "export",
                      .keys = {CloudController::tr("Ctrl+Alt+E")},
                      .run = [cloud] { cloud->askToExport(); },
                      .section = section::kPictures,
                      .enabled = [cloud] { return cloud->hasScene(); }});
}

// The 3D view.
void add_cloud(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  bench.frame.addTab({.id = "cloud",
                      .title = CloudController::tr("3D"),
                      .command_text = CloudController::tr("3D tab"),
                      .command_tip = CloudController::tr("Shows the result in 3D, as points or as "
                                                         "a surface"),
                      .icon = "cube",
                      .widget = tab});
  add_commands(bench, new CloudController(bench, tab));
}

// Light fields of a folder, and frames of a sequence.
void add_collection(const Workbench& bench) {
  new CollectionController(bench);
  new FrameController(bench);
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
  new MetricController(bench, metrics, *part);
  new ErrorPlotController(bench, *part);
  add_picture_export(bench);
  new MovieExport(bench);
}

constexpr int kIconSize = 64;

struct HelpText {
  Q_DECLARE_TR_FUNCTIONS(episcope::Help)
};

void show_shortcuts(Commands& commands, QWidget& window) {
  auto* shortcuts = window.findChild<ShortcutWindow*>();
  if (!shortcuts) shortcuts = new ShortcutWindow(commands, &window);
  shortcuts->show();
  shortcuts->raise();
}

void show_about(QWidget& window) {
  auto* box =
      named("about",
            new QMessageBox(
                QMessageBox::NoIcon, HelpText::tr("About Episcope"),
                HelpText::tr(
                    "<b>Episcope %1</b><p>Views, EPIs, disparity and labels of 4D light fields.</p>"
                    "<p>BSD 3-Clause license.</p>")
                    .arg(kVersion),
                QMessageBox::Close, &window));
  box->setIconPixmap(program_icon().pixmap(kIconSize));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

// The list of keys, the command palette, colors, language and About.
void add_help(const Workbench& bench) {
  Commands& commands = bench.commands;
  QWidget& window = bench.window;
  auto* palette = new CommandPalette(commands, &window);
  add_theme_commands(commands);
  add_language_commands(commands, bench.messages);
  auto* manual = new ManualWindow(&window);
  commands.add({.menu = Menu::Help},
               {{.id = "help.manual",
                 .text = HelpText::tr("Manual"),
                 .tip = HelpText::tr("Opens the pages of the manual"),
                 .icon = "info",
                 .run = [manual] { manual->open("index.md"); }},
                {.id = "help.keys",
                 .text = HelpText::tr("Keys and mouse"),
                 .tip = HelpText::tr("Lists every key and mouse gesture"),
                 .icon = "help",
                 .keys = {Qt::Key_F1, Qt::Key_Question},
                 .run = [&commands, &window] { show_shortcuts(commands, window); },
                 .bar = BarSection::Help},
                {.id = "help.palette",
                 .text = HelpText::tr("Find a command…"),
                 .tip = HelpText::tr(
                     "Finds commands, methods, open and recent light fields by words of their "
                     "names and descriptions"),
                 .keys = {HelpText::tr("Ctrl+Shift+P")},
                 .run = [palette] { palette->popUp(); }},
                {.id = "help.about",
                 .text = HelpText::tr("About Episcope"),
                 .tip = HelpText::tr("Shows version and license"),
                 .icon = "info",
                 .run = [&window] { show_about(window); }}});
}

// The list of open light fields, projects, autosave and recovery.
void add_project(const Workbench& bench) {
  auto* autosave = new Autosave(bench);
  auto* project = new ProjectController(bench, *autosave);
  new ProjectGuard(bench, *project);
  new SessionRecovery(bench, *autosave);
  new SceneChooser(bench);
  new WindowTitle(bench, *autosave, *project);
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
  new StripController(bench, panel);
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
