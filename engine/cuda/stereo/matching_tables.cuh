// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/stereo/stereo_matcher.h"

namespace episcope::cuda {

/// StereoMatching for kernels.
struct MatchingTables {
  DeviceSamples samples;
  ViewIndex reference;
  const MatchedView* views = nullptr;
  int view_count = 0;
  int labels = 0;
  const MatchShift* rows = nullptr;  ///< `[way][label]`
  const MatchShift* columns = nullptr;
  const float* rows_seen = nullptr;     ///< `[label][y]`; null = samples are counted.
  const float* columns_seen = nullptr;  ///< `[label][x]`
  bool is_cross_hair = false;
  float cap = 0, worst = 0;
  const float* noise = nullptr;  ///< `[y][x]`, null = none.

  /// Views that see a pixel, where samples are not counted.
  [[nodiscard]] __device__ float views_seen(int label, int y, int x) const {
    const float down = rows_seen[static_cast<long>(label) * samples.height + y];
    const float along = columns_seen[static_cast<long>(label) * samples.width + x];
    return is_cross_hair ? along + down - 2 : along * down - 1;
  }
};

/// StereoMatching in the memory of the device.
class DeviceMatching {
 public:
  DeviceMatching(const StereoMatching& matching, const DeviceSamples& samples, ViewIndex reference,
                 const float* noise, const DeviceStream& stream, const Progress& progress);

  [[nodiscard]] const MatchingTables& tables() const { return tables_; }

 private:
  DeviceArray<MatchedView> views_;
  DeviceArray<MatchShift> rows_, columns_;
  DeviceArray<float> rows_seen_, columns_seen_;
  MatchingTables tables_;
};

/// Costs of rows [first, first + rows) of the reference view, `[row][label][x]`: MatchingCostRows.
void compute_costs(const MatchingTables& tables, int first, int rows, float* costs,
                   const DeviceStream& stream);

/// The least cost of every pixel of some rows, at most `most`, `[row][x]`.
void find_least_costs(const MatchingTables& tables, const int* rows, int row_count, float most,
                      float* least, const DeviceStream& stream);

}  // namespace episcope::cuda
