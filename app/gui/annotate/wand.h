// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/labeling/ray_superpixels.h"

#include <QObject>

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope {

/// Selects regions of like rays in all views at once, by the superpixels of the ray space. These
/// are made in the background, once for a light field and its disparity.
class Wand : public QObject {
  Q_OBJECT

 public:
  enum class State {
    Missing,  ///< There is no disparity of all views.
    Making,
    Ready
  };

  Wand(const Session& session, QObject* parent);

  /// Begins to make the superpixels of the shown light field, unless they are there.
  State prepare();
  /// Superpixels of the region at a pixel (RaySuperpixels::alike); empty unless Ready, and outside
  /// the view. Precondition: the view lies in the grid.
  [[nodiscard]] std::vector<std::uint8_t> select(ViewIndex view, PixelIndex seed,
                                                 float tolerance) const;
  /// The selected pixels of a view. Precondition: Ready, unless `selected` is empty.
  [[nodiscard]] PixelRegion region(const std::vector<std::uint8_t>& selected, ViewIndex view) const;
  /// The selected pixels of each view that has some.
  [[nodiscard]] std::vector<ViewRegion> regions(const std::vector<std::uint8_t>& selected) const;

 signals:
  /// The superpixels were made.
  void ready();

 private:
  using Superpixels = std::shared_ptr<const RaySuperpixels>;
  [[nodiscard]] std::shared_ptr<const DisparityField> disparity() const;

  const Session& session_;
  /// What they are made of; nothing else is kept by it.
  std::weak_ptr<const LightField> light_field_;
  std::weak_ptr<const DisparityField> disparity_;
  Superpixels superpixels_;  // null while they are made
  LatestJob job_;
};

}  // namespace episcope
