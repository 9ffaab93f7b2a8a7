// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/collection/thumbnail_queue.h"

#include "app/gui/frame/queued_post.h"
#include "app/session/run/thread_priority.h"
#include "app/session/scene/scene_thumbnail.h"

#include <utility>

namespace episcope {
namespace {

QImage to_image(const Image<std::uint8_t>& rgb) {
  return QImage(rgb.data(), rgb.width(), rgb.height(), 3 * rgb.width(), QImage::Format_RGB888)
      .copy();
}

}  // namespace

ThumbnailQueue::ThumbnailQueue(QObject* parent) : QObject(parent), runner_(queued_post(this)) {}

void ThumbnailQueue::want(const io::CollectionEntry& entry,
                          const std::filesystem::path& cache_folder) {
  wanted_.push_back({entry, cache_folder});
  next();
}

void ThumbnailQueue::clear() {
  wanted_.clear();
  ++number_;
  runner_.cancel_all();
}

void ThumbnailQueue::next() {
  if (is_busy_ || wanted_.empty()) return;
  const Wanted wanted = std::move(wanted_.back());
  wanted_.pop_back();
  is_busy_ = true;
  runner_.start<QImage>(
      [wanted](const Progress& progress) {
        lower_thread_priority();
        return to_image(scene_thumbnail(wanted.entry, wanted.cache_folder, progress));
      },
      [this, number = number_,
       path = QString::fromStdString(wanted.entry.path.string())](const Outcome<QImage>& outcome) {
        is_busy_ = false;
        if (number == number_ && outcome.value) emit made(path, *outcome.value);
        next();
      });
}

}  // namespace episcope

#include "moc_thumbnail_queue.cpp"
