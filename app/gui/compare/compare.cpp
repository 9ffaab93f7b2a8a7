// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare.h"

#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/error_plot_controller.h"
#include "app/gui/compare/metric_controller.h"
#include "app/gui/compare/movie_export.h"
#include "app/gui/compare/picture_export.h"
#include "app/gui/compare/region_controller.h"
#include "app/gui/compare/statistics_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "widgets/compare/compare_bar.h"
#include "widgets/compare/metric_table.h"
#include "widgets/compare/region_bar.h"
#include "widgets/compare/statistics_panel.h"

#include <QAbstractItemView>
#include <QVBoxLayout>

namespace episcope {

void add_comparing(const Workbench& bench) {
  auto* tab = new QWidget(&bench.frame);
  auto* bar = new CompareBar(tab);
  auto* statistics = new StatisticsPanel(tab);
  auto* region = new RegionBar(tab);
  auto* metrics = new MetricTable(tab);
  auto* layout = new QVBoxLayout(tab);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(bar);
  layout->addWidget(statistics);
  layout->addWidget(region);
  layout->addWidget(metrics, 1);
  bench.frame.addTab({.id = "compare",
                      .title = CompareController::tr("Compare"),
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

}  // namespace episcope
