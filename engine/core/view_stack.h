// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/memory.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace episcope {

/// One image for each view of a rectangle of the camera grid, `[v][u][y][x][c]`, contiguous. The
/// rectangle begins at `first`: a result for the center view alone is a stack of 1×1 views whose
/// `first` is the center. Views are always addressed by their place in the whole grid. Move-only,
/// because a stack of all views takes hundreds of megabytes; `clone` copies on purpose.
///
/// Samples of a file (LargeKind::File) are never moved. Other strides put their views in another
/// order, so they may lie in memory in any order (`is_in_order`).
template <class T>
class ViewStack {
 public:
  ViewStack() = default;
  /// Elements are uninitialized: the caller must write every one.
  ViewStack(GridShape grid, int height, int width, int channels = 1, ViewIndex first = {})
      : ViewStack(grid, height, width, channels, first, allocate_large) {}
  /// In memory from `allocate`, such as allocate_large_zeros or a part of a file.
  template <class Allocate>
  ViewStack(GridShape grid, int height, int width, int channels, ViewIndex first,
            const Allocate& allocate)
      : grid_(grid),
        first_(first),
        height_(height),
        width_(width),
        channels_(channels),
        strides_(dense_strides()),
        samples_(large_array<T>(allocate(size() * sizeof(T)))) {}
  ViewStack(ViewStack&& other) noexcept { swap(other); }
  ViewStack& operator=(ViewStack&& other) noexcept {
    ViewStack taken(std::move(other));
    swap(taken);
    return *this;
  }

  [[nodiscard]] ViewStack clone() const {
    if (empty()) return {};
    ViewStack copy(grid_, height_, width_, channels_, first_);
    for (int i = 0; i < grid_.count(); ++i) {
      std::copy_n(view(view_at(i)).data, view_size(), copy.view(view_at(i)).data);
    }
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
  /// Start of the samples in memory: the first view, if views are in order.
  [[nodiscard]] T* data() { return samples_.get(); }
  [[nodiscard]] const T* data() const { return samples_.get(); }

  [[nodiscard]] LargeKind kind() const { return samples_.get_deleter().kind; }
  /// Whether samples are in a file that the system reads when they are looked at.
  [[nodiscard]] bool is_on_disk() const {
    return kind() == LargeKind::Scratch || kind() == LargeKind::File;
  }
  /// Whether `size()` samples from `data()` on hold the views in their order.
  [[nodiscard]] bool is_in_order() const { return origin_ == 0 && strides_ == dense_strides(); }

  /// View number `index`, in the order of the samples.
  [[nodiscard]] ViewIndex view_at(int index) const { return grid_.view_at(index, first_); }

  /// Precondition: `contains(view)`.
  [[nodiscard]] ImageView<T> view(ViewIndex view) { return image<T>(samples_.get(), view); }
  [[nodiscard]] ImageView<const T> view(ViewIndex view) const {
    return image<const T>(samples_.get(), view);
  }

  /// Reverses rows or columns of views, without moving samples. The stack keeps its place.
  void reverse_in_place(bool rows, bool columns) {
    if (rows) origin_ += (grid_.v - 1) * strides_.v;
    if (columns) origin_ += (grid_.u - 1) * strides_.u;
    strides_ = {rows ? -strides_.v : strides_.v, columns ? -strides_.u : strides_.u};
  }
  /// Exchanges rows and columns of views, likewise.
  void transpose_in_place() {
    grid_ = {grid_.u, grid_.v};
    first_ = {first_.u, first_.v};
    strides_ = {strides_.u, strides_.v};
  }
  /// Keeps `grid` views from view `from` on, which `first` becomes the place of, likewise.
  void keep_in_place(ViewIndex from, GridShape grid, ViewIndex first) {
    assert(contains(from));
    origin_ += (from.v - first_.v) * strides_.v + (from.u - first_.u) * strides_.u;
    grid_ = grid;
    first_ = first;
  }

 private:
  // From one view to the next, in samples.
  struct ViewStrides {
    std::ptrdiff_t v = 0, u = 0;
    friend bool operator==(const ViewStrides&, const ViewStrides&) = default;
  };

  [[nodiscard]] ViewStrides dense_strides() const {
    const auto size = static_cast<std::ptrdiff_t>(view_size());
    return {size * grid_.u, size};
  }
  template <class U>
  [[nodiscard]] ImageView<U> image(U* base, ViewIndex view) const {
    assert(contains(view));
    const std::ptrdiff_t place =
        origin_ + (view.v - first_.v) * strides_.v + (view.u - first_.u) * strides_.u;
    return {base + place, height_, width_, channels_,
            static_cast<std::ptrdiff_t>(width_) * channels_};
  }
  void swap(ViewStack& other) noexcept {
    std::swap(grid_, other.grid_);
    std::swap(first_, other.first_);
    std::swap(height_, other.height_);
    std::swap(width_, other.width_);
    std::swap(channels_, other.channels_);
    std::swap(strides_, other.strides_);
    std::swap(origin_, other.origin_);
    std::swap(samples_, other.samples_);
  }

  GridShape grid_;
  ViewIndex first_;
  int height_ = 0;
  int width_ = 0;
  int channels_ = 1;
  ViewStrides strides_;
  std::ptrdiff_t origin_ = 0;  // Where the first view begins.
  LargeArray<T> samples_;
};

/// Drops the samples of a view on disk from memory; they are read again on access.
template <class T>
void forget_view(const ViewStack<T>& stack, ViewIndex view) noexcept {
  if (stack.is_on_disk()) forget_pages(stack.view(view).data, sizeof(T) * stack.view_size());
}

}  // namespace episcope
