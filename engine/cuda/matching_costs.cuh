// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/stereo_matcher.h"

namespace episcope::cuda {

/// Samples of views as floats in [0, 1], planes `[view][channel][y][x]`; NaN = not valid.
struct ViewPlanes {
  const float* planes = nullptr;
  GridShape grid;
  ViewIndex reference;
  bool is_cross_hair = false;  ///< Only views of the reference's row and column are there.
  int height = 0, width = 0, channels = 0;

  /// Where a view stands among those that are there.
  [[nodiscard]] __host__ __device__ int slot(ViewIndex view) const {
    if (!is_cross_hair) return view.v * grid.u + view.u;
    return view.v == reference.v ? view.u : grid.u + view.v;
  }
  [[nodiscard]] __host__ __device__ int slots() const {
    return is_cross_hair ? grid.u + grid.v : grid.v * grid.u;
  }
  [[nodiscard]] __host__ __device__ ViewIndex view_of(int slot) const {
    if (!is_cross_hair) return {slot / grid.u, slot % grid.u};
    return slot < grid.u ? ViewIndex{reference.v, slot} : ViewIndex{slot - grid.u, reference.u};
  }
  [[nodiscard]] __host__ __device__ long plane_size() const {
    return static_cast<long>(height) * width;
  }
  [[nodiscard]] __device__ const float* of(ViewIndex view, int channel) const {
    return planes + (static_cast<long>(slot(view)) * channels + channel) * plane_size();
  }
};

/// Fills the planes of `views`, whose shape is set.
[[nodiscard]] DeviceArray<float> make_view_planes(const DeviceSamples& samples,
                                                  const ViewPlanes& views,
                                                  const DeviceStream& stream);

/// surfaces_in_views of the reference view's `disparity` `[y][x]`, in the slots of `views`,
/// `[slot][y][x]`.
[[nodiscard]] DeviceArray<float> cast_surfaces(const ViewPlanes& views, const float* disparity,
                                               const DeviceStream& stream);

/// Labels that a block of `compute_costs` works on together.
inline constexpr int kGroupLabels = 4;

/// The shifts of such a group along one axis: of their first taps, and the pixels that any sees.
struct alignas(16) GroupShift {
  int low = 0, high = 0;
  int first = 0, last = 0;

  [[nodiscard]] __device__ bool sees(int begin, int end) const {
    return first < end && last > begin;
  }
};

/// Which samples count, and how much at most, pixel by pixel.
struct Visibility {
  const float* nearest = nullptr;  ///< Nearest surface `[slot][y][x]`, px; null = none is known.
  float tolerance = 0, softness = 1;
  const float* caps = nullptr;  ///< `[y][x]`; null = the same everywhere.

  [[nodiscard]] __host__ __device__ bool weighs() const {
    return nearest != nullptr || caps != nullptr;
  }
};

/// StereoMatching for kernels.
struct MatchingTables {
  ViewPlanes planes;
  const MatchedView* views = nullptr;
  int view_count = 0;
  int labels = 0;
  const MatchShift* rows = nullptr;  ///< `[way][label]`
  const MatchShift* columns = nullptr;
  const GroupShift* row_groups = nullptr;  ///< `[way][group]`
  const GroupShift* column_groups = nullptr;
  const float* rows_seen = nullptr;     ///< `[label][y]`; null = samples are counted.
  const float* columns_seen = nullptr;  ///< `[label][x]`
  bool is_cross_hair = false;
  float cap = 0, worst = 0;
  const float* noise = nullptr;  ///< `[y][x]`, null = none.
  Visibility visibility;
  const float* disparities = nullptr;  ///< Of the labels.

  /// Views that see a pixel, where samples are not counted.
  [[nodiscard]] __device__ float views_seen(int label, int y, int x) const {
    const float down = rows_seen[static_cast<long>(label) * planes.height + y];
    const float along = columns_seen[static_cast<long>(label) * planes.width + x];
    return is_cross_hair ? along + down - 2 : along * down - 1;
  }
};

/// StereoMatching in the memory of the device.
class DeviceMatching {
 public:
  DeviceMatching(const StereoMatching& matching, const ViewPlanes& planes, const float* noise,
                 const DeviceStream& stream, const Visibility& visibility = {});

  [[nodiscard]] const MatchingTables& tables() const { return tables_; }

 private:
  DeviceArray<MatchedView> views_;
  DeviceArray<MatchShift> rows_, columns_;
  DeviceArray<GroupShift> row_groups_, column_groups_;
  DeviceArray<float> rows_seen_, columns_seen_, disparities_;
  MatchingTables tables_;
};

/// √ of a value ≥ 0 that is no denormal, correctly rounded but for very few; NaN stays NaN.
__device__ inline float quick_root(float value) {
  const float inverse = rsqrtf(value);
  const float root = value * inverse;
  const float exact = fmaf(fmaf(-root, root, value), 0.5F * inverse, root);
  return value == 0 ? 0.0F : exact;
}

/// Costs of rows [first, first + rows) of the reference view, `[row][label][x]`: MatchingCostRows.
void compute_costs(const MatchingTables& tables, int first, int rows, float* costs,
                   const DeviceStream& stream);

/// The least cost of every pixel of some rows of the reference view, at most `most`, `[row][x]`;
/// infinite where `samples` say that the pixel is not valid.
void find_least_costs(const MatchingTables& tables, const DeviceSamples& samples, const int* rows,
                      int row_count, float most, float* least, const DeviceStream& stream);

/// A GuideImage on the device: planes `[plane][y][x]`, in its order.
struct DeviceGuide {
  const float* planes = nullptr;
  int radius = 0;
  int height = 0, width = 0, channels = 0;

  [[nodiscard]] __device__ const float* plane(int i) const {
    return planes + static_cast<long>(i) * height * width;
  }
};

/// The planes of a guide.
[[nodiscard]] DeviceArray<float> make_guide_planes(const DeviceSamples& samples, ViewIndex view,
                                                   int radius, double regularization,
                                                   const DeviceStream& stream);

/// Rows of costs `[row][label][x]`: row 0 is row `first` of the guide.
struct CostRows {
  int first = 0;
  int rows = 0;
  int labels = 0;
};

/// Filters every label: `filtered`, rows `to`, from `costs`, rows `from`, which reach 2·radius rows
/// farther on both sides, as far as the image does.
void filter_costs(const DeviceGuide& guide, const CostRows& from, const float* costs,
                  const CostRows& to, float* filtered, const DeviceStream& stream);

/// The position of the minimum between labels, as `sub_label_offset`.
__device__ inline float offset_between(float before, float here, float after,
                                       LabelPlaces::Refinement refinement) {
  using enum LabelPlaces::Refinement;
  const float bend =
      refinement == Parabola ? before - 2 * here + after : fmaxf(before, after) - here;
  if (refinement == None || !(bend > 0)) return 0;
  return fminf(fmaxf(0.5F * (before - after) / bend, -0.5F), 0.5F);
}

/// Disparity and confidence `[row][x]` of rows of costs `[row][label][x]`.
void choose_winners(VolumeView<const float> costs, const LabelPlaces& places, float* disparity,
                    float* confidence, const DeviceStream& stream);

}  // namespace episcope::cuda
