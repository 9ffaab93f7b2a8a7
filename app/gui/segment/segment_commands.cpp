// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment_actions.h"

#include "app/gui/compare/picture_export.h"
#include "app/gui/frame/commands.h"
#include "app/gui/main_window.h"
#include "app/gui/segment/segment_controller.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"
#include "widgets/annotate/segment_panel.h"
#include "widgets/style/quantity_text.h"

#include <QAction>

namespace episcope {
namespace {

using render::Quantity;

QString tr(const char* source) {
  return MainWindow::tr(source);
}

QString segment_menu() {
  return tr("Annotate › Segmentation");
}

void add_runs(ActionTable& table, MainWindow& window) {
  SegmentController& segment = window.segment();
  const QString menu = segment_menu();
  QAction* live = table.add({.id = "segment.live",
                             .menu = menu,
                             .text = tr("Live"),
                             .tip = tr("Segments the view again after every stroke"),
                             .icon = "live",
                             .keys = {Qt::Key_L},
                             .run = {},
                             .is_checkable = true});
  QObject::connect(live, &QAction::toggled, &segment, &SegmentController::setLive);
  table.add({.id = "segment.update",
             .menu = menu,
             .text = tr("Update now"),
             .tip = tr("Segments this view from what is painted"),
             .icon = "run",
             .keys = {Qt::Key_U},
             .run = [&segment] { segment.updateNow(); }});
  table.add({.id = "segment.all",
             .menu = menu,
             .text = tr("Segment all views"),
             .tip = tr("Segments every view so that labels agree along the rays"),
             .icon = "tiles",
             .keys = {tr("Shift+U")},
             .run = [&segment] { segment.segmentAllViews(); }});
  table.add(
      {.id = "segment.export",
       .menu = menu,
       .text = tr("Export segmentation…"),
       .tip = tr("Writes labels and probabilities as HDF5, or the labels of this view as PNG"),
       .icon = "export",
       .keys = {},
       .run = [&window] { window.exporter().exportSegmentationDialog(); }});
}

QList<QKeySequence> overlay_keys(Quantity quantity) {
  if (quantity == Quantity::Segmentation) return {Qt::Key_S};
  return quantity == Quantity::Probability ? QList<QKeySequence>{Qt::Key_P} : QList<QKeySequence>();
}

void add_overlays(ActionTable& table, MainWindow& window) {
  OverlayController& overlay = window.overlay();
  for (const auto& [id, quantity] : segment_overlay_actions()) {
    table.add({.id = id,
               .menu = segment_menu(),
               .text = quantity_button(quantity),
               .tip = quantity_tip(quantity),
               .icon = "",
               .keys = overlay_keys(quantity),
               .run =
                   [&overlay, quantity = quantity] {
                     const bool is_shown = overlay.quantity() == quantity;
                     overlay.setQuantity(is_shown ? Quantity::View : quantity);
                   },
               .is_checkable = true,
               .begins_group = quantity == Quantity::Segmentation});
  }
}

void show_state(ActionTable& table, MainWindow& window) {
  const bool has_input = window.segment().labeler().has_input();
  for (const char* id : {"segment.live", "segment.update", "segment.all"}) {
    table.find(id)->setEnabled(has_input);
  }
  const SegmentationPtr& segmentation = window.session().segmentation();
  table.find("segment.export")->setEnabled(segmentation && segmentation->labeling);
  table.find("segment.live")->setChecked(window.segment().isLive());
}

}  // namespace

void add_segment_actions(ActionTable& table, MainWindow& window) {
  add_runs(table, window);
  add_overlays(table, window);
}

const std::vector<std::pair<QString, Quantity>>& segment_overlay_actions() {
  static const std::vector<std::pair<QString, Quantity>> actions = {
      {"segment.show", Quantity::Segmentation},
      {"segment.probability", Quantity::Probability},
      {"segment.uncertainty", Quantity::Uncertainty},
      {"segment.edges", Quantity::Edges},
      {"segment.wrong", Quantity::WrongLabels}};
  return actions;
}

void follow_segmentation(ActionTable& table, MainWindow& window) {
  SegmentPanel* panel = window.panels().segment;
  for (const char* id : {"segment.live", "segment.update", "segment.all", "segment.export"}) {
    panel->addAction(table.find(id), QString("button.%1").arg(id));
  }
  for (const auto& [id, quantity] : segment_overlay_actions()) {
    panel->addOverlay(table.find(id), QString("button.%1").arg(id));
  }
  QObject::connect(&window.segment(), &SegmentController::changed, &table,
                   [&table, &window] { show_state(table, window); });
  show_state(table, window);
}

}  // namespace episcope
