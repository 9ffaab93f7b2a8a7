// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tv_l2/tv_l2_level.cuh"

#include <cstddef>
#include <vector>

namespace episcope::cuda {

/// The levels of a solver for `views` images of one size, and what differs from view to view.
class TvL2Grids {
 public:
  /// Throws DeviceFailure if there is too little memory.
  TvL2Grids(int height, int width, int views, const DeviceStream& stream);

  /// Bytes that one view takes.
  [[nodiscard]] static std::size_t bytes_per_view(int height, int width);

  [[nodiscard]] const TvL2Levels& levels() const { return levels_; }
  void swap_moved(int k) { levels_.level[k].swap_moved(); }
  [[nodiscard]] int views() const { return view_count_; }
  [[nodiscard]] TvL2View* of_views() { return views_.data(); }
  /// Copies what differs from view to view to the device.
  void set_views(const std::vector<TvL2View>& views, const DeviceStream& stream);

 private:
  int view_count_;
  TvL2Levels levels_;
  DeviceArray<float> memory_;
  DeviceArray<TvL2View> views_;
};

}  // namespace episcope::cuda
