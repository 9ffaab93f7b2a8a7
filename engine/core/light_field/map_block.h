// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_rectangle.h"
#include "engine/core/light_field/layered_disparity.h"

#include <string>
#include <vector>

namespace episcope {

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

/// What an estimate has of a block: maps of its views, which are addressed by their place in the
/// grid, and whose row 0 is the first of the block.
struct BlockMaps {
  DisparityField field;
  ViewStack<float> confidence;
  LayeredDisparity layered{};            ///< Empty unless the method estimates two layers.
  std::vector<ViewStack<float>> kept{};  ///< For later passes, no part of the result.
};

/// How far an estimate in blocks has come.
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
