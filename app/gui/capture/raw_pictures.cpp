// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/raw_pictures.h"

#include "app/gui/capture/photographs.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/raw_scene.h"
#include "app/session/session.h"
#include "engine/core/schema.h"
#include "widgets/controls/text.h"
#include "widgets/panels/raw_picture_panel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

constexpr const char* kPlenopticDemo = "demo:plenoptic";

/// The samples between black and saturation, as a screen shows them.
QImage screen_image(const capture::RawPicture& picture) {
  const Image<std::uint16_t>& samples = picture.samples;
  std::vector<uchar> curve(1 << 16);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double light = (static_cast<double>(k) - picture.black) / (picture.white - picture.black);
    curve[k] = static_cast<uchar>(255 * std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2) + 0.5);
  }
  QImage image(samples.width(), samples.height(), QImage::Format_Grayscale8);
  for (int y = 0; y < samples.height(); ++y) {
    std::transform(samples.row(y), samples.row(y) + samples.width(), image.scanLine(y),
                   [&](std::uint16_t sample) { return curve[sample]; });
  }
  return image;
}

ReadRaw read_raw_files(const capture::PictureFiles& files, const Progress& progress) {
  ReadRaw read;
  read.found = std::make_shared<const capture::FoundPictures>(
      files.raw == kPlenopticDemo ? expose_plenoptic(progress) : capture::read_pictures(files));
  const auto& [raw, white, dark] = read.found->pictures;
  progress.check();
  read.names << RawPictures::tr("Raw picture");
  read.pictures.push_back(screen_image(raw));
  if (white) {
    read.names << RawPictures::tr("White picture");
    read.pictures.push_back(screen_image(*white));
  }
  if (dark) {
    read.names << RawPictures::tr("Dark picture");
    read.pictures.push_back(screen_image(*dark));
  }
  return read;
}

/// Centers of all lenses in the picture.
std::vector<QPointF> centers_of(const capture::LensGrid& grid, const capture::RawPicture& raw) {
  const int height = raw.samples.height(), width = raw.samples.width();
  const capture::LensBlock block = lens_block(grid, height, width, -grid.pitch_px);
  std::vector<QPointF> centers;
  for (int j = block.first_row; j < block.first_row + block.rows; ++j) {
    const int first = static_cast<int>(std::ceil(lens_at(grid, block.first_column, j)));
    for (int i = first; i <= first + static_cast<int>(block.columns); ++i) {
      const capture::PlanePoint at = grid.center(i, j);
      if (at.x > -0.5 && at.y > -0.5 && at.x < width - 0.5 && at.y < height - 0.5) {
        centers.emplace_back(at.x, at.y);
      }
    }
  }
  return centers;
}

QString lenses_text(const capture::LensGrid& grid) {
  const QString lattice = grid.lattice == capture::LensLattice::Hexagonal
                              ? RawPictures::tr("hexagonal")
                              : RawPictures::tr("square");
  return RawPictures::tr("Lenses: %1, %2 px, turned by %3°; %4 fit to %5 px, %6 do not")
      .arg(lattice)
      .arg(grid.pitch_px, 0, 'f', 2)
      .arg(with_minus(QString::number(grid.rotation_degrees, 'f', 2)))
      .arg(grid.lenses)
      .arg(grid.residual_px, 0, 'f', 3)
      .arg(grid.measured - grid.lenses);
}

QString views_text(const LightField& field) {
  return RawPictures::tr("%1×%2 views of %3×%4 px")
      .arg(field.grid().v)
      .arg(field.grid().u)
      .arg(field.width())
      .arg(field.height());
}

bool comes_from_raw(const Session& session) {
  if (!session.scene()) return false;
  const std::string& input = session.input();
  return input == kPlenopticDemo || capture::is_decoded(*session.scene(), input);
}

}  // namespace

RawPictures::RawPictures(const Workbench& bench, QObject* parent) : QObject(parent), bench_(bench) {
  bench_.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) follow();
  });
}

void RawPictures::attach(RawPicturePanel* panel) {
  panel_ = panel;
  connectFiles(panel);
  connect(panel, &RawPicturePanel::lensesRequested, this, &RawPictures::findLenses);
  connect(panel, &RawPicturePanel::decodeRequested, this, &RawPictures::askForViews);
  connect(panel, &RawPicturePanel::demoRequested, this, [this] { open(kPlenopticDemo); });
  connect(panel, &RawPicturePanel::mosaicChosen, this, [this](const QString& name) {
    capture::PictureFiles files = files_;
    for (const auto& each : names_of(capture::Mosaic{})) {
      if (name == QString(each.name)) files.mosaic = each.value;
    }
    read(files);
  });
  show();
  follow();
}

void RawPictures::connectFiles(RawPicturePanel* panel) {
  connect(panel, &RawPicturePanel::openRequested, this, [this] {
    ask_for_file(&bench_.window,
                 {.name = "open_raw",
                  .title = tr("Open a raw picture"),
                  .filter = tr("Raw pictures (*.lfp *.lfr *.raw *.RAW *.png *.tif *.tiff *.pgm "
                               "*.bmp);;All files (*)")},
                 [this](const QString& path) { open(path); });
  });
  connect(panel, &RawPicturePanel::whiteRequested, this, [this] {
    choose("open_white", tr("Open a white picture"), &capture::PictureFiles::white);
  });
  connect(panel, &RawPicturePanel::darkRequested, this,
          [this] { choose("open_dark", tr("Open a dark picture"), &capture::PictureFiles::dark); });
  connect(panel, &RawPicturePanel::opticsRequested, this, [this] {
    choose("open_optics", tr("Open the optics of a camera"), &capture::PictureFiles::camera);
  });
  connect(panel, &RawPicturePanel::calibrationRequested, this, [this] {
    ask_for_folder(&bench_.window,
                   {.name = "open_calibration", .title = tr("Folder of calibration data")},
                   [this](const QString& path) {
                     capture::PictureFiles files = files_;
                     files.white = path_of(path);
                     read(files);
                   });
  });
}

void RawPictures::choose(const char* name, const QString& title,
                         std::filesystem::path capture::PictureFiles::*file) {
  ask_for_file(&bench_.window, {.name = name, .title = title, .filter = tr("All files (*)")},
               [this, file](const QString& path) {
                 capture::PictureFiles files = files_;
                 files.*file = path_of(path);
                 read(files);
               });
}

void RawPictures::open(const QString& path) {
  emit begun();
  views_.clear();
  read({.raw = path_of(path)});
}

void RawPictures::read(const capture::PictureFiles& files) {
  const quint64 job = bench_.jobs.start<ReadRaw>(
      Lane::Capture, tr("Reading %1").arg(QString::fromStdString(files.raw.filename().string())),
      [files](const Progress& progress) { return read_raw_files(files, progress); },
      [this, files](const ReadRaw& read) { take(files, read); });
  bench_.jobs.setExpendable(job);
}

void RawPictures::take(const capture::PictureFiles& files, const ReadRaw& read) {
  files_ = files;
  found_ = read.found;
  grid_.reset();
  panel_->setCenters({}, 0);
  panel_->setPictures(read.names, read.pictures);
  show();
  findLenses();
}

void RawPictures::findLenses() {
  if (!found_) return;
  const quint64 job = bench_.jobs.start<capture::LensGrid>(
      Lane::Capture, tr("Finding the lenses"),
      [found = found_](const Progress& progress) {
        return capture::find_lenses(found->pictures, progress);
      },
      [this, found = found_](const capture::LensGrid& grid) {
        if (found != found_) return;
        grid_ = grid;
        panel_->setCenters(centers_of(grid, found_->pictures.raw), grid.pitch_px);
        show();
      });
  bench_.jobs.setExpendable(job);
}

void RawPictures::askForViews() {
  const auto save = [this](const ParameterSet& values) {
    options_ = capture::decode_schema().parse(values);
    ask_where_to_save(
        bench_,
        {.name = "save_decoded",
         .title = tr("Save the views"),
         .filter = tr("Light field (*.h5)"),
         .proposal = QString::fromStdString(
             std::filesystem::path(found_->pictures.raw.name).stem().string() + ".h5"),
         .confirms_overwrite = false},
        [this](const QString& path) { decode(path, options_); });
  };
  ask_for_values(&bench_.window,
                 {.name = "decode",
                  .title = tr("Decode the raw picture"),
                  .accept = tr("Save as…"),
                  .parameters = capture::decode_schema().descriptions(),
                  .values = capture::decode_schema().values(options_)},
                 save);
}

void RawPictures::decode(const QString& path, const capture::DecodeOptions& options) {
  if (!grid_ || !is_new_light_field(path, bench_.messages)) return;
  bench_.jobs.start<capture::Decoded>(
      Lane::Capture, tr("Decoding"),
      [found = found_, grid = *grid_, options, file = path_of(path)](const Progress& progress) {
        capture::Decoded decoded =
            capture::decode(found->pictures, grid, options, progress.part(0, 0.85));
        capture::write_decoded(file, decoded, *found, progress.part(0.85, 1));
        return decoded;
      },
      [this, path](const capture::Decoded& decoded) {
        views_ = tr("%1, %2 % valid, %3 hot pixels replaced")
                     .arg(views_text(*decoded.light_field))
                     .arg(decoded.valid_percent, 0, 'f', 1)
                     .arg(decoded.hot_pixels);
        show();
        bench_.opener.open(path);
      });
}

void RawPictures::follow() {
  if (!panel_ || !comes_from_raw(bench_.session)) return;
  const std::string& input = bench_.session.input();
  if (std::exchange(followed_, input) == input) return;
  open(QString::fromStdString(input));
  views_ = views_text(*bench_.session.light_field());
}

void RawPictures::show() {
  if (!panel_) return;
  QString raw, white;
  if (found_) {
    const capture::RawPicture& picture = found_->pictures.raw;
    raw = tr("%1: %2×%3 px, %4")
              .arg(QString::fromStdString(picture.name))
              .arg(picture.samples.width())
              .arg(picture.samples.height())
              .arg(QString::fromStdString(name_of(picture.mosaic)));
    QStringList notes;
    for (const std::string& note : found_->notes) notes << finding_words(note);
    white = notes.join("; ");
  }
  panel_->setRaw(raw);
  panel_->setWhite(white);
  panel_->setLenses(grid_ ? lenses_text(*grid_) : QString());
  panel_->setViews(views_);
}

}  // namespace episcope

#include "moc_raw_pictures.cpp"
