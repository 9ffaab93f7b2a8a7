// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/memory.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace episcope {

/// A borrowed image: `[y][x][c]` with interleaved channels and contiguous rows `row_stride`
/// elements apart. Owns nothing; valid as long as the memory it was borrowed from.
template <class T>
struct ImageView {
  T* data = nullptr;
  int height = 0;
  int width = 0;
  int channels = 1;
  std::ptrdiff_t row_stride = 0;

  [[nodiscard]] T* row(int y) const {
    assert(y >= 0 && y < height);
    return data + y * row_stride;
  }
  [[nodiscard]] T& at(int y, int x, int c = 0) const {
    assert(x >= 0 && x < width && c >= 0 && c < channels);
    return row(y)[x * channels + c];
  }
  [[nodiscard]] bool empty() const { return data == nullptr; }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(height) * width * channels;
  }
  operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data, height, width, channels, row_stride};
  }
};

/// An owned image `[y][x][c]`, contiguous.
template <class T>
class Image {
 public:
  Image() = default;
  Image(int height, int width, int channels = 1, T value = T{})
      : height_(height),
        width_(width),
        channels_(channels),
        samples_(static_cast<std::size_t>(height) * width * channels, value) {}

  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] T* data() { return samples_.data(); }
  [[nodiscard]] const T* data() const { return samples_.data(); }
  [[nodiscard]] T* row(int y) { return view().row(y); }
  [[nodiscard]] const T* row(int y) const { return view().row(y); }
  [[nodiscard]] T& at(int y, int x, int c = 0) { return view().at(y, x, c); }
  [[nodiscard]] const T& at(int y, int x, int c = 0) const { return view().at(y, x, c); }
  [[nodiscard]] ImageView<T> view() {
    return {samples_.data(), height_, width_, channels_, row_stride()};
  }
  [[nodiscard]] ImageView<const T> view() const {
    return {samples_.data(), height_, width_, channels_, row_stride()};
  }
  operator ImageView<const T>() const { return view(); }
  [[nodiscard]] auto begin() { return samples_.begin(); }
  [[nodiscard]] auto end() { return samples_.end(); }
  [[nodiscard]] auto begin() const { return samples_.begin(); }
  [[nodiscard]] auto end() const { return samples_.end(); }

 private:
  [[nodiscard]] std::ptrdiff_t row_stride() const {
    return static_cast<std::ptrdiff_t>(width_) * channels_;
  }

  int height_ = 0;
  int width_ = 0;
  int channels_ = 1;
  std::vector<T> samples_;
};

/// Rows and columns exchanged, channels as they are.
template <class T>
[[nodiscard]] Image<T> transposed(const Image<T>& image) {
  Image<T> turned(image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      std::copy_n(&image.at(y, x), image.channels(), &turned.at(x, y));
    }
  }
  return turned;
}

/// Weight of a channel in a squared difference of colors. One channel counts as three equal ones,
/// so that thresholds mean the same in grey as in color.
[[nodiscard]] constexpr double channel_weight(int channels) {
  return channels == 1 ? 3 : 1;
}

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
