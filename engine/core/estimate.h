// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace episcope {

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
  int border_px = 0;  ///< Pixels at each side of the views that foreign maps lack; not judged.
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
