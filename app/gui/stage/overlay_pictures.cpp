// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/stage/overlay_pictures.h"

#include "app/session/run/thread_priority.h"
#include "widgets/style/picture.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr std::size_t kKeptPictures = 4;

}  // namespace

OverlayPictures::OverlayPictures(JobRunner::Post post, std::function<void()> made)
    : made_(std::move(made)), runner_(std::move(post)) {}

const OverlayPictures::Entry* OverlayPictures::find(const MapSource& source,
                                                    const render::Shading& shading) {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& each) {
    return each.source == source && render::is_same(each.shading, shading);
  });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return &entries_.front();
}

QuantityMapPtr OverlayPictures::find_map(const MapSource& source) const {
  const auto found = std::ranges::find(entries_, source, &Entry::source);
  return found == entries_.end() ? nullptr : found->map;
}

void OverlayPictures::begin(const MapSource& source, const render::Shading& shading) {
  if (std::exchange(is_making_, true)) return;
  runner_.start<Entry>(
      [source, shading, map = find_map(source)](const Progress&) mutable {
        lower_thread_priority();
        if (!map) map = make_map(source);
        return Entry{source, shading, map, to_qimage(overlay_picture(*map, shading))};
      },
      [this, generation = generation_](Outcome<Entry> outcome) {
        is_making_ = false;
        if (outcome.failure) return;
        if (generation == generation_) keep(std::move(*outcome.value));
        made_();
      });
}

void OverlayPictures::keep(Entry entry) {
  std::erase_if(entries_, [&](const Entry& each) { return each.source == entry.source; });
  entries_.push_front(std::move(entry));
  if (entries_.size() > kKeptPictures) entries_.pop_back();
}

void OverlayPictures::clear() {
  entries_.clear();
  ++generation_;
}

}  // namespace episcope
