// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/scene_chooser.h"

#include "app/gui/files/autosave.h"
#include "app/gui/files/project_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/session/session.h"

#include <QComboBox>
#include <QSignalBlocker>
#include <QStringList>
#include <QWidget>

namespace episcope {
namespace {

// "edge · 3 results".
QString text_of(const OpenScene& scene) {
  const QString name = QString::fromStdString(scene.name);
  const auto count = scene.estimates.size();
  if (count == 0) return name;
  return count == 1 ? SceneChooser::tr("%1 · 1 result").arg(name)
                    : SceneChooser::tr("%1 · %2 results").arg(name).arg(count);
}

}  // namespace

SceneChooser::SceneChooser(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), list_(new QComboBox(&bench.frame)) {
  list_->setObjectName("scenes.open");
  list_->setAccessibleName(tr("Open light fields"));
  list_->setToolTip(tr("Open light fields: choose the one to show"));
  list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  list_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  bench.frame.addToColumn(list_, false);
  connect(list_, &QComboBox::activated, this, [this](int row) {
    bench_.scenes.show(list_->itemData(row).toULongLong());
    fill();  // until it is read, the one before is shown
  });
  addCommands();
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &SceneChooser::fill);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Scene | Part::Scenes | Part::Estimates)) fill();
  });
  fill();
}

void SceneChooser::addCommands() {
  const auto has_several = [this] { return bench_.session.scenes().size() > 1; };
  bench_.commands.add({.id = "scenes.next",
                       .menu = Menu::View,
                       .text = tr("Next open light field"),
                       .tip = tr("Shows the next open light field"),
                       .keys = {tr("Ctrl+Alt+PgDown")},
                       .run = [this] { bench_.scenes.step(1); },
                       .section = section::kTabs,
                       .enabled = has_several});
  bench_.commands.add({.id = "scenes.previous",
                       .menu = Menu::View,
                       .text = tr("Previous open light field"),
                       .tip = tr("Shows the previous open light field"),
                       .keys = {tr("Ctrl+Alt+PgUp")},
                       .run = [this] { bench_.scenes.step(-1); },
                       .section = section::kTabs,
                       .enabled = has_several});
}

void SceneChooser::fill() {
  const QSignalBlocker blocker(list_);
  list_->clear();
  for (const OpenScene* scene : bench_.session.scenes()) {
    list_->addItem(text_of(*scene), QVariant::fromValue<qulonglong>(scene->id));
    list_->setItemData(list_->count() - 1, QString::fromStdString(scene->input), Qt::ToolTipRole);
  }
  list_->setCurrentIndex(
      list_->findData(QVariant::fromValue<qulonglong>(bench_.session.generation())));
  const bool is_empty = list_->count() == 0;
  list_->setEnabled(!is_empty);
  list_->setPlaceholderText(!is_empty                           ? tr("none of these is shown")
                            : bench_.viewer_area.isPreviewing() ? tr("opening …")
                                                                : tr("nothing is open"));
}

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

#include "moc_scene_chooser.cpp"
