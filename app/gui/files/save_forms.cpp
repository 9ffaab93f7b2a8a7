// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/save_forms.h"

#include "annotation/document/exchange.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "app/session/session.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QMenu>

#include <filesystem>

namespace episcope {
namespace {

namespace fs = std::filesystem;

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::SaveForms)
};

/// What a user calls a form; its name in the engine if it has no other.
QString title_of(const io::Writer& writer) {
  const std::pair<const char*, QString> titles[] = {
      {"archive", Text::tr("Archive file (HDF5)")},
      {"benchmark", Text::tr("Folder of the 2016 benchmark")},
      {"grid", Text::tr("Folder of images")},
      {"npy", Text::tr("NumPy array")},
      {"npz", Text::tr("NumPy arrays with truth and labels")},
      {"mat", Text::tr("MATLAB file of the Light Field Toolbox")},
      {"eslf", Text::tr("Picture of lenslets (ESLF)")}};
  for (const auto& [id, title] : titles) {
    if (writer.id == std::string_view(id)) return title;
  }
  return QString::fromUtf8(writer.name);
}

/// Whether a file is the light field that is open, or lies in its folder already.
bool is_open_light_field(const fs::path& path, const fs::path& input) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  return fs::equivalent(path, input, ignored) ||
         (fs::is_directory(input, ignored) && fs::equivalent(path.parent_path(), input, ignored));
}

/// The scene with what is painted now in place of what was read.
Scene scene_to_save(const Workbench& bench) {
  Scene scene = *bench.session.scene();
  if (bench.document.document() == nullptr) return scene;
  bench.document.endStroke();
  scene.scribbles = scribbles_of(*bench.document.document());
  return scene;
}

QString joined_sentences(const QString& first, const std::vector<std::string>& others) {
  QString text = first;
  for (const std::string& sentence : others) text += ' ' + QString::fromStdString(sentence);
  return text;
}

}  // namespace

QMenu* make_save_menu(const Workbench& bench) {
  auto* menu = new QMenu(&bench.window);
  for (const io::Writer& writer : io::writers()) {
    QAction* action = menu->addAction(Text::tr("%1…").arg(title_of(writer)), &bench.owner,
                                      [bench, &writer] { ask_to_save_light_field(bench, writer); });
    action->setObjectName(QString("file.save_as.%1").arg(writer.id));
  }
  return menu;
}

void ask_to_save_light_field(const Workbench& bench, const io::Writer& writer) {
  const LightFieldPtr light_field = bench.session.light_field();
  if (!light_field) return;
  const QString name = QString::fromStdString(light_field->info().name);
  const QString suffix = writer.writes_folder() ? QString() : QString(writer.suffixes.front());
  ask_where_to_save(
      &bench.window,
      {.name = "save_light_field",
       .title = Text::tr("Save %1: %2").arg(name, title_of(writer)),
       .filter = writer.writes_folder() ? Text::tr("New folders (*)")
                                        : QString("%1 (*%2)").arg(title_of(writer), suffix),
       .proposal = name + '_' + writer.id + suffix},
      [bench, &writer](const QString& path) { save_light_field(bench, writer, path); });
}

void save_light_field(const Workbench& bench, const io::Writer& writer, const QString& path) {
  if (!bench.session.scene()) return;
  const fs::path file = path.toStdString();
  if (!writer.writes_folder() && !writer.has_suffix_of(file)) {
    bench.messages.warn(Text::tr("%1 was not written: its name must end in %2.")
                            .arg(QFileInfo(path).fileName(), writer.suffixes.front()));
    return;
  }
  if (is_open_light_field(file, bench.session.input())) {
    bench.messages.warn(Text::tr("%1 was not written: it belongs to the light field that is open; "
                                 "choose another name.")
                            .arg(QFileInfo(path).fileName()));
    return;
  }
  auto scene = std::make_shared<const Scene>(scene_to_save(bench));
  bench.jobs.start<std::vector<std::string>>(
      Lane::Export, Text::tr("Writing %1").arg(QFileInfo(path).fileName()),
      [scene, file, &writer](const Progress& progress) {
        writer.write(file, *scene, progress);
        return io::left_out(writer, *scene);
      },
      [&messages = bench.messages, path](const std::vector<std::string>& losses) {
        if (losses.empty()) return messages.written(path);
        messages.hint(joined_sentences(Text::tr("Written: %1.").arg(path), losses));
      });
}

}  // namespace episcope
