// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "engine/capture/plenoptic/decode_files.h"

#include <QImage>
#include <QObject>
#include <QString>
#include <QStringList>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

class RawPicturePanel;

/// The step of a raw picture that a job did last: the pictures as they were read, and to show.
struct ReadRaw {
  std::shared_ptr<const capture::FoundPictures> found;
  QStringList names;
  std::vector<QImage> pictures;
};

/// Decodes raw pictures of plenoptic cameras step by step: pictures, lenses, views. Reads the raw
/// picture of the shown light field if it was decoded from one.
class RawPictures : public QObject {
  Q_OBJECT

 public:
  RawPictures(const Workbench& bench, QObject* parent);

  /// Shows its state in this panel and obeys it.
  void attach(RawPicturePanel* panel);
  /// Reads a raw picture (or `demo:plenoptic`) with its white and dark picture, and finds its
  /// lenses.
  void open(const QString& path);
  void findLenses();
  /// Writes the light field and opens it.
  void decode(const QString& path, const capture::DecodeOptions& options);

 signals:
  /// A raw picture was asked for.
  void begun();

 private:
  void connectFiles(RawPicturePanel* panel);
  void read(const capture::PictureFiles& files);
  void take(const capture::PictureFiles& files, const ReadRaw& read);
  void choose(const char* name, const QString& title,
              std::filesystem::path capture::PictureFiles::*file);
  void askForViews();
  void follow();
  void show();

  Workbench bench_;
  RawPicturePanel* panel_ = nullptr;
  capture::PictureFiles files_;
  std::shared_ptr<const capture::FoundPictures> found_;
  std::optional<capture::LensGrid> grid_;
  capture::DecodeOptions options_;
  QString views_;           // what was decoded
  std::string followed_{};  // the light field whose raw picture was read last
};

}  // namespace episcope
