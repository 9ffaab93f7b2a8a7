// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare_actions.h"

#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/statistics_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/main_window.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"
#include "widgets/style/quantity_text.h"

#include <QAction>

namespace episcope {
namespace {

using render::Quantity;

QString tr(const char* source) {
  return MainWindow::tr(source);
}

void add_overlay_actions(ActionTable& table, MainWindow& window) {
  OverlayController& overlay = window.overlay();
  for (const auto& [id, quantity] : overlay_actions()) {
    table.add({.id = id,
               .menu = tr("Compare"),
               .text = quantity_button(quantity),
               .tip = quantity_tip(quantity),
               .icon = "",
               .keys = {},
               .run = [&overlay, quantity = quantity] { overlay.setQuantity(quantity); },
               .is_checkable = true});
  }
}

void add_mode(ActionTable& table, CompareController& compare, const Command& command,
              CompareMode mode) {
  Command made = command;
  made.menu = tr("Compare");
  made.run = [&compare, mode] { compare.toggleMode(mode); };
  made.is_checkable = true;
  table.add(made);
}

void add_mode_actions(ActionTable& table, MainWindow& window) {
  CompareController& compare = window.compare();
  add_mode(table, compare,
           {.id = "compare.wipe",
            .menu = {},
            .text = tr("Wipe"),
            .tip = tr("Shows A left and B right of a line that can be dragged"),
            .icon = "wipe",
            .keys = {Qt::Key_W},
            .run = {},
            .begins_group = true},
           CompareMode::Wipe);
  add_mode(table, compare,
           {.id = "compare.sides",
            .menu = {},
            .text = tr("Side by side"),
            .tip = tr("Shows A beside B"),
            .icon = "sides",
            .keys = {Qt::Key_H},
            .run = {}},
           CompareMode::Sides);
  add_mode(table, compare,
           {.id = "compare.tiles",
            .menu = {},
            .text = tr("Tiles"),
            .tip = tr("Shows the view, the truth and every result"),
            .icon = "tiles",
            .keys = {Qt::Key_G},
            .run = {}},
           CompareMode::Wall);
}

void add_choice_actions(ActionTable& table, MainWindow& window) {
  OverlayController& overlay = window.overlay();
  const QString menu = tr("Compare");
  table.add({.id = "compare.next_map",
             .menu = menu,
             .text = tr("Next map"),
             .tip = tr("Shows the next map over the view"),
             .icon = "",
             .keys = {Qt::Key_M},
             .run = [&overlay] { overlay.selectNextQuantity(); },
             .begins_group = true});
  table.add({.id = "compare.difference",
             .menu = menu,
             .text = tr("Difference A − B"),
             .tip = tr("Shows the shown result minus the compared one"),
             .icon = "difference",
             .keys = {Qt::Key_D},
             .run = [&window] { window.compare().toggleDifference(); },
             .is_checkable = true});
  table.add({.id = "compare.flip",
             .menu = menu,
             .text = tr("Flip to B"),
             .tip = tr("Shows B, the compared result, while the key is held in the view or a list"),
             .icon = "",
             .keys = {Qt::Key_Tab},
             .run = [&overlay] { overlay.setFlipped(!overlay.isFlipped()); },
             .scope = KeyScope::Held});
  table.add({.id = "compare.swap",
             .menu = menu,
             .text = tr("Swap A and B"),
             .tip = tr("Shows the compared result and compares with the one shown now"),
             .icon = "swap",
             .keys = {Qt::Key_QuoteLeft},
             .run = [&window] {
               if (const EstimateEntry* other = window.session().compared()) {
                 window.session().show_estimate(other->id);
               }
             }});
  table.add({.id = "compare.auto_range",
             .menu = menu,
             .text = tr("Automatic range"),
             .tip = tr("Stretches the colours over the values in sight"),
             .icon = "auto",
             .keys = {Qt::Key_A},
             .run = [&window] { window.statistics().useAutomaticRange(); },
             .begins_group = true});
  table.add({.id = "compare.own_range",
             .menu = menu,
             .text = tr("Own range"),
             .tip = tr("Back to the range that belongs to the quantity"),
             .icon = "reset",
             .keys = {Qt::Key_R},
             .run = [&overlay] { overlay.useOwnRange(); }});
}

}  // namespace

void add_compare_actions(ActionTable& table, MainWindow& window) {
  add_overlay_actions(table, window);
  add_choice_actions(table, window);
  add_mode_actions(table, window);
}

const std::vector<std::pair<QString, Quantity>>& overlay_actions() {
  static const auto actions = [] {
    std::vector<std::pair<QString, Quantity>> made;
    for (const render::QuantityInfo& info : render::quantities()) {
      const bool is_of_labels = info.subject == render::Subject::Segmentation;
      if (is_of_labels || info.quantity == Quantity::Difference) continue;  // elsewhere
      const QString id = info.quantity == Quantity::View ? QString("none") : QString(info.id);
      made.emplace_back("overlay." + id, info.quantity);
    }
    return made;
  }();
  return actions;
}

}  // namespace episcope
