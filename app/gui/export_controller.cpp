// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/export_controller.h"

#include "app/session/write_segmentation.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/ply.h"
#include "engine/io/maps/result_file.h"
#include "engine/render/shade.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/picture.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QPainter>

#include <limits>

namespace episcope {
namespace {

void write_map(const std::filesystem::path& path, const DisparityView& view) {
  Image<float> map(view.disparity.height, view.disparity.width, 1,
                   std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (view.is_valid(y, x)) map.at(y, x) = view.disparity.at(y, x);
    }
  }
  QString::fromStdString(path.extension()).toLower() == ".pfm" ? io::write_pfm(path, map)
                                                               : io::write_tiff(path, map);
}

void write_cloud(const std::filesystem::path& path, const LightField& light_field, ViewIndex view,
                 const DisparityView& map) {
  const Image<std::uint8_t> rgba = render::shade_view(light_field, view);
  Image<std::uint8_t> rgb(rgba.height(), rgba.width(), 3);
  for (int y = 0; y < rgb.height(); ++y) {
    for (int x = 0; x < rgb.width(); ++x) {
      for (int c = 0; c < 3; ++c) rgb.at(y, x, c) = rgba.at(y, x, c);
    }
  }
  io::write_ply(path, {map, rgb, light_field.info().camera, true});
}

void write_image(const std::filesystem::path& path, const QImage& picture) {
  const QImage rgb = picture.convertToFormat(QImage::Format_RGB888);
  io::write_png(path, {rgb.constBits(), rgb.height(), rgb.width(), 3, rgb.bytesPerLine()});
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

bool ExportController::hasForm(const QString& path, const QStringList& suffixes) {
  if (suffixes.contains(QFileInfo(path).suffix(), Qt::CaseInsensitive)) return true;
  emit refused(tr("%1 was not written: this is written as .%2; name it so.")
                   .arg(QFileInfo(path).fileName(), suffixes.join(", .")));
  return false;
}

void ExportController::exportResult(int estimate, const QString& path) {
  const EstimateEntry* entry = session_.find_estimate(estimate);
  if (!entry || !hasForm(path, {"h5", "pfm", "tiff", "ply"})) return;
  const QString suffix = QFileInfo(path).suffix().toLower();
  const std::filesystem::path file = path.toStdString();
  const EstimatePtr result = entry->estimate;
  if (suffix == "h5") {
    startWriting(path, [file, result](const Progress& progress) {
      io::write_result(file, *result, progress);
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
                      is_cloud = suffix == "ply"](const Progress&) {
    is_cloud ? write_cloud(file, *light_field, view, result->field.view(view))
             : write_map(file, result->field.view(view));
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
      write_segmentation(file, *segmentation, source, progress);
    });
  } else if (segmentation->covers(session_.view())) {
    startWriting(path, [file, segmentation, view = session_.view()](const Progress&) {
      const auto labels = segmentation->labeling->labels.view(view);
      write_image(file, to_qimage(render::shade_labels(labels, segmentation->labels)));
    });
  }
}

void ExportController::savePicture(const QString& path) {
  QImage picture = panels_.canvas->picture().convertToFormat(QImage::Format_ARGB32_Premultiplied);
  if (picture.isNull() || !hasForm(path, {"png"})) return;
  if (!overlay_.picture().isNull()) {
    QPainter painter(&picture);
    painter.setOpacity(panels_.canvas->overlayOpacity());
    painter.drawImage(picture.rect(), overlay_.picture());
  }
  startWriting(path, [file = std::filesystem::path(path.toStdString()), picture](const Progress&) {
    write_image(file, picture);
  });
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
