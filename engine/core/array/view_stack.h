// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/indices.h"
#include "engine/core/array/large_memory.h"

#include <algorithm>

namespace episcope {

/// One image for each view of a rectangle of the camera grid, `[v][u][y][x][c]`, contiguous. The
/// rectangle begins at `first`: a result for the centre view alone is a stack of 1×1 views whose
/// `first` is the centre. Views are always addressed by their place in the whole grid. Move-only,
/// because a stack of all views takes hundreds of megabytes; `clone` copies on purpose.
template <class T>
class ViewStack {
 public:
  ViewStack() = default;
  /// Elements are uninitialised: the caller must write every one.
  ViewStack(GridShape grid, int height, int width, int channels = 1, ViewIndex first = {})
      : grid_(grid),
        first_(first),
        height_(height),
        width_(width),
        channels_(channels),
        samples_(make_large<T>(size())) {}
  ViewStack(ViewStack&& other) noexcept { swap(other); }
  ViewStack& operator=(ViewStack&& other) noexcept {
    ViewStack taken(std::move(other));
    swap(taken);
    return *this;
  }

  [[nodiscard]] ViewStack clone() const {
    if (empty()) return {};
    ViewStack copy(grid_, height_, width_, channels_, first_);
    std::copy_n(samples_.get(), size(), copy.samples_.get());
    return copy;
  }

  [[nodiscard]] bool empty() const { return samples_ == nullptr; }
  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] ViewIndex first() const { return first_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] std::size_t view_size() const {
    return static_cast<std::size_t>(height_) * width_ * channels_;
  }
  [[nodiscard]] std::size_t size() const { return view_size() * grid_.count(); }
  [[nodiscard]] bool contains(ViewIndex view) const {
    return grid_.contains({view.v - first_.v, view.u - first_.u});
  }
  [[nodiscard]] T* data() { return samples_.get(); }
  [[nodiscard]] const T* data() const { return samples_.get(); }

  /// View number `index`, in the order of the samples.
  [[nodiscard]] ViewIndex view_at(int index) const { return grid_.view_at(index, first_); }

  /// Precondition: `contains(view)`.
  [[nodiscard]] ImageView<T> view(ViewIndex view) { return image<T>(samples_.get(), view); }
  [[nodiscard]] ImageView<const T> view(ViewIndex view) const {
    return image<const T>(samples_.get(), view);
  }

 private:
  template <class U>
  [[nodiscard]] ImageView<U> image(U* base, ViewIndex view) const {
    assert(contains(view));
    const auto index = static_cast<std::size_t>(view.v - first_.v) * grid_.u + (view.u - first_.u);
    return {base + index * view_size(), height_, width_, channels_,
            static_cast<std::ptrdiff_t>(width_) * channels_};
  }
  void swap(ViewStack& other) noexcept {
    std::swap(grid_, other.grid_);
    std::swap(first_, other.first_);
    std::swap(height_, other.height_);
    std::swap(width_, other.width_);
    std::swap(channels_, other.channels_);
    std::swap(samples_, other.samples_);
  }

  GridShape grid_;
  ViewIndex first_;
  int height_ = 0;
  int width_ = 0;
  int channels_ = 1;
  LargeArray<T> samples_;
};

}  // namespace episcope
