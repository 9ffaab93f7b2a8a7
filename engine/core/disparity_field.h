// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/view_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// Disparity of one view, borrowed: px per view step, positive = nearer than the zero plane.
struct DisparityView {
  ImageView<const float> disparity;
  ImageView<const std::uint8_t> valid;  ///< 0 = no value there; empty = all valid.

  [[nodiscard]] bool is_valid(int y, int x) const {
    return (valid.empty() || valid.at(y, x) != 0) && std::isfinite(disparity.at(y, x));
  }
};

/// Disparity maps of all views or of one, `[v][u][y][x]`, with the validity mask beside them. NaN
/// exists in files only: readers turn it into the mask, writers turn it back.
struct DisparityField {
  ViewStack<float> disparity;
  ViewStack<std::uint8_t> valid;  ///< Same shape, 0 = invalid; empty = all valid.

  [[nodiscard]] bool empty() const { return disparity.empty(); }
  [[nodiscard]] bool contains(ViewIndex view) const { return !empty() && disparity.contains(view); }
  /// Precondition: `contains(view)`.
  [[nodiscard]] DisparityView view(ViewIndex view) const {
    return {disparity.view(view),
            valid.empty() ? ImageView<const std::uint8_t>{} : valid.view(view)};
  }
  /// Makes the mask, all pixels valid, unless there is one.
  void require_mask() {
    if (!valid.empty()) return;
    valid = ViewStack<std::uint8_t>(disparity.grid(), disparity.height(), disparity.width(), 1,
                                    disparity.first());
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  }

  /// Disparity 0 of which no pixel is valid.
  [[nodiscard]] static DisparityField unknown(GridShape grid, int height, int width,
                                              ViewIndex first) {
    DisparityField field{ViewStack<float>(grid, height, width, 1, first),
                         ViewStack<std::uint8_t>(grid, height, width, 1, first)};
    std::fill_n(field.disparity.data(), field.disparity.size(), 0.0F);
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{0});
    return field;
  }
};

/// Further results of a method that estimates two layers (transparent scenes).
struct LayeredDisparity {
  DisparityField foreground;
  DisparityField background;
  ViewStack<std::uint8_t> layers;  ///< 1 or 2 surfaces per pixel; 0 = unknown.
};

/// Disparity of one view without the pixels that its light field does not show.
class ShownDisparity {
 public:
  /// `shown`: 0 = the pixel holds nothing (LightField::valid_of), of the size of `map`; empty = all
  /// are shown, and `map` stays as it is. Both are borrowed.
  ShownDisparity(const DisparityView& map, ImageView<const std::uint8_t> shown) : view_(map) {
    if (shown.empty()) return;
    valid_ = Image<std::uint8_t>(shown.height, shown.width);
    for (int y = 0; y < shown.height; ++y) {
      for (int x = 0; x < shown.width; ++x) {
        valid_.at(y, x) = shown.at(y, x) != 0 && map.is_valid(y, x) ? 1 : 0;
      }
    }
    view_.valid = valid_.view();
  }
  ShownDisparity(const ShownDisparity&) = delete;
  ShownDisparity& operator=(const ShownDisparity&) = delete;

  /// Valid as long as this object.
  [[nodiscard]] const DisparityView& view() const { return view_; }

 private:
  Image<std::uint8_t> valid_;
  DisparityView view_;
};

/// Everything needed to reproduce an estimate.
struct Provenance {
  std::string method;             ///< Id as in `episcope-cli methods`; of foreign results any name.
  ParameterSet parameters;        ///< Every parameter of the method with the value used.
  Interval range{};               ///< Disparity range searched, px per view step; {0, 0} = unknown.
  double seconds = 0;             ///< Wall-clock time; 0 = unknown.
  std::string version;            ///< Of Episcope.
  std::string source;             ///< Path or name of the light field.
  std::uint64_t source_hash = 0;  ///< LightField::sample_hash, 0 = unknown.
  Reading reading{};              ///< How that light field was read.
  std::vector<std::string> notes;  ///< What a user should know of this run: gap, unsolved views.
  int border_px = 0;     ///< Pixels at each side of the views that foreign maps lack; not judged.
  CameraGrid camera{};   ///< Of that light field: depth follows from it; unknown = all 0.
  std::string device{};  ///< What computed: "CPU" or the name of a GPU; empty = unknown.
  std::string commit{};  ///< Of Episcope, that was built; empty = unknown.
  std::string date{};    ///< When it was finished, UTC: "2026-11-27T22:43:23Z"; empty = unknown.
};

/// A disparity estimate. Covers all views or one.
struct Estimate : Provenance {
  DisparityField field;
  ViewStack<float> confidence;  ///< In [0, 1], shape of `field.disparity`; empty = unknown.
  LayeredDisparity layered;     ///< Empty unless the method estimates two layers.
  /// Another disparity that a pixel may have instead, as beside silhouettes; not valid where there
  /// is none. Empty unless the method finds some.
  DisparityField second;

  [[nodiscard]] const Provenance& provenance() const { return *this; }
  void set_provenance(Provenance provenance) {
    static_cast<Provenance&>(*this) = std::move(provenance);
  }
  [[nodiscard]] bool contains(ViewIndex view) const { return field.contains(view); }
};

using EstimatePtr = std::shared_ptr<const Estimate>;

/// Size of a stack of maps and its place in the grid.
struct MapGeometry {
  GridShape grid;
  ViewIndex first;
  int height = 0;
  int width = 0;
};

template <class T>
[[nodiscard]] MapGeometry geometry_of(const ViewStack<T>& stack) {
  return {stack.grid(), stack.first(), stack.height(), stack.width()};
}

/// Some rows of some views.
struct MapBlock {
  ViewRectangle views;
  int first_row = 0;
  int end_row = 0;
  [[nodiscard]] int rows() const { return end_row - first_row; }
};

/// Maps of one block of an estimate. Views are addressed by their place in the grid; row 0 is the
/// first row of the block.
struct BlockMaps {
  DisparityField field;
  ViewStack<float> confidence;
  DisparityField second{};  ///< As in Estimate.
};

/// Progress of an estimate in blocks.
struct BlockProgress {
  int pass = 0;                      ///< That is being made, from 0.
  int done = 0;                      ///< Of its rows or views, in their order.
  bool is_prepared = false;          ///< Whether the pass has found what all its blocks need.
  std::vector<double> facts{};       ///< What has been found that all further blocks have to know.
  double finding = 0;                ///< The largest that a block of the pass reported.
  double seconds = 0;                ///< Of all programs that worked on it.
  std::vector<std::string> notes{};  ///< For the estimate, of the blocks that are done.
  friend bool operator==(const BlockProgress&, const BlockProgress&) = default;
};

}  // namespace episcope
