// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/tone_controller.h"

#include "app/gui/frame/commands.h"
#include "app/gui/frame/messages.h"
#include "app/session/session.h"
#include "engine/render/tone.h"
#include "widgets/browse/tone_panel.h"

#include <QDialog>
#include <QVBoxLayout>

namespace episcope {

ToneController::ToneController(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      dialog_(new QDialog(&bench.window)),
      panel_(new TonePanel(dialog_)),
      job_(this) {
  dialog_->setObjectName("tone");
  dialog_->setWindowTitle(tr("Brightness"));
  auto* layout = new QVBoxLayout(dialog_);
  layout->addWidget(panel_);
  layout->setSizeConstraint(QLayout::SetFixedSize);
  addCommands();
  connect(panel_, &TonePanel::toneEdited, this,
          [this](const render::Tone& tone) { bench_.session.set_tone(tone); });
  connect(panel_, &TonePanel::automaticRequested, this, &ToneController::brighten);
  bench.session.on_changed([this](Parts parts) { update(parts); });
}

void ToneController::addCommands() {
  const auto has_scene = [this] { return bench_.session.scene() != nullptr; };
  bench_.commands.add({.id = "view.tone",
                       .menu = Menu::View,
                       .text = tr("Brightness…"),
                       .tip = tr("Exposure, gamma and black point of the views, for display only"),
                       .keys = {tr("Shift+B")},
                       .run = [this] { dialog_->show(); },
                       .section = section::kZoom,
                       .enabled = has_scene});
  bench_.commands.add({.id = "view.auto_tone",
                       .menu = Menu::View,
                       .text = tr("Automatic brightness"),
                       .tip = tr("Brightens dark views; again shows them as they are"),
                       .keys = {tr("Shift+A")},
                       .run =
                           [this] {
                             if (bench_.session.place().tone.is_plain()) {
                               brighten();
                             } else {
                               bench_.session.set_tone({});
                             }
                           },
                       .section = section::kZoom,
                       .enabled = has_scene,
                       .checked = [this] { return !bench_.session.place().tone.is_plain(); }});
}

void ToneController::update(Parts parts) {
  if (parts.has(Part::Tone)) panel_->setTone(bench_.session.place().tone);
  if (parts.has(Part::Scene)) look();
}

void ToneController::brighten() {
  if (!bench_.session.scene()) return;
  job_.start<render::Tone>(
      [light_field = bench_.session.light_field(), view = bench_.session.view()](const Progress&) {
        return render::automatic_tone(*light_field, view);
      },
      [this, scene = bench_.session.generation()](const render::Tone& tone) {
        if (scene == bench_.session.generation()) bench_.session.set_tone(tone);
      });
}

void ToneController::look() {
  job_.drop();
  if (!bench_.session.scene() || !bench_.session.place().tone.is_plain()) return;
  job_.start<bool>(
      [light_field = bench_.session.light_field()](const Progress&) {
        return render::is_dark(*light_field, light_field->center());
      },
      [this](bool is_dark) {
        if (!is_dark) return;
        bench_.messages.offer(tr("The views are dark."), tr("Brighten"), [this] { brighten(); });
      });
}

}  // namespace episcope

#include "moc_tone_controller.cpp"
