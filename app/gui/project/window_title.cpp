// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/project/window_title.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/gui/project/autosave.h"
#include "app/gui/project/project_controller.h"
#include "app/session/session.h"

#include <QStringList>
#include <QWidget>

namespace episcope {

WindowTitle::WindowTitle(const Workbench& bench, const Autosave& autosave,
                         const ProjectController& project)
    : QObject(&bench.owner), bench_(bench), autosave_(autosave), project_(project) {
  connect(&bench.document, &DocumentController::unsavedChanged, this, &WindowTitle::show);
  connect(&autosave, &Autosave::projectFileChanged, this, &WindowTitle::show);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes)) {
      show();
    } else if (parts.has_any(Part::Estimates | Part::Labels | Part::Capture)) {
      mark();
    }
  });
  bench.scenes.sweeps().on_changed([this] { mark(); });
  show();
}

void WindowTitle::show() {
  QStringList parts;
  if (const LightFieldPtr light_field = bench_.session.light_field()) {
    parts << QString::fromStdString(light_field->info().name);
  }
  if (const std::string file = autosave_.projectFile().filename().string(); !file.empty()) {
    parts << QString::fromStdString(file);
  }
  if (!parts.isEmpty()) parts.front() += "[*]";
  bench_.window.setWindowTitle((parts << QStringLiteral("Episcope")).join(QStringLiteral(" — ")));
  mark();
}

void WindowTitle::mark() {
  const bool has_file = !autosave_.projectFile().empty();
  const bool is_unsaved = has_file
                              ? project_.hasChanged() || !bench_.document.unsavedScenes().empty()
                              : bench_.document.hasUnsavedChanges();
  // The mark has a place where there is a name.
  bench_.window.setWindowModified(is_unsaved && bench_.window.windowTitle().contains("[*]"));
}

}  // namespace episcope

#include "moc_window_title.cpp"
