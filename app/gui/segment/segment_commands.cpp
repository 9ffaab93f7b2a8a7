// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/commands.h"
#include "app/gui/segment/segment_controller.h"
#include "app/gui/segment/segmentation_export.h"
#include "app/gui/stage/overlay.h"
#include "widgets/style/quantity_text.h"

#include <QAction>

namespace episcope {
namespace {

using render::Quantity;

// Sections of the menu.
constexpr int kRun = 0;
constexpr int kMaps = 1;

}  // namespace

void SegmentController::addRunCommands() {
  const auto has_input = [this] { return live_.has_input(); };
  bench_.commands.add({.id = "segment.live",
                       .menu = Menu::Segmentation,
                       .text = tr("Live"),
                       .tip = tr("Segments the view again after every stroke"),
                       .icon = "live",
                       .keys = {Qt::Key_L},
                       .run = [this] { setLive(!is_live_); },
                       .section = kRun,
                       .enabled = has_input,
                       .checked = [this] { return is_live_; }});
  bench_.commands.add({.id = "segment.update",
                       .menu = Menu::Segmentation,
                       .text = tr("Update now"),
                       .tip = tr("Segments this view from the scribbles"),
                       .icon = "run",
                       .keys = {Qt::Key_U},
                       .run = [this] { updateNow(); },
                       .section = kRun,
                       .enabled = has_input});
  bench_.commands.add({.id = "segment.all",
                       .menu = Menu::Segmentation,
                       .text = tr("Segment all views"),
                       .tip = tr("Segments all views, with labels that agree along the rays"),
                       .icon = "tiles",
                       .keys = {tr("Shift+U")},
                       .run = [this] { segmentAllViews(); },
                       .section = kRun,
                       .enabled = has_input});
}

void SegmentController::addExportCommands() {
  bench_.commands.add(
      {.id = "segment.export",
       .menu = Menu::Segmentation,
       .text = tr("Export segmentation…"),
       .tip = tr("Writes labels and probabilities as HDF5, or the labels of this view as PNG"),
       .icon = "export",
       .run = [this] { ask_to_export_segmentation(bench_, *this); },
       .section = kRun,
       .enabled = [this] { return segmentation().has_value(); }});
  bench_.commands.add(
      {.id = "segment.export_masks",
       .menu = Menu::Segmentation,
       .text = tr("Export masks…"),
       .tip = tr("Writes a black and white PNG of every label in every segmented view to a folder"),
       .icon = "export",
       .run = [this] { ask_to_export_masks(bench_, *this); },
       .section = kRun,
       .enabled = [this] { return segmentation().has_value(); }});
}

void SegmentController::addSmoothingCommands() {
  constexpr double kStep_px = 0.5;
  bench_.commands.add(
      {.id = "segment.smoother",
       .menu = Menu::Segmentation,
       .text = tr("Smoother boundaries"),
       .tip = tr("Smooths the boundaries of all labels by half a pixel more; can be undone"),
       .keys = {tr("Shift+S")},
       .run = [this] { smoothBoundaries(smoothing() + kStep_px); },
       .section = kRun,
       .enabled = [this] { return live_.has_input(); }});
  bench_.commands.add({.id = "segment.less_smooth",
                       .menu = Menu::Segmentation,
                       .text = tr("Less smooth boundaries"),
                       .tip = tr("Smooths the boundaries of all labels by half a pixel less"),
                       .run = [this] { smoothBoundaries(smoothing() - kStep_px); },
                       .section = kRun,
                       .enabled = [this] { return smoothing() > 0; }});
}

void SegmentController::addOverlayCommands() {
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
    Overlay& overlay = bench_.overlay;
    const Quantity quantity = row.quantity;
    QAction* action = bench_.commands.add(
        {.id = row.id,
         .menu = Menu::Segmentation,
         .text = quantity_button(quantity),
         .tip = quantity_tip(quantity),
         .keys = row.keys,
         .run =
             [&overlay, quantity] {
               const bool is_shown = overlay.quantity() == quantity;
               overlay.setQuantity(is_shown ? Quantity::View : quantity);
             },
         .section = kMaps,
         .enabled = [&overlay, quantity] { return overlay.isAvailable(quantity); },
         .checked = [&overlay, quantity] { return overlay.quantity() == quantity; }});
    panel_->addOverlay(action, QString("button.%1").arg(row.id));
  }
}

void SegmentController::addCommands() {
  addRunCommands();
  addExportCommands();
  addSmoothingCommands();
  addOverlayCommands();
  for (const char* id : {"segment.live", "segment.update", "segment.all", "segment.export"}) {
    panel_->addAction(bench_.commands.find(id), QString("button.%1").arg(id));
  }
}

}  // namespace episcope
