// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment/segmentation_export.h"

#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/segment/segment_controller.h"
#include "app/session/labels/save_masks.h"
#include "app/session/labels/save_segmentation.h"
#include "app/session/picture/picture.h"
#include "engine/io/grid/image_file.h"

#include <QCoreApplication>
#include <QFileInfo>

#include <filesystem>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::SegmentationExport)
};

}  // namespace

void ask_to_export_segmentation(const Workbench& bench, const SegmentController& segment) {
  const auto segmentation = segment.segmentation();
  if (!segmentation) {
    bench.messages.hint(
        Text::tr("Nothing is segmented yet: paint two labels, then update the segmentation."));
    return;
  }
  const bool has_all = segmentation->labeling->labels.grid().count() > 1;
  ask_where_to_save(
      &bench.window,
      {.name = "export_segmentation",
       .title = Text::tr("Export the segmentation"),
       .filter = Text::tr("%1 (*.h5);;Labels of this view (*.png)")
                     .arg(has_all ? Text::tr("Labels and probabilities of all views")
                                  : Text::tr("Labels and probabilities of this view")),
       .proposal = QString::fromStdString(bench.session.light_field()->info().name) + "_labels.h5"},
      [bench, &segment](const QString& path) { export_segmentation(bench, segment, path); });
}

void export_segmentation(const Workbench& bench, const SegmentController& segment,
                         const QString& path) {
  const auto segmentation = segment.segmentation();
  if (!segmentation || !has_suffix(path, {"h5", "png"}, bench.messages)) return;
  const std::filesystem::path file = path.toStdString();
  if (QFileInfo(path).suffix().toLower() != "png") {
    write_in_background(
        bench.jobs, bench.messages, path,
        [file, segmentation, source = bench.session.input()](const Progress& progress) {
          write_segmentation(file, *segmentation, source, StoredProbabilities::All, progress);
        });
    return;
  }
  const auto source = segment.map_source(render::Quantity::Segmentation, bench.session.view());
  if (!source) return;
  write_in_background(bench.jobs, bench.messages, path, [file, source = *source](const Progress&) {
    io::write_png(file, map_picture(*make_map(source), {}).view());
  });
}

void ask_to_export_masks(const Workbench& bench, const SegmentController& segment) {
  const auto segmentation = segment.segmentation();
  if (!segmentation) return;
  const bool has_all = segmentation->labeling->labels.grid().count() > 1;
  ask_for_folder(
      &bench.window,
      {.name = "export_masks",
       .title = has_all ? Text::tr("Folder for the masks of all views")
                        : Text::tr("Folder for the masks of this view; segment all "
                                   "views first to have those of all")},
      [bench, &segment](const QString& folder) { export_masks(bench, segment, folder); });
}

void export_masks(const Workbench& bench, const SegmentController& segment, const QString& folder) {
  const auto segmentation = segment.segmentation();
  if (!segmentation) return;
  write_in_background(
      bench.jobs, bench.messages, folder,
      [path = std::filesystem::path(folder.toStdString()), segmentation](const Progress& progress) {
        write_label_masks(path, *segmentation, progress);
      });
}

}  // namespace episcope
