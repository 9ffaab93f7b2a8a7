// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"

#include <array>
#include <cstdint>
#include <vector>

namespace episcope {

/// Superpixels of the ray space: small sets of rays of like color and disparity, which hold the
/// rays of a scene point in all views that show it. They let a region be selected in one view and
/// be found in all others.
///
/// The center view is divided by SLIC, with disparity as a further feature; parts that are cut off
/// join their neighbors. A ray of another view takes the superpixel of the pixel of the center view
/// that sees its point (ray_labeling.h). A ray whose point the center view does not show takes the
/// superpixel most like it around the place where the center view would see the point.
///
/// Source: Achanta et al. 2012 [ASS12] (SLIC); Zhu, Zhang, Wang 2017 [ZZW17] (superpixels of light
/// fields). In contrast to the latter, rays follow a given disparity of each view. Linear in rays.
class RaySuperpixels {
 public:
  /// Superpixel of rays without content.
  static constexpr std::uint16_t kNone = 0xFFFF;
  /// Least distance of the centers of superpixels, px.
  static constexpr int kSpacing_px = 8;

  /// `disparity` of all views; invalid pixels take the one beside them. The result does not depend
  /// on the number of threads. Throws InvalidInput if a view has no disparity; Cancelled.
  RaySuperpixels(const LightField& light_field, const DisparityField& disparity,
                 const Progress& progress);

  /// The superpixel of each ray, `[v][u][y][x]`.
  [[nodiscard]] const ViewStack<std::uint16_t>& ids() const { return ids_; }
  [[nodiscard]] int count() const { return static_cast<int>(means_.size()); }

  /// The superpixels of a region, `[id]`, 1 = selected: those connected to `seed` whose mean colors
  /// differ from its own by at most `tolerance`, the Euclidean norm over channels in [0, 1],
  /// without a jump of disparity between neighbors (kSamePointTolerance_px), nor an edge: pixels on
  /// both sides of their border differ by at most tolerance/2 in the mean. It has the seed at
  /// least. Nothing is selected for kNone.
  [[nodiscard]] std::vector<std::uint8_t> alike(std::uint16_t seed, float tolerance) const;

  /// Means over the pixels of a superpixel in the center view.
  struct Mean {
    float y = 0, x = 0;
    float disparity = 0;
    std::array<float, 3> color{};  ///< Of gray light fields the first alone.
    int pixels = 0;                ///< 0 = it has lost all of them.
  };

 private:
  struct Neighbor {
    std::uint16_t id;
    float contrast;  ///< Of pixels on both sides of the common border, in the mean.
  };
  void connect(const Image<float>& colors, ImageView<const std::uint16_t> center);

  ViewStack<std::uint16_t> ids_;
  std::vector<Mean> means_;
  std::vector<std::vector<Neighbor>> neighbors_;  // in the center view
};

}  // namespace episcope
