// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/memory.h"

#include <cassert>
#include <cstddef>
#include <type_traits>

namespace episcope {

/// A borrowed volume: one value for each pixel and layer (a label, a disparity), `[y][layer][x]`,
/// contiguous. All layers of an image row lie together, because operations on a pixel involve all
/// its layers: 64 layers of a row of 768 pixels take 192 KiB. Neighboring layers are one image row
/// apart, not one image. Valid as long as the memory it was borrowed from.
template <class T>
struct VolumeView {
  T* data = nullptr;
  int height = 0;
  int layers = 0;
  int width = 0;

  [[nodiscard]] T* row(int y, int layer) const {
    assert(y >= 0 && y < height && layer >= 0 && layer < layers);
    return data + (static_cast<std::ptrdiff_t>(y) * layers + layer) * width;
  }
  [[nodiscard]] T& at(int y, int layer, int x) const {
    assert(x >= 0 && x < width);
    return row(y, layer)[x];
  }
  [[nodiscard]] bool empty() const { return data == nullptr; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(height) * layers * width;
  }
  operator VolumeView<const T>() const requires(!std::is_const_v<T>) {
    return {data, height, layers, width};
  }
};

/// An owned volume `[y][layer][x]`. Move-only: a volume takes hundreds of megabytes.
template <class T>
class Volume {
 public:
  Volume() = default;
  /// Elements are uninitialized: the caller must write every one.
  Volume(int height, int layers, int width)
      : height_(height), layers_(layers), width_(width), samples_(make_large<T>(view().size())) {}

  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int layers() const { return layers_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] bool empty() const { return samples_ == nullptr; }
  [[nodiscard]] VolumeView<T> view() { return {samples_.get(), height_, layers_, width_}; }
  [[nodiscard]] VolumeView<const T> view() const {
    return {samples_.get(), height_, layers_, width_};
  }

 private:
  int height_ = 0;
  int layers_ = 0;
  int width_ = 0;
  LargeArray<T> samples_;
};

}  // namespace episcope
