// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/frame.h"

#include "widgets/annotate/annotation_bar.h"
#include "widgets/annotate/brush_panel.h"
#include "widgets/annotate/label_palette.h"
#include "widgets/annotate/segment_panel.h"
#include "widgets/browse/epi_pane.h"
#include "widgets/browse/info_panel.h"
#include "widgets/browse/value_bar.h"
#include "widgets/browse/view_grid.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/color_bar.h"
#include "widgets/compare/compare_bar.h"
#include "widgets/compare/metric_table.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/compare/statistics_panel.h"
#include "widgets/controls/fitting_splitter.h"
#include "widgets/controls/job_panel.h"
#include "widgets/controls/message_bar.h"
#include "widgets/estimate/method_panel.h"
#include "widgets/estimate/result_list.h"
#include "widgets/style/theme.h"

#include <QCoreApplication>
#include <QGridLayout>
#include <QSplitter>
#include <QTabWidget>
#include <QToolBar>
#include <QVBoxLayout>

namespace episcope {
namespace {

constexpr int kLeftWidth = 205;
constexpr int kRightWidth = 372;
constexpr int kCenterWidth = 720;
constexpr int kEpiWidth = 145;      // of the vertical EPI and the legend under it
constexpr int kLeastResults = 150;  // height of a list of five

QString text(const char* source) {
  return QCoreApplication::translate("episcope::MainWindow", source);
}

// The view with the vertical EPI beside it, the horizontal one under it, and the legend between.
QWidget* make_stage(Panels& panels, QWidget* parent) {
  auto* stage = new QWidget(parent);
  panels.canvas = new ViewCanvas(stage);
  panels.wall = new TileWall(stage);
  panels.wall->hide();
  panels.horizontal_epi = new EpiPane(Qt::Horizontal, stage);
  panels.vertical_epi = new EpiPane(Qt::Vertical, stage);
  panels.color_bar = new ColorBar(stage);
  // Its place is kept while nothing is drawn over the view, so that the view does not jump.
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  policy.setRetainSizeWhenHidden(true);
  panels.color_bar->setSizePolicy(policy);

  auto* legend = new QWidget(stage);
  auto* legend_layout = new QVBoxLayout(legend);
  legend_layout->setContentsMargins(theme::kSpacing, 0, theme::kSpacing, 0);
  legend_layout->addStretch(1);
  legend_layout->addWidget(panels.color_bar);
  legend_layout->addStretch(1);

  auto* layout = new QGridLayout(stage);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(panels.canvas, 0, 0);
  layout->addWidget(panels.wall, 0, 0, 1, 2);
  layout->addWidget(panels.vertical_epi, 0, 1);
  layout->addWidget(panels.horizontal_epi, 1, 0);
  layout->addWidget(legend, 1, 1);
  layout->setColumnMinimumWidth(1, kEpiWidth);
  layout->setColumnStretch(0, 12);
  layout->setColumnStretch(1, 1);
  layout->setRowStretch(0, 12);
  layout->setRowStretch(1, 1);
  return stage;
}

QWidget* make_left(Panels& panels, QWidget* parent) {
  auto* left = new QSplitter(Qt::Vertical, parent);
  panels.view_grid = new ViewGrid(left);
  panels.view_grid->setContentsMargins(theme::kSpacing, theme::kSpacing, theme::kSpacing, 0);
  panels.info = new InfoPanel(left);
  panels.info->setContentsMargins(theme::kSpacing, 0, theme::kSpacing, theme::kSpacing);
  left->addWidget(panels.view_grid);
  left->addWidget(panels.info);
  left->setStretchFactor(0, 0);
  left->setStretchFactor(1, 1);
  left->setChildrenCollapsible(false);
  return left;
}

QWidget* make_estimate_tab(Panels& panels, QWidget* parent) {
  auto* tab = new FittingSplitter(kLeastResults, parent);
  panels.method = new MethodPanel(tab);
  panels.results = new ResultList(tab);
  tab->addWidget(panels.method);
  tab->addWidget(panels.results);
  return tab;
}

QWidget* make_compare_tab(Panels& panels, QWidget* parent) {
  auto* tab = new QWidget(parent);
  panels.compare = new CompareBar(tab);
  panels.statistics = new StatisticsPanel(tab);
  panels.metrics = new MetricTable(tab);
  auto* layout = new QVBoxLayout(tab);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panels.compare);
  layout->addWidget(panels.statistics);
  layout->addWidget(panels.metrics, 1);
  return tab;
}

QWidget* make_annotate_tab(Panels& panels, QWidget* parent) {
  auto* tab = new QWidget(parent);
  panels.brush = new BrushPanel(tab);
  panels.labels = new LabelPalette(tab);
  panels.segment = new SegmentPanel(tab);
  panels.annotation = new AnnotationBar(tab);
  auto* layout = new QVBoxLayout(tab);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(panels.brush);
  layout->addWidget(panels.labels, 1);
  layout->addWidget(panels.segment);
  layout->addWidget(panels.annotation);
  return tab;
}

QWidget* make_right(Panels& panels, QWidget* parent) {
  auto* right = new QWidget(parent);
  panels.tabs = new QTabWidget(right);
  panels.tabs->setObjectName("tabs");
  panels.tabs->setDocumentMode(true);
  panels.tabs->addTab(make_estimate_tab(panels, panels.tabs), text("Estimate"));
  panels.tabs->addTab(make_compare_tab(panels, panels.tabs), text("Compare"));
  panels.annotate_tab = make_annotate_tab(panels, panels.tabs);
  panels.tabs->addTab(panels.annotate_tab, text("Annotate"));
  panels.cloud_tab = new QWidget(panels.tabs);
  panels.tabs->addTab(panels.cloud_tab, text("3D"));
  panels.jobs = new JobPanel(right);
  auto* layout = new QVBoxLayout(right);
  layout->setContentsMargins(0, 0, theme::kSpacing, 0);
  layout->addWidget(panels.tabs, 1);
  layout->addWidget(panels.jobs);
  return right;
}

}  // namespace

Panels make_panels(QWidget* window) {
  Panels panels;
  panels.tool_bar = new QToolBar(text("Main tool bar"), window);
  panels.tool_bar->setObjectName("tool_bar");
  panels.tool_bar->setMovable(false);
  panels.overlay_bar = new OverlayBar(window);
  panels.overlay_bar->setSelectorVisible(false);  // the tool bar has a button for each

  panels.viewer = new QWidget(window);
  panels.viewer->setObjectName("viewer");
  auto* browser = new QSplitter(Qt::Horizontal, panels.viewer);
  browser->addWidget(make_left(panels, browser));
  browser->addWidget(make_stage(panels, browser));
  browser->setStretchFactor(0, 0);  // what a larger window gives belongs to the view
  browser->setStretchFactor(1, 1);
  browser->setSizes({kLeftWidth, kCenterWidth});
  auto* viewer_layout = new QVBoxLayout(panels.viewer);
  viewer_layout->setContentsMargins(0, 0, 0, 0);
  viewer_layout->addWidget(browser);

  auto* split = new QSplitter(Qt::Horizontal, window);
  split->addWidget(panels.viewer);
  split->addWidget(make_right(panels, split));
  split->setStretchFactor(0, 1);
  split->setStretchFactor(1, 0);
  split->setSizes({kLeftWidth + kCenterWidth, kRightWidth});
  split->setChildrenCollapsible(false);

  panels.recovery = new MessageBar(window);
  panels.recovery->setObjectName("recoveryBar");
  panels.messages = new MessageBar(window);
  panels.values = new ValueBar(window);
  auto* layout = new QVBoxLayout(window);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(split, 1);
  layout->addWidget(panels.recovery);
  layout->addWidget(panels.messages);
  layout->addWidget(panels.values);
  return panels;
}

}  // namespace episcope
