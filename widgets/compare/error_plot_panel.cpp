// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/compare/error_plot_panel.h"

#include "widgets/controls/elided_label.h"
#include "widgets/plot/line_plot.h"
#include "widgets/style/theme.h"

#include <QVBoxLayout>

namespace episcope {

ErrorPlotPanel::ErrorPlotPanel(QWidget* parent)
    : QWidget(parent),
      title_(new ElidedLabel(this)),
      squares_(new LinePlot(this)),
      bad_(new LinePlot(this)) {
  setObjectName("errorPlotPanel");
  title_->setObjectName("errors.title");
  squares_->setObjectName("errors.squares");
  squares_->setAccessibleName(tr("Mean squared error by true disparity"));
  bad_->setObjectName("errors.bad");
  bad_->setAccessibleName(tr("Bad pixels by true disparity"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(title_);
  layout->addWidget(squares_, 1);
  layout->addWidget(bad_, 1);
}

void ErrorPlotPanel::setPlots(const QString& title, const Plot& squares, const Plot& bad) {
  title_->setFullText(title);
  squares_->setPlot(squares);
  bad_->setPlot(bad);
}

void ErrorPlotPanel::clear(const QString& why) {
  title_->setFullText({});
  for (LinePlot* plot : {squares_, bad_}) {
    plot->setPlot({});
    plot->setEmptyText(why);
  }
}

}  // namespace episcope

#include "moc_error_plot_panel.cpp"
