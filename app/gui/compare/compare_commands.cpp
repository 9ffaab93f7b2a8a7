// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare_controller.h"
#include "app/gui/compare/compare_section.h"
#include "app/gui/frame/commands.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/compare_bar.h"
#include "widgets/style/quantity_text.h"

#include <QAction>
#include <QActionGroup>

namespace episcope {

using render::Quantity;
using render::QuantityInfo;

void CompareController::addOverlayCommands() {
  for (const QuantityInfo& info : render::quantities()) {
    const bool is_of_labels = info.subject == render::Subject::Segmentation;
    if (is_of_labels || info.quantity == Quantity::Difference) continue;  // elsewhere
    const Quantity quantity = info.quantity;
    bench_.commands.add(
        {.id = "overlay." + (quantity == Quantity::View ? QString("none") : QString(info.id)),
         .menu = Menu::Compare,
         .text = quantity_button(quantity),
         .tip = quantity_tip(quantity),
         .run = [this, quantity] { overlay_.setQuantity(quantity); },
         .section = compare_section::kMaps,
         .bar = info.has_button ? BarSection::Maps : BarSection::None,
         .enabled = [this, quantity] { return overlay_.isAvailable(quantity); },
         .checked = [this, quantity] { return overlay_.quantity() == quantity; }});
  }
}

void CompareController::addChoiceCommands() {
  bench_.commands.add({.id = "compare.next_map",
                       .menu = Menu::Compare,
                       .text = tr("Next map"),
                       .tip = tr("Shows the next map over the view"),
                       .keys = {Qt::Key_M},
                       .run = [this] { overlay_.selectNextQuantity(); },
                       .section = compare_section::kChoice});
  bench_.commands.add(
      {.id = "compare.flip",
       .menu = Menu::Compare,
       .text = tr("Flip to B"),
       .tip = tr("Shows B, the compared result, while the key is held in the view or a list"),
       .keys = {Qt::Key_Tab},
       .run = [this] { overlay_.setFlipped(!overlay_.isFlipped()); },
       .section = compare_section::kChoice,
       .scope = KeyScope::Held,
       .enabled = [this] { return session_.side_a() != nullptr; },
       .hold =
           [this](bool is_held) {
             if (mode_ == CompareMode::Single || !is_held) overlay_.setFlipped(is_held);
           }});
  bench_.commands.hearHeldKeys(canvas_);
}

void CompareController::addPairCommands() {
  bench_.commands.add(
      {.id = "compare.difference",
       .menu = Menu::Compare,
       .text = tr("Difference A − B"),
       .tip = tr("Shows A minus B, the result shown minus the one it is compared with"),
       .icon = "difference",
       .keys = {Qt::Key_D},
       .run = [this] { toggleDifference(); },
       .section = compare_section::kChoice,
       .bar = BarSection::Compare,
       .enabled = [this] { return session_.side_b() != nullptr; },
       .checked = [this] { return overlay_.showsDifference(); }});
  bench_.commands.add(
      {.id = "compare.swap",
       .menu = Menu::Compare,
       .text = tr("Swap A and B"),
       .tip = tr("Shows B and compares it with A"),
       .icon = "swap",
       .keys = {Qt::Key_QuoteLeft},
       .run = [this] { session_.show_estimate(session_.compared()->id); },
       .section = compare_section::kChoice,
       .enabled = [this] { return !session_.live() && session_.compared() != nullptr; }});
}

void CompareController::addModeCommands() {
  struct Row {
    CompareMode mode;
    QString id;
    QString text;
    QString tip;
    Qt::Key key;
    BarSection bar = BarSection::None;
  };
  for (const Row& row : std::initializer_list<Row>{
           {CompareMode::Wipe, "wipe", tr("Wipe"),
            tr("Shows A to the left and B to the right of a divider that can be dragged"),
            Qt::Key_W},
           {CompareMode::Sides, "sides", tr("Side by side"), tr("Shows A beside B"), Qt::Key_H},
           {CompareMode::Wall, "tiles", tr("Tiles"),
            tr("Shows the view, the ground truth and every result"), Qt::Key_G,
            BarSection::Compare}}) {
    bench_.commands.add({.id = "compare." + row.id,
                         .menu = Menu::Compare,
                         .text = row.text,
                         .tip = row.tip,
                         .icon = row.id,
                         .keys = {row.key},
                         .run = [this, mode = row.mode] { toggleMode(mode); },
                         .section = compare_section::kModes,
                         .bar = row.bar,
                         .enabled = [this, mode = row.mode] { return isAvailable(mode); },
                         .checked = [this, mode = row.mode] { return mode_ == mode; }});
  }
}

void CompareController::addCommands() {
  addOverlayCommands();
  addModeCommands();
  addChoiceCommands();
  addPairCommands();
  for (const char* id :
       {"compare.wipe", "compare.sides", "compare.tiles", "compare.difference", "compare.swap"}) {
    bar_->addAction(bench_.commands.find(id), QString("button.%1").arg(id));
  }
  connect(&overlay_, &Overlay::choiceChanged, &bench_.commands, &Commands::refresh);
}

}  // namespace episcope
