// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/job_runner.h"
#include "engine/io/collection/collection_entry.h"

#include <QImage>
#include <QObject>

#include <deque>
#include <filesystem>

namespace episcope {

/// Makes thumbnails in the background, one after the other, those asked for last first: they are
/// the ones on screen.
class ThumbnailQueue : public QObject {
  Q_OBJECT

 public:
  explicit ThumbnailQueue(QObject* parent);

  /// Thumbnails are kept in `cache_folder`; empty = nowhere.
  void want(const io::CollectionEntry& entry, const std::filesystem::path& cache_folder);
  /// Forgets what was asked for.
  void clear();

 signals:
  /// Not emitted for light fields that cannot be read.
  void made(const QString& path, const QImage& thumbnail);

 private:
  void next();

  struct Wanted {
    io::CollectionEntry entry;
    std::filesystem::path cache_folder;
  };

  std::deque<Wanted> wanted_;
  bool is_busy_ = false;
  quint64 number_ = 0;  // of the collection
  JobRunner runner_;
};

}  // namespace episcope
