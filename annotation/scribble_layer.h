// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope {

/// An image of label ids for every view, `[v][u][y][x]`, 0 = none. Memory for a view is allocated
/// once it is painted. Copies share the memory of a view until one of them writes to it, so that a
/// copy costs nothing, and may be read in another thread while this one is painted on.
class ScribbleLayer {
 public:
  /// Maximum height and width of views, so that coordinates fit 16 bits.
  static constexpr int kMaxExtent = 65535;

  ScribbleLayer() = default;
  /// Throws InvalidInput for an empty grid, or views that are empty or larger than kMaxExtent.
  ScribbleLayer(GridShape grid, int height, int width);

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }

  /// Label ids of a view; empty if it was never painted. Throws InvalidInput outside the grid, as
  /// the next two.
  [[nodiscard]] ImageView<const std::uint8_t> view(ViewIndex view) const;
  /// For writing, until the layer is copied; allocates the view, or copies it if it is shared.
  [[nodiscard]] ImageView<std::uint8_t> writable_view(ViewIndex view);
  /// The label at a pixel; 0 also outside the view.
  [[nodiscard]] int label_at(ViewIndex view, PixelIndex pixel) const;
  /// Views with at least one label, in the order of the grid.
  [[nodiscard]] std::vector<ViewIndex> painted_views() const;
  /// Memory used by the views, in bytes.
  [[nodiscard]] std::size_t byte_size() const;

  /// Whether the same pixels have the same labels. Views that are shared are not read.
  friend bool operator==(const ScribbleLayer& a, const ScribbleLayer& b);

 private:
  [[nodiscard]] std::size_t place(ViewIndex view) const;

  GridShape grid_;
  int height_ = 0;
  int width_ = 0;
  std::vector<std::shared_ptr<Image<std::uint8_t>>> views_;  // null = never painted
};

/// The pixels [x0, x1) of row y.
struct PixelSpan {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  [[nodiscard]] PixelRect rect() const { return {y, x0, y + 1, x1}; }
  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

/// A set of pixels of one view.
using PixelRegion = std::vector<PixelSpan>;

}  // namespace episcope
