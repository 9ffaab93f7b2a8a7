// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/picture_export.h"

#include "app/session/labels/segmentation_file.h"
#include "app/session/picture/picture.h"
#include "app/session/save/save_result.h"
#include "engine/io/grid/image_file.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/picture.h"

#include <QFileDialog>
#include <QFileInfo>

namespace episcope {
namespace {

void write_picture(const std::filesystem::path& path, const RgbaImage& picture) {
  io::write_png(path, picture.view());
}

}  // namespace

ExportController::ExportController(Session& session, Jobs& jobs, const OverlayController& overlay,
                                   const Panels& panels, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs), overlay_(overlay), panels_(panels) {}

void ExportController::ask(const QString& title, const QString& name, const QString& filter,
                           const std::function<void(const QString&)>& write) {
  auto* dialog = new QFileDialog(panels_.viewer->window(), title, name, filter);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QFileInfo(name).suffix());
  dialog->selectFile(name);
  connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& chosen) {
    const QString suffix = chosen.section("*.", 1).section(')', 0, 0);
    const QString old_name = dialog->selectedFiles().value(0);
    dialog->setDefaultSuffix(suffix);
    dialog->selectFile(QFileInfo(old_name).completeBaseName() + '.' + suffix);
  });
  connect(dialog, &QFileDialog::fileSelected, this, write);
  dialog->open();
}

void ExportController::exportShownDialog() {
  if (const EstimateEntry* shown = session_.shown()) {
    exportResultDialog(shown->id);
  } else {
    emit hint(tr("There is no result yet: run a method first."));
  }
}

void ExportController::exportResultDialog(int estimate) {
  const EstimateEntry* entry = session_.find_estimate(estimate);
  if (!entry) return;
  const QString name = QString::fromStdString(session_.light_field()->info().name + "_" +
                                              entry->estimate->method + ".h5");
  ask(tr("Export %1").arg(QString::fromStdString(entry->name)), name,
      tr("Result, all views (*.h5);;Map of this view (*.pfm);;Map of this view (*.tiff);;Point "
         "cloud of this view (*.ply)"),
      [this, estimate](const QString& path) { exportResult(estimate, path); });
}

void ExportController::savePictureDialog() {
  if (!session_.scene()) {
    emit hint(tr("Nothing is open: there is no picture to save."));
    return;
  }
  ask(tr("Save the picture"), QString::fromStdString(session_.light_field()->info().name + ".png"),
      tr("PNG (*.png)"), [this](const QString& path) { savePicture(path); });
}

void ExportController::saveMapDialog() {
  const MapChoice choice = overlay_.choice();
  if (!drawnMap()) {
    emit hint(tr("No map is shown: choose one in the tool bar, then save it."));
    return;
  }
  const QString name = QString::fromStdString(session_.light_field()->info().name) + '_' +
                       render::info_of(choice.quantity).id + ".png";
  ask(tr("Save the map"), name, tr("PNG (*.png)"), [this](const QString& path) { saveMap(path); });
}

bool ExportController::hasForm(const QString& path, const QStringList& suffixes) {
  if (suffixes.contains(QFileInfo(path).suffix(), Qt::CaseInsensitive)) return true;
  emit refused(tr("%1 was not written: this is written as .%2; name it so.")
                   .arg(QFileInfo(path).fileName(), suffixes.join(", .")));
  return false;
}

void ExportController::exportResult(int estimate, const QString& path) {
  const EstimateEntry* entry = session_.find_estimate(estimate);
  if (!entry || !hasForm(path, {"h5", "pfm", "tiff", "ply"})) return;
  const std::filesystem::path file = path.toStdString();
  const EstimatePtr result = entry->estimate;
  const auto form = map_form_of(file);
  if (form == MapForm::Result) {
    startWriting(path, [file, result, input = session_.input()](const Progress& progress) {
      save_result(file, *result, input, progress);
    });
    return;
  }
  const ViewIndex view = session_.view();
  if (!result->contains(view)) {
    emit hint(tr("%1 has no map of this view: go to the centre view (Home) first.")
                  .arg(QString::fromStdString(entry->name)));
    return;
  }
  startWriting(path, [file, result, view, light_field = session_.light_field(),
                      is_cloud = form == MapForm::PointCloud](const Progress&) {
    is_cloud ? save_point_cloud(file, *light_field, view, result->field.view(view))
             : save_map(file, result->field.view(view));
  });
}

void ExportController::exportSegmentationDialog() {
  const SegmentationPtr& segmentation = session_.segmentation();
  if (!segmentation || !segmentation->labeling) {
    emit hint(tr("Nothing is segmented yet: paint two labels, then update the segmentation."));
    return;
  }
  const QString name = QString::fromStdString(session_.light_field()->info().name);
  const bool has_all = segmentation->labeling->labels.grid().count() > 1;
  ask(tr("Export the segmentation"), name + "_labels.h5",
      tr("%1 (*.h5);;Labels of this view (*.png)")
          .arg(has_all ? tr("Labels and probabilities of all views")
                       : tr("Labels and probabilities of this view")),
      [this](const QString& path) { exportSegmentation(path); });
}

void ExportController::exportSegmentation(const QString& path) {
  const SegmentationPtr segmentation = session_.segmentation();
  if (!segmentation || !segmentation->labeling || !hasForm(path, {"h5", "png"})) return;
  const std::filesystem::path file = path.toStdString();
  if (QFileInfo(path).suffix().toLower() != "png") {
    startWriting(path, [file, segmentation, source = session_.input()](const Progress& progress) {
      write_segmentation(file, *segmentation, source, StoredProbabilities::All, progress);
    });
    return;
  }
  if (const auto source = map_source(session_, {render::Quantity::Segmentation}, session_.view())) {
    startWriting(path, [file, source = *source](const Progress&) {
      write_picture(file, map_picture(*make_map(source), {}));
    });
  }
}

void ExportController::savePicture(const QString& path) {
  RgbaImage picture = to_picture(panels_.canvas->picture());
  if (picture.empty() || !hasForm(path, {"png"})) return;
  startWriting(path, [file = std::filesystem::path(path.toStdString()),
                      picture = std::make_shared<RgbaImage>(std::move(picture)), drawn = drawnMap(),
                      opacity = panels_.canvas->overlayOpacity()](const Progress&) {
    write_picture(
        file, drawn ? blended(*picture, overlay_picture(*make_map(drawn->source), drawn->shading),
                              opacity)
                    : *picture);
  });
}

void ExportController::saveMap(const QString& path) {
  const auto drawn = drawnMap();
  if (!drawn || !hasForm(path, {"png"})) return;
  startWriting(path, [file = std::filesystem::path(path.toStdString()), drawn](const Progress&) {
    write_picture(file, map_picture(*make_map(drawn->source), drawn->shading));
  });
}

std::optional<ExportController::DrawnMap> ExportController::drawnMap() const {
  const MapChoice choice = overlay_.choice();
  auto source = map_source(session_, choice, session_.view());
  if (!source) return std::nullopt;
  return DrawnMap{std::move(*source), overlay_.shadingOf(choice)};
}

void ExportController::startWriting(const QString& path,
                                    std::function<void(const Progress&)> write) {
  jobs_.start<bool>(
      Lane::Export, tr("Writing %1").arg(QFileInfo(path).fileName()),
      [write = std::move(write)](const Progress& progress) {
        write(progress);
        return true;
      },
      [this, path](bool) { emit written(path); });
}

}  // namespace episcope
