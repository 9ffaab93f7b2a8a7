// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/project/window_title.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/project/autosave.h"
#include "app/session/session.h"

#include <QStringList>
#include <QWidget>

namespace episcope {

WindowTitle::WindowTitle(const Workbench& bench, const Autosave& autosave)
    : QObject(&bench.owner), bench_(bench), autosave_(autosave) {
  connect(&bench.document, &DocumentController::unsavedChanged, this, [this](bool is_unsaved) {
    show();
    bench_.window.setWindowModified(is_unsaved);
  });
  connect(&autosave, &Autosave::projectFileChanged, this, &WindowTitle::show);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) show();
  });
  show();
}

void WindowTitle::show() {
  QStringList parts;
  if (const LightFieldPtr light_field = bench_.session.light_field()) {
    parts << QString::fromStdString(light_field->info().name) + "[*]";
  }
  if (const std::string file = autosave_.projectFile().filename().string(); !file.empty()) {
    parts << QString::fromStdString(file);
  }
  bench_.window.setWindowTitle((parts << QStringLiteral("Episcope")).join(QStringLiteral(" — ")));
}

}  // namespace episcope

#include "moc_window_title.cpp"
