// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/review/review.h"

#include "app/gui/frame/frame.h"
#include "app/gui/review/review_controller.h"
#include "app/gui/review/strip_controller.h"
#include "widgets/annotate/check_panel.h"

namespace episcope {

void add_reviewing(const Workbench& bench) {
  auto* panel = new CheckPanel(&bench.frame);
  bench.frame.addTab({.id = "check",
                      .title = ReviewController::tr("Check"),
                      .command_text = ReviewController::tr("Check tab"),
                      .command_tip = ReviewController::tr(
                          "Shows where labels are in doubt, their islands and holes"),
                      .widget = panel});
  new ReviewController(bench, panel);
  new StripController(bench, panel);
}

}  // namespace episcope
