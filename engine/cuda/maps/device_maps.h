// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/parallel/progress.h"

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
  /// Fills both stacks, of the shape given above. Throws DeviceFailure, Cancelled.
  void download(ViewStack<float>& disparity, ViewStack<float>& confidence,
                const Progress& progress) const;

  /// For stages.
  [[nodiscard]] MapMemory& memory() { return *memory_; }

 private:
  std::unique_ptr<MapMemory> memory_;
};

}  // namespace episcope::cuda
