// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/result_export.h"

#include "app/gui/scene/scene_switcher.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/session/result_files.h"
#include "app/session/session.h"
#include "engine/io/models/external_result.h"

#include <QCoreApplication>
#include <QFileInfo>

#include <filesystem>
#include <functional>
#include <memory>

namespace episcope {
namespace {

struct ResultExportText {
  Q_DECLARE_TR_FUNCTIONS(episcope::ResultExport)
};

using Write = std::function<void(const Progress&)>;

/// What writes an entry in a form; null, and the user is told, if there is no such map.
Write writer_of(const Workbench& bench, const EstimateEntry& entry,
                const std::filesystem::path& file) {
  const EstimatePtr result = entry.estimate;
  const auto form = map_form_of(file);
  if (form == MapForm::Result) {
    return [file, result, input = bench.session.input()](const Progress& progress) {
      save_result(file, *result, input, progress);
    };
  }
  const ViewIndex view = bench.session.view();
  if (!result->contains(view)) {
    bench.messages.hint(
        ResultExportText::tr("%1 has no map of this view: go to the center view (Home) first.")
            .arg(QString::fromStdString(entry.name)));
    return nullptr;
  }
  return [file, result, view, light_field = bench.session.light_field(),
          is_cloud = form == MapForm::PointCloud](const Progress&) {
    is_cloud ? save_point_cloud(file, *light_field, view, result->field.view(view))
             : save_map(file, *result, view);
  };
}

void write_result(const Workbench& bench, const EstimateEntry& entry, const QString& path) {
  const std::filesystem::path file = path.toStdString();
  const Write write = writer_of(bench, entry, file);
  if (!write) return;
  const auto stamp = std::make_shared<FileStamp>();
  write_in_background(
      bench.jobs, bench.messages, path,
      [write, file, stamp](const Progress& progress) {
        write(progress);
        *stamp = stamp_of(file);
      },
      [&session = bench.session, &files = bench.results.files(), file, stamp, id = entry.id] {
        files.note(file, *stamp);
        if (map_form_of(file) == MapForm::Result) session.mark_saved(id);
      });
}

}  // namespace

void ask_to_export(const Workbench& bench, const EstimateEntry& entry) {
  const std::string& scene = bench.session.light_field()->info().name;
  ask_where_to_save(
      bench,
      {.name = "export_result",
       .title = ResultExportText::tr("Export %1").arg(QString::fromStdString(entry.name)),
       .filter = ResultExportText::tr(
           "Result, all views (*.h5);;Map of this view (*.pfm);;Map of this view "
           "(*.tiff);;Point cloud of this view (*.ply)"),
       .proposal = QString::fromStdString(scene + "_" + entry.estimate->method + ".h5")},
      [bench, id = entry.id](const QString& path) {
        if (const auto* found = bench.session.find_estimate(id)) export_result(bench, *found, path);
      });
}

void export_result(const Workbench& bench, const EstimateEntry& entry, const QString& path) {
  if (!has_suffix(path, {"h5", "pfm", "tiff", "ply"}, bench.messages)) return;
  if (!bench.results.files().has_changed(path.toStdString())) {
    write_result(bench, entry, path);
    return;
  }
  const auto with_entry = [bench, id = entry.id](auto act) {
    return [bench, id, act] {
      if (const auto* found = bench.session.find_estimate(id)) act(bench, *found);
    };
  };
  ChangedFileAnswers answers{
      .overwrite = with_entry([path](const Workbench& of, const EstimateEntry& found) {
        write_result(of, found, path);
      }),
      .elsewhere = with_entry(ask_to_export),
      .reload = nullptr,
      .of_reloading = {}};
  if (is_result(path)) {
    answers.reload = [bench, path] { bench.results.open(path); };
    answers.of_reloading =
        ResultExportText::tr("Reloading adds the results in the file to the list.");
  }
  ask_about_changed_file(&bench.window, path, answers);
}

void ask_to_submit(const Workbench& bench, const EstimateEntry& entry) {
  ask_for_folder(&bench.window,
                 {.name = "export_submission",
                  .title = ResultExportText::tr("Folder of the submission for %1")
                               .arg(QString::fromStdString(entry.name)),
                  .makes_folder = true},
                 [bench, id = entry.id](const QString& path) {
                   const auto map = io::submitted_map_file(
                       path.toStdString(), bench.session.light_field()->info().name);
                   const QString name = QString::fromStdString(map.string());
                   confirm_replacing(&bench.window,
                                     QFileInfo::exists(name) ? QStringList(name) : QStringList(),
                                     [bench, id, path] {
                                       const auto* found = bench.session.find_estimate(id);
                                       if (found) submit_result(bench, *found, path);
                                     });
                 });
}

void submit_result(const Workbench& bench, const EstimateEntry& entry, const QString& folder) {
  const LightFieldPtr light_field = bench.session.light_field();
  const ViewIndex center = light_field->center();
  if (!entry.estimate->contains(center)) {
    bench.messages.hint(
        ResultExportText::tr("%1 has no map of the center view, which is submitted.")
            .arg(QString::fromStdString(entry.name)));
    return;
  }
  const std::string scene = light_field->info().name;
  const std::filesystem::path target = folder.toStdString();
  const auto map = io::submitted_map_file(target, scene);
  write_in_background(bench.jobs, bench.messages, QString::fromStdString(map.string()),
                      [target, scene, center, result = entry.estimate](const Progress&) {
                        io::write_submitted_scene(target, scene, result->field.view(center),
                                                  result->seconds);
                      });
}

}  // namespace episcope
