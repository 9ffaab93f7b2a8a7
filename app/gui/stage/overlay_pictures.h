// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture/picture.h"
#include "engine/core/parallel/job_runner.h"

#include <QImage>

#include <cstdint>
#include <functional>
#include <list>

namespace episcope {

/// Pictures of maps in their colours, made in the background one at a time. The most recently used
/// are kept, since flips and wipes alternate between two.
class OverlayPictures {
 public:
  struct Entry {
    MapSource source;
    render::Shading shading;
    QuantityMapPtr map;
    QImage picture;
  };

  /// `made` is called on the thread of `post` when a picture that was begun is there, or failed.
  OverlayPictures(JobRunner::Post post, std::function<void()> made);

  /// Null if it is not there.
  [[nodiscard]] const Entry* find(const MapSource& source, const render::Shading& shading);
  /// The map alone, which may be there before its picture; null if it is not.
  [[nodiscard]] QuantityMapPtr find_map(const MapSource& source) const;
  /// Begins to make a picture, unless one is being made: then `made` tells when to ask again.
  void begin(const MapSource& source, const render::Shading& shading);
  /// Forgets all; what is being made is not kept.
  void clear();

 private:
  void keep(Entry entry);

  std::function<void()> made_;
  std::list<Entry> entries_;
  bool is_making_ = false;
  std::uint64_t generation_ = 0;
  JobRunner runner_;
};

}  // namespace episcope
