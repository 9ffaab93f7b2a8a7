// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/view_stack.h"

#include <future>
#include <memory>

namespace episcope::cuda {

struct MapMemory;

/// Disparity and confidence of a rectangle of views on the device, with the stream that stages of a
/// method work on, one after the other. Move-only.
class DeviceMaps {
 public:
  /// Not yet filled, for maps of the shape of `like`. Throws DeviceFailure.
  explicit DeviceMaps(const ViewStack<float>& like);
  ~DeviceMaps();
  DeviceMaps(DeviceMaps&&) noexcept;

  /// Clamps every disparity. Throws DeviceFailure.
  void clamp(float min, float max);
  /// Begins to fill a stack of the shape given above with the confidence as stages so far leave it,
  /// while later ones, which must not change it, compute. Waiting throws DeviceFailure, Cancelled.
  [[nodiscard]] std::future<void> begin_confidence(ViewStack<float>& confidence,
                                                   const Progress& progress) const;
  /// Fills a stack of the shape given above. Throws DeviceFailure, Cancelled.
  void download_disparity(ViewStack<float>& disparity, const Progress& progress) const;

  /// For stages.
  [[nodiscard]] MapMemory& memory() { return *memory_; }

 private:
  std::unique_ptr<MapMemory> memory_;
};

}  // namespace episcope::cuda
