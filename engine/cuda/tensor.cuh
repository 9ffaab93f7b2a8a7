// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/orientations.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <vector>

namespace episcope::cuda {

/// a·b + c·d
__device__ inline float two_products(float a, float b, float c, float d) {
  return __fmaf_rn(a, b, __fmul_rn(c, d));
}

/// 1/value but for the last bit or so: an approximation and one step by Newton.
__device__ inline float reciprocal(float value) {
  float guess;
  asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(guess) : "f"(value));
  return guess * __fmaf_rn(-value, guess, 2.0F);
}

/// A band of neighboring EPIs of one line of cameras. Lanes run along the EPI: x of horizontal
/// ones, y of vertical ones.
struct EpiBand {
  bool is_vertical = false;
  int line = 0;   ///< Camera row v of horizontal EPIs, camera column u of vertical ones.
  int views = 0;  ///< Along the EPI.
  int channels = 0;
  int length = 0;  ///< Lanes of a view.
  int first = 0;   ///< Image row or column of the first EPI of the band.
  int count = 0;   ///< EPIs of the band.
  int margin = 0;  ///< Lanes before and behind a view, whose ends are repeated there.
  int pitch = 0;   ///< Lanes from one EPI to the next.

  [[nodiscard]] __host__ __device__ int center() const { return views / 2; }
  /// Lanes from one view to the next.
  [[nodiscard]] __host__ __device__ int view_stride() const { return count * pitch; }
};

/// Derivatives of the samples smoothed along the EPI, for each lane of each EPI: x holds that along
/// the EPI, y the samples smoothed by Scharr's filter, for the derivative across. First all views
/// at whole pixels, `[channel][view][EPI][lane]`, then half a pixel further, where wanted, views r
/// at an odd distance from the center in place r/2. Fewer than 2³¹ in all.
struct DerivativePlanes {
  float2* values = nullptr;
  bool with_half = false;

  [[nodiscard]] static long size(const EpiBand& band, bool with_half) {
    const long views = band.views + (with_half ? (band.views + 1) / 2 : 0);
    return views * band.channels * band.count * band.pitch;
  }
  /// Where lane 0 of EPI 0 stands.
  [[nodiscard]] __device__ static int whole(const EpiBand& band, int channel, int view) {
    return (channel * band.views + view) * band.view_stride() + band.margin;
  }
  [[nodiscard]] __device__ static int half(const EpiBand& band, int channel, int view) {
    const int places = (band.views + 1) / 2;
    return (band.channels * band.views + channel * places + view / 2) * band.view_stride() +
           band.margin;
  }
};

/// An odd filter along the EPI.
struct LaneTaps {
  static constexpr int kMaxLaneTaps = kMaxTaps + 1;
  int count = 0;
  float values[kMaxLaneTaps] = {};
};
[[nodiscard]] LaneTaps lane_taps(const std::vector<float>& taps);

/// Fills the planes of a band. Samples that are not valid are NaN, and so is what they enter.
void differentiate(const DeviceSamples& samples, const EpiBand& band, const LaneTaps& smooth,
                   const DerivativePlanes& planes, const DeviceStream& stream);

/// Views whose tensors a block finds together.
inline constexpr int kViewsTogether = 9;

/// What is looked for in the EPIs of one direction, on the device.
struct TensorSearchFilters {
  const ViewFilter* smooth = nullptr;  ///< One for each view, likewise those below.
  const ViewFilter* derivative = nullptr;
  const ViewFilter* integrate = nullptr;
  int first_shear = 0, shear_step = 0, shear_count = 0;  ///< In half pixels.
  LaneTaps along, along_half;
  float contrast_energy = 0, noise_energy = 0;
  float limit = 0, min = 0, max = 0;
  bool eigenvector = false;

  /// Of their absolute values.
  [[nodiscard]] int largest_shear() const {
    const int last = first_shear + (shear_count - 1) * shear_step;
    return std::max(std::abs(first_shear), std::abs(last));
  }
  [[nodiscard]] bool has_half_shear() const { return ((first_shear | shear_step) & 1) != 0; }
};

/// Filters for nine views, by value: [of][from] along the views.
struct NineViewFilters {
  bool fits = false;  ///< Whether the views are nine, and the filters short enough.
  int reach = 0;      ///< Of the filters before products.
  float smooth[9][9] = {}, derivative[9][9] = {}, integrate[9][9] = {};
};
[[nodiscard]] NineViewFilters nine_view_filters(const ViewFilters& filters);

/// Lanes beyond both ends of a view that `find_best_tensors` reads.
[[nodiscard]] int needed_margin(const ViewFilters& filters, int largest_shear, int smooth_radius,
                                int integrate_radius);

/// Views [first, last) of an EPI whose tensors are wanted.
struct WantedViews {
  int first = 0, last = 0;
  [[nodiscard]] __host__ __device__ int count() const { return last - first; }
};

/// Writes the tensor of the most coherent shear, back in unsheared coordinates, to `best`:
/// `[wanted view][Jxx, Jxs, Jss][EPI][lane]`, 0 where no shear is accepted; see TensorKernel,
/// OrientationKernel::select and EigenvectorKernel.
void find_best_tensors(const EpiBand& band, const DerivativePlanes& planes,
                       const TensorSearchFilters& filters, const NineViewFilters& nine,
                       WantedViews wanted, float* best, const DeviceStream& stream);

/// The tensor of one ray, and the choice of the best of its shears.

struct Tensor {
  float xx, xs, ss;
};

__device__ inline void add(Tensor& sum, float weight, const Tensor& tensor) {
  sum.xx = __fmaf_rn(weight, tensor.xx, sum.xx);
  sum.xs = __fmaf_rn(weight, tensor.xs, sum.xs);
  sum.ss = __fmaf_rn(weight, tensor.ss, sum.ss);
}

/// Parts of a tensor lie `pitch` apart.
__device__ inline Tensor load(const float* from, long pitch) {
  return {from[0], from[pitch], from[2 * pitch]};
}
__device__ inline void store(const Tensor& tensor, float* to, long pitch) {
  to[0] = tensor.xx;
  to[pitch] = tensor.xs;
  to[2 * pitch] = tensor.ss;
}

/// Which tensors of a shear are accepted, and which is better; see OrientationKernel::select, and
/// for limits from 1 on EigenvectorKernel.
class ShearChoice {
 public:
  __device__ ShearChoice(const TensorSearchFilters& filters, int half_steps)
      : limit_(filters.limit),
        upright_(0.5F * static_cast<float>(half_steps)),
        noise_(filters.noise_energy),
        replaces_(filters.eigenvector),
        by_eigenvector_(filters.eigenvector || filters.limit >= 1) {
    if (by_eigenvector_) return;
    const float low = filters.min - upright_, high = filters.max - upright_;
    below_ = double_angle(low > -limit_ ? low : -limit_);
    above_ = double_angle(high < limit_ ? high : limit_);
  }

  /// Parts of the best, and its coherence squared, lie `pitch` apart.
  __device__ void keep_better(const Tensor& tensor, float* best, int pitch) const {
    if (by_eigenvector_) {
      keep_eigenvector(tensor, best, pitch);
    } else {
      keep_tensor(tensor, best, pitch);
    }
  }

  [[nodiscard]] __device__ bool by_eigenvector() const { return by_eigenvector_; }

 private:
  static constexpr float kTiny = 1e-20F;

  // |d| < 1 is at most b exactly if tan 2θ is.
  __device__ static float double_angle(float bound) { return 2 * bound / (1 - bound * bound); }

  // Back to unsheared coordinates: ∂s = ∂s' − k ∂x.
  __device__ void keep(const Tensor& tensor, float coherence, float* best, int pitch) const {
    const float xs = tensor.xs - upright_ * tensor.xx;
    store({tensor.xx, xs, tensor.ss - upright_ * (tensor.xs + xs)}, best, pitch);
    best[3 * pitch] = coherence;
  }

  __device__ void keep_tensor(const Tensor& tensor, float* best, int pitch) const {
    const float difference = tensor.xx - tensor.ss, twice = -2 * tensor.xs;
    if (!(difference > 0 && twice >= below_ * difference && twice <= above_ * difference)) return;
    const float whole = tensor.xx + tensor.ss + (noise_ + kTiny);
    const float coherence =
        two_products(difference, difference, twice, twice) * reciprocal(whole * whole);
    if (coherence > best[3 * pitch]) keep(tensor, coherence, best, pitch);
  }

  __device__ void keep_eigenvector(const Tensor& tensor, float* best, int pitch) const {
    const float difference = tensor.xx - tensor.ss, twice = -2 * tensor.xs;
    const float trace = tensor.xx + tensor.ss;
    const float root = sqrtf(two_products(difference, difference, twice, twice));
    const float disparity = twice / (difference + root + kTiny);
    const float ratio = root / (trace + (noise_ + kTiny));
    const float coherence = ratio * ratio;
    const bool is_better =
        disparity >= -limit_ && disparity <= limit_ && coherence > best[3 * pitch];
    if (!is_better) return;
    if (!replaces_) return keep(tensor, coherence, best, pitch);
    // Of eigenvalues (trace ± root)/2, the residual along d is the smaller one.
    const float large = 0.5F * (trace + root), xs = -disparity * large;
    keep({large, xs, two_products(0.5F, trace - root, -disparity, xs)}, coherence, best, pitch);
  }

  float limit_, upright_, noise_;
  bool replaces_, by_eigenvector_;
  float below_ = 0, above_ = 0;
};

/// Told that maps [first, first + count) will be done when what the stream was told so far is.
using MapsBegun = std::function<void(int first, int count)>;

/// `find_orientations` of what is on the device, on a stream, with the results, disparity and
/// coherence, left there.
/// `on_maps` hears of every map once. Throws DeviceFailure, Cancelled.
void find_orientations_on_device(const DeviceSamples& samples, const TensorSettings& settings,
                                 const MapPointers& maps, const DeviceStream& stream,
                                 const Progress& progress, const MapsBegun& on_maps = {});

/// What becomes of the estimates of a direction.
enum class Outcome {
  Stored,             ///< As they are.
  MergedIntoNothing,  ///< Merged into estimates of 0.
  MergedWithStored    ///< Those of vertical EPIs are in the maps, and are merged into these.
};

/// How results are written.
struct AverageSettings {
  LaneTaps across;
  float noise_energy = 0, min = 0, max = 0;
  Outcome outcome = Outcome::Stored;
  bool takes_winner = false;
  int fusion_power = 0;
  bool is_last = false;  ///< The direction is the last: what is done in the end is done.
  bool squares_coherence = false, clamps = false;
  float clamp_min = 0, clamp_max = 0;
};

/// EPIs of a band that have best tensors, and those of them whose results are wanted.
struct AveragedBand {
  EpiBand band;
  int first = 0, count = 0;  ///< Results: image rows or columns.
  int last_epi = 0;          ///< Of the image: its neighbors are repeated.
};

/// Averages tensors over neighboring EPIs, reads disparity and coherence off them and writes both
/// to the maps; see OrientationKernel::resolve and merge.
void average_tensors(const DeviceSamples& samples, const AveragedBand& band, WantedViews wanted,
                     const float* best, const AverageSettings& settings, const MapPointers& maps,
                     const DeviceStream& stream);

}  // namespace episcope::cuda
