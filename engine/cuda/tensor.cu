// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tensor.cuh"

#include "engine/cuda/device.cuh"

#include <algorithm>

// The part of an EPI that one block searches, and the coordinates in which a disparity stands
// upright.

namespace episcope::cuda {
namespace {

constexpr int kSearchLanes = 128;    // Of a view, for each block.
constexpr int kSearchThreads = 160;  // With the lanes that shears and filters reach.

struct SearchJob {
  EpiBand band;
  DerivativePlanes planes;
  TensorSearchFilters filters;
  WantedViews wanted;
  float* best;
  int tensor_pitch;  // Lanes from part to part of the tensors of a view.
};

// What a block searches.
struct SearchPlace {
  int epi;    // Of the band.
  int first;  // Lane.
  int lanes;
  WantedViews views;
};

__device__ inline SearchPlace search_place(const SearchJob& job) {
  const int first = static_cast<int>(blockIdx.x) * kSearchLanes;
  const int view = job.wanted.first + static_cast<int>(blockIdx.z) * kViewsTogether;
  return {static_cast<int>(blockIdx.y),
          first,
          min(kSearchLanes, job.band.length - first),
          {view, min(view + kViewsTogether, job.wanted.last)}};
}

// One shear: disparity k stands upright if view r is read at x − k·(r − center).
struct ShearFrame {
  int half_steps, center;
  [[nodiscard]] __device__ int steps(int view) const { return half_steps * (view - center); }
  // The lane of sheared coordinates at which lane 0 of a view stands, or half a pixel before it.
  [[nodiscard]] __device__ int start(int view) const { return steps(view) >> 1; }
  [[nodiscard]] __device__ bool is_half(int view) const { return (steps(view) & 1) != 0; }
  // Where a view is read for lane 0 of sheared coordinates.
  [[nodiscard]] __device__ int source(int view) const { return -steps(view) >> 1; }
};

// Lanes of sheared coordinates from `begin` on that the wanted views take in.
struct ShearWindow {
  int begin, count;
};

__device__ inline ShearWindow shear_window(const SearchJob& job, const SearchPlace& place,
                                           const ShearFrame& shear) {
  const int a = shear.start(place.views.first), b = shear.start(place.views.last - 1);
  const int taps = job.filters.along.count;
  return {place.first + min(a, b) - taps / 2, place.lanes + abs(a - b) + taps};
}

// Tensors of a block in sheared coordinates, `[view][part][lane]`: place 0 of each view is the
// first lane that filters along the EPI take in for its first lane.
struct ShearedTensors {
  float* values;
  int pitch;
  [[nodiscard]] __device__ float* of(int view) const { return values + 3 * view * pitch; }
};

// Tensors at one lane of sheared coordinates: derivatives across the views, products, and their
// integration along the views.

// Where the derivatives of a view stand for lane 0 of sheared coordinates.
__device__ inline int derivatives_at(const SearchJob& job, const ShearFrame& shear, int epi,
                                     int channel, int view) {
  const EpiBand& band = job.band;
  const int plane = shear.is_half(view) ? DerivativePlanes::half(band, channel, view)
                                        : DerivativePlanes::whole(band, channel, view);
  return plane + epi * band.pitch + shear.source(view);
}

// Tones strong gradients down; what an invalid sample entered counts nothing.
__device__ inline Tensor weighted(Tensor product, float contrast) {
  const float weight = contrast * reciprocal(product.xx + product.ss + contrast);
  const float xx = weight * product.xx, xs = weight * product.xs, ss = weight * product.ss;
  return {xx == xx ? xx : 0, xs == xs ? xs : 0, ss == ss ? ss : 0};
}

__device__ inline void add_square(Tensor& product, float2 gradient) {
  product.xx = __fmaf_rn(gradient.x, gradient.x, product.xx);
  product.xs = __fmaf_rn(gradient.x, gradient.y, product.xs);
  product.ss = __fmaf_rn(gradient.y, gradient.y, product.ss);
}

// The gradient at a view whose filters are symmetric, with five taps; pairs are added first.
// `in` are the derivatives of the five views.
__device__ inline float2 inner_gradient(const float* smooth, const float* derivative,
                                        const float2& a, const float2& b, const float2& c,
                                        const float2& d, const float2& e) {
  float along = two_products(smooth[2], c.x, smooth[1], b.x + d.x);
  along = __fmaf_rn(smooth[0], a.x + e.x, along);
  return {along, two_products(derivative[1], b.y - d.y, derivative[0], a.y - e.y)};
}

// Of nine views, for one of them.
template <int kReach>
__device__ float2 nine_view_gradient(const NineViewFilters& filters, const float2 (&in)[9],
                                     int view) {
  const auto& smooth = filters.smooth[view];
  const auto& derivative = filters.derivative[view];
  if (kReach == 2 && view >= 2 && view < 7) {
    return inner_gradient(smooth + view - 2, derivative + view - 2, in[view - 2], in[view - 1],
                          in[view], in[view + 1], in[view + 2]);
  }
  float2 g{0, 0};
#pragma unroll
  for (int i = 0; i < 9; ++i) {
    if (i < view - kReach || i > view + kReach) continue;
    g.x = __fmaf_rn(smooth[i], in[i].x, g.x);
    g.y = __fmaf_rn(derivative[i], in[i].y, g.y);
  }
  return g;
}

// Writes the tensors of one lane: place `lane` of the first wanted view.
class TensorWriter {
 public:
  __device__ TensorWriter(const SearchJob& job, const ShearFrame& shear, const SearchPlace& place,
                          const ShearedTensors& tensors, int lane)
      : shear_(shear),
        first_(place.views.first),
        least_(min(shear.start(place.views.first), shear.start(place.views.last - 1))),
        tensors_(tensors),
        lane_(lane),
        count_(place.lanes + job.filters.along.count) {}

  __device__ void write(int view, const Tensor& tensor) const {
    const int at = lane_ - (shear_.start(view) - least_);
    if (at >= 0 && at < count_) store(tensor, tensors_.of(view - first_) + at, tensors_.pitch);
  }

 private:
  const ShearFrame& shear_;
  int first_, least_;
  const ShearedTensors& tensors_;
  int lane_, count_;
};

// Integrates at lane `at` for nine views.
template <int kChannels, int kReach>
__device__ void integrate_nine_views(const SearchJob& job, const NineViewFilters& filters,
                                     const ShearFrame& shear, const SearchPlace& place, int at,
                                     const TensorWriter& writer) {
  Tensor products[9] = {};
#pragma unroll
  for (int channel = 0; channel < kChannels; ++channel) {
    float2 in[9];
#pragma unroll
    for (int view = 0; view < 9; ++view) {
      in[view] = job.planes.values[derivatives_at(job, shear, place.epi, channel, view) + at];
    }
#pragma unroll
    for (int view = 0; view < 9; ++view) {
      add_square(products[view], nine_view_gradient<kReach>(filters, in, view));
    }
  }
#pragma unroll
  for (Tensor& product : products) product = weighted(product, job.filters.contrast_energy);
#pragma unroll
  for (int view = 0; view < 9; ++view) {
    if (view < place.views.first || view >= place.views.last) continue;
    Tensor sum{0, 0, 0};
#pragma unroll
    for (int i = 0; i < 9; ++i) {
      if (i < view - 4 || i > view + 4) continue;
      add(sum, filters.integrate[view][i], products[i]);
    }
    writer.write(view, sum);
  }
}

__device__ inline bool is_inner(const ViewFilter& smooth, const ViewFilter& derivative) {
  const float *const a = smooth.taps, *const b = derivative.taps;
  return smooth.count == 5 && derivative.count == 5 && a[0] == a[4] && a[1] == a[3] && b[2] == 0 &&
         b[0] == -b[4] && b[1] == -b[3];
}

// The gradient of any view. Taps of zero are left out: what they would read may be invalid.
__device__ inline float2 gradient(const SearchJob& job, const ShearFrame& shear,
                                  const SearchPlace& place, int channel, int view, int at) {
  const ViewFilter& smooth = job.filters.smooth[view];
  const ViewFilter& derivative = job.filters.derivative[view];
  const auto in = [&](int of) {
    return job.planes.values[derivatives_at(job, shear, place.epi, channel, of) + at];
  };
  if (is_inner(smooth, derivative)) {
    return inner_gradient(smooth.taps, derivative.taps, in(view - 2), in(view - 1), in(view),
                          in(view + 1), in(view + 2));
  }
  float2 g{0, 0};
  for (int i = 0; i < smooth.count; ++i) {
    if (smooth.taps[i] != 0) g.x = __fmaf_rn(smooth.taps[i], in(smooth.first + i).x, g.x);
  }
  for (int i = 0; i < derivative.count; ++i) {
    const float tap = derivative.taps[i];
    if (tap != 0) g.y = __fmaf_rn(tap, in(derivative.first + i).y, g.y);
  }
  return g;
}

// Views whose products `integrate_views` keeps, at most.
constexpr int kProductViews = kViewsTogether + kMaxTaps - 1;

// The same for any number of views and any filters. `products` has a column for each thread.
__device__ inline void integrate_views(const SearchJob& job, const ShearFrame& shear,
                                       const SearchPlace& place, int at, float* products,
                                       const TensorWriter& writer) {
  const ViewFilter& first_filter = job.filters.integrate[place.views.first];
  const ViewFilter& last_filter = job.filters.integrate[place.views.last - 1];
  const int first = first_filter.first, last = last_filter.first + last_filter.count;
  float* const column = products + threadIdx.x;
  for (int view = first; view < last; ++view) {
    Tensor product{0, 0, 0};
    for (int channel = 0; channel < job.band.channels; ++channel) {
      add_square(product, gradient(job, shear, place, channel, view, at));
    }
    store(weighted(product, job.filters.contrast_energy),
          column + 3 * (view - first) * kSearchThreads, kSearchThreads);
  }
  for (int view = place.views.first; view < place.views.last; ++view) {
    const ViewFilter& filter = job.filters.integrate[view];
    Tensor sum{0, 0, 0};
    for (int i = 0; i < filter.count; ++i) {
      add(sum, filter.taps[i],
          load(column + 3 * (filter.first + i - first) * kSearchThreads, kSearchThreads));
    }
    writer.write(view, sum);
  }
}

constexpr int kTileEpis = 16;
constexpr int kTileLanes = 64;
constexpr int kPlaneThreads = 256;
// Lanes that derivatives reach, half a pixel further ones included.
constexpr int kReach = 3;
constexpr int kMaxRadius = 6;
constexpr int kWide = kTileLanes + 2 * (kReach + kMaxRadius);
constexpr int kWidePitch = kWide + 1;  // odd, for writes across lanes

struct Tile {
  int epi, lane;  // the first of each: an EPI of the band, a lane of a view
  int view;
};

// A sample of lane `lane` of an EPI, ends repeated; NaN if it is not valid.
template <bool kVertical>
__device__ float sample_at(const DeviceSamples& samples, const EpiBand& band, const Tile& tile,
                           int epi, int lane, int channel) {
  const int along = min(max(lane, 0), band.length - 1);
  const int across = band.first + min(tile.epi + epi, band.count - 1);
  const long pixel = kVertical ? samples.pixel(tile.view, band.line, along, across)
                               : samples.pixel(band.line, tile.view, across, along);
  if (samples.valid && samples.valid[pixel] == 0) return nanf("");
  return samples.at(pixel, channel);
}

template <bool kVertical>
__device__ void read_tile(const DeviceSamples& samples, const EpiBand& band, const Tile& tile,
                          int channel, int reach, float (&to)[kTileEpis][kWidePitch]) {
  const int wide = kTileLanes + 2 * reach;
  for (int i = threadIdx.x; i < kTileEpis * wide; i += kPlaneThreads) {
    // Neighboring threads read neighboring pixels of the view.
    const int epi = kVertical ? i % kTileEpis : i / wide;
    const int lane = kVertical ? i / kTileEpis : i % wide;
    to[epi][lane] =
        sample_at<kVertical>(samples, band, tile, epi, tile.lane + lane - reach, channel);
  }
}

// Of three neighboring lanes: central difference, and Scharr's smoothing.
__device__ float2 derivatives(float left, float here, float right) {
  return {0.5F * (right - left), two_products(3.0F / 16, left + right, 10.0F / 16, here)};
}

// Between in[0] and in[1].
__device__ float half_pixel(const float* in) {
  return two_products(9.0F / 16, in[0] + in[1], -1.0F / 16, in[-1] + in[2]);
}

__device__ float smoothed(const float* in, const LaneTaps& taps) {
  const int radius = taps.count / 2;
  const float* const middle = taps.values + radius;
  if (radius == 0) return middle[0] * in[0];
  float sum = two_products(middle[0], in[0], middle[1], in[1]);
  sum = __fmaf_rn(middle[-1], in[-1], sum);
  for (int i = 2; i <= radius; ++i) {
    sum = __fmaf_rn(middle[i], in[i], sum);
    sum = __fmaf_rn(middle[-i], in[-i], sum);
  }
  return sum;
}

template <bool kVertical>
__global__ __launch_bounds__(kPlaneThreads) void fill_planes(DeviceSamples samples, EpiBand band,
                                                             LaneTaps taps,
                                                             DerivativePlanes planes) {
  __shared__ float raw[kTileEpis][kWidePitch];
  __shared__ float smooth[kTileEpis][kWidePitch];
  const int view = static_cast<int>(blockIdx.z) / band.channels;
  const int channel = static_cast<int>(blockIdx.z) % band.channels;
  const Tile tile{static_cast<int>(blockIdx.y) * kTileEpis,
                  static_cast<int>(blockIdx.x) * kTileLanes - band.margin, view};
  const int radius = taps.count / 2;
  read_tile<kVertical>(samples, band, tile, channel, kReach + radius, raw);
  __syncthreads();
  constexpr int kSmoothed = kTileLanes + 2 * kReach;
  for (int i = threadIdx.x; i < kTileEpis * kSmoothed; i += kPlaneThreads) {
    const int epi = i / kSmoothed, lane = i % kSmoothed;
    smooth[epi][lane] = smoothed(&raw[epi][lane + radius], taps);
  }
  __syncthreads();
  const bool with_half = planes.with_half && ((view - band.center()) & 1) != 0;
  for (int i = threadIdx.x; i < kTileEpis * kTileLanes; i += kPlaneThreads) {
    const int epi = i / kTileLanes, lane = i % kTileLanes;
    const int at = tile.lane + lane;
    if (tile.epi + epi >= band.count || at + band.margin >= band.pitch) continue;
    const int from = (tile.epi + epi) * band.pitch + at;
    const float* const here = &smooth[epi][lane + kReach];
    planes.values[DerivativePlanes::whole(band, channel, view) + from] =
        derivatives(here[-1], here[0], here[1]);
    if (!with_half) continue;
    planes.values[DerivativePlanes::half(band, channel, view) + from] =
        derivatives(half_pixel(here - 1), half_pixel(here), half_pixel(here + 1));
  }
}

}  // namespace

LaneTaps lane_taps(const std::vector<float>& taps) {
  LaneTaps lane;
  lane.count = static_cast<int>(taps.size());
  std::copy(taps.begin(), taps.end(), lane.values);
  return lane;
}

void differentiate(const DeviceSamples& samples, const EpiBand& band, const LaneTaps& smooth,
                   const DerivativePlanes& planes, const DeviceStream& stream) {
  const dim3 grid(blocks_for(band.pitch, kTileLanes), blocks_for(band.count, kTileEpis),
                  static_cast<unsigned>(band.views * band.channels));
  const double samples_read =
      static_cast<double>(band.views) * band.channels * band.count * band.length;
  const int sample_bytes = samples.type == SampleType::UInt8    ? 1
                           : samples.type == SampleType::UInt16 ? 2
                                                                : 4;
  const double written = samples_read / band.length * band.pitch * (planes.with_half ? 1.5 : 1);
  const KernelWork work{band.is_vertical ? "derivatives, vertical" : "derivatives, horizontal",
                        samples_read * sample_bytes + written * sizeof(float2),
                        samples_read * (2.0 * smooth.count + 6) + (planes.with_half ? 12 : 0)};
  launch(stream, work, [&] {
    const auto kernel = band.is_vertical ? fill_planes<true> : fill_planes<false>;
    kernel<<<grid, kPlaneThreads, 0, stream.get()>>>(samples, band, smooth, planes);
  });
}

namespace {

constexpr int kThreads = kSearchThreads;
constexpr int kLanes = kSearchLanes;
// Neighboring lanes that a thread integrates together. In shared memory those of a block are
// ordered so that threads write side by side.
constexpr int kTogether = 4;
constexpr int kQuads = kLanes / kTogether;

__device__ int place_of_lane(int lane) {
  return lane % kTogether * kQuads + lane / kTogether;
}

// Σ taps·in of `count` taps, symmetric ones: samples of a pair are added first. In the same order
// as OrientationKernel::select, or one after the other as in EigenvectorKernel.
template <int kCount>
__device__ float integrated(const float* in, const float* taps, int count, bool one_by_one) {
  if (kCount > 0) count = kCount;
  if (count == 1) return taps[0] * in[0];
  if (one_by_one) {
    float sum = taps[0] * in[0];
#pragma unroll
    for (int i = 1; i < count; ++i) sum = __fmaf_rn(taps[i], in[i], sum);
    return sum;
  }
  const auto pair = [&](int i) { return i < count - 1 - i ? in[i] + in[count - 1 - i] : in[i]; };
  if (count == 2) return taps[0] * pair(0);
  float sum = two_products(taps[0], pair(0), taps[1], pair(1));
#pragma unroll
  for (int i = 2; i < (count + 1) / 2; ++i) sum = __fmaf_rn(taps[i], pair(i), sum);
  return sum;
}

// What a thread integrates: kTogether lanes of one view and what their filters take in besides.
template <int kTaps>
__device__ void choose_lanes(const ShearChoice& choice, const LaneTaps& taps, const float* from,
                             int pitch, int lanes, float* best) {
  constexpr int kVectors = kTaps > 0 ? (kTogether + kTaps + 2) / 4 : 1;
  float in[3][4 * kVectors];
  if (kTaps > 0) {
#pragma unroll
    for (int part = 0; part < 3; ++part) {
      const auto* const vectors = reinterpret_cast<const float4*>(from + part * pitch);
#pragma unroll
      for (int i = 0; i < kVectors; ++i) {
        const float4 four = vectors[i];
        in[part][4 * i] = four.x;
        in[part][4 * i + 1] = four.y;
        in[part][4 * i + 2] = four.z;
        in[part][4 * i + 3] = four.w;
      }
    }
  }
#pragma unroll
  for (int lane = 0; lane < kTogether; ++lane) {
    if (lane >= lanes) return;
    float sums[3];
#pragma unroll
    for (int part = 0; part < 3; ++part) {
      const float* const first =
          kTaps > 0 ? &in[part][kTaps > 0 ? lane : 0] : from + part * pitch + lane;
      sums[part] = integrated<kTaps>(first, taps.values, taps.count, choice.by_eigenvector());
    }
    choice.keep_better({sums[0], sums[1], sums[2]}, best + lane * kQuads, kLanes);
  }
}

// Integrates along the EPI, and keeps tensors that are more coherent than the best so far.
// kTaps: of the filter at whole pixels, 0 = any.
template <int kTaps>
__device__ void choose(const SearchJob& job, const ShearFrame& shear, const SearchPlace& place,
                       const ShearedTensors& tensors, float* best) {
  const TensorSearchFilters& filters = job.filters;
  const ShearChoice choice(filters, shear.half_steps);
  for (int i = threadIdx.x; i < place.views.count() * kQuads; i += kThreads) {
    const int view = i / kQuads, quad = i % kQuads;
    const int lanes = place.lanes - kTogether * quad;
    const float* const from = tensors.of(view) + kTogether * quad;
    float* const to = best + 4 * view * kLanes + quad;
    if (shear.is_half(place.views.first + view)) {
      choose_lanes<kTaps == 0 ? 0 : kTaps + 1>(choice, filters.along_half, from, tensors.pitch,
                                               lanes, to);
    } else {
      choose_lanes<kTaps>(choice, filters.along, from, tensors.pitch, lanes, to);
    }
  }
}

__device__ void write_best(const SearchJob& job, const SearchPlace& place, const float* best) {
  const EpiBand& band = job.band;
  for (int i = threadIdx.x; i < 3 * place.views.count() * kLanes; i += kThreads) {
    const int lane = i % kLanes, part = i / kLanes % 3, view = i / (3 * kLanes);
    if (lane >= place.lanes) continue;
    const long of = place.views.first - job.wanted.first + view;
    job.best[((3 * of + part) * band.count + place.epi) * band.length + place.first + lane] =
        best[(4 * view + part) * kLanes + place_of_lane(lane)];
  }
}

// kChannels: the views are nine; 0 = any number of channels and views.
template <int kChannels, int kReach, int kTaps>
__global__ __launch_bounds__(kThreads, kChannels > 0 ? 4 : 1) void search(
    const __grid_constant__ SearchJob job, const __grid_constant__ NineViewFilters nine) {
  extern __shared__ float4 shared[];
  const ShearedTensors tensors{reinterpret_cast<float*>(shared), job.tensor_pitch};
  float* const best = tensors.of(kViewsTogether);
  float* const products = best + 4 * kViewsTogether * kLanes;
  const SearchPlace place = search_place(job);
  for (int i = threadIdx.x; i < 4 * kViewsTogether * kLanes; i += kThreads) best[i] = 0;
  for (int s = 0; s < job.filters.shear_count; ++s) {
    const ShearFrame shear{job.filters.first_shear + s * job.filters.shear_step, job.band.center()};
    const ShearWindow window = shear_window(job, place, shear);
    __syncthreads();
    for (int lane = threadIdx.x; lane < window.count; lane += kThreads) {
      const TensorWriter writer(job, shear, place, tensors, lane);
      if constexpr (kChannels > 0) {
        integrate_nine_views<kChannels, kReach>(job, nine, shear, place, window.begin + lane,
                                                writer);
      } else {
        integrate_views(job, shear, place, window.begin + lane, products, writer);
      }
    }
    __syncthreads();
    choose<kTaps>(job, shear, place, tensors, best);
  }
  __syncthreads();
  write_best(job, place, best);
}

using Search = void (*)(const SearchJob, const NineViewFilters);

Search search_of(const SearchJob& job, const NineViewFilters& nine) {
  if (!nine.fits) return search<0, 0, 0>;
  const bool usual = job.filters.along.count == 5;
  if (job.band.channels == 1) {
    if (!usual) return nine.reach == 2 ? search<1, 2, 0> : search<1, 3, 0>;
    return nine.reach == 2 ? search<1, 2, 5> : search<1, 3, 5>;
  }
  if (!usual) return nine.reach == 2 ? search<3, 2, 0> : search<3, 3, 0>;
  return nine.reach == 2 ? search<3, 2, 5> : search<3, 3, 5>;
}

int largest_tap_count(const std::vector<ViewFilter>& filters) {
  int largest = 0;
  for (const ViewFilter& filter : filters) largest = std::max(largest, filter.count);
  return largest;
}

KernelWork work_of(const SearchJob& job) {
  const EpiBand& band = job.band;
  const double rays = static_cast<double>(band.count) * band.length;
  const double wanted = rays * job.wanted.count();
  const double planes = rays * band.views * band.channels * (job.planes.with_half ? 1.5 : 1);
  // At the usual scales: both derivatives, products, both integrations and the choice.
  const double operations = band.channels * 24 + 10 + 54 + 6 * job.filters.along.count + 25;
  return {band.is_vertical ? "best tensors, vertical" : "best tensors, horizontal",
          planes * sizeof(float2) + 3 * wanted * sizeof(float),
          wanted * job.filters.shear_count * operations};
}

}  // namespace

NineViewFilters nine_view_filters(const ViewFilters& filters) {
  NineViewFilters nine;
  if (filters.views() != 9) return nine;
  const auto fill = [](const std::vector<ViewFilter>& from, float(&to)[9][9]) {
    for (int view = 0; view < 9; ++view) {
      for (int i = 0; i < from[view].count; ++i)
        to[view][from[view].first + i] = from[view].taps[i];
    }
  };
  fill(filters.smooth, nine.smooth);
  fill(filters.derivative, nine.derivative);
  fill(filters.integrate, nine.integrate);
  nine.reach = largest_tap_count(filters.smooth) / 2;
  nine.fits = (nine.reach == 2 || nine.reach == 3) && largest_tap_count(filters.integrate) <= 9;
  return nine;
}

int needed_margin(const ViewFilters& filters, int largest_shear, int smooth_radius,
                  int integrate_radius) {
  constexpr int kDerivatives = 4;
  const int views = std::min(kViewsTogether, filters.views()) - 1 + filters.reach;
  return (views * largest_shear + 1) / 2 + integrate_radius + smooth_radius + kDerivatives;
}

void find_best_tensors(const EpiBand& band, const DerivativePlanes& planes,
                       const TensorSearchFilters& filters, const NineViewFilters& nine,
                       WantedViews wanted, float* best, const DeviceStream& stream) {
  // What a row of four lanes reads beyond its view is not used, but must be there.
  constexpr int kUnit = 4;
  const int pitch = (kLanes + filters.along_half.count + kUnit) / kUnit * kUnit;
  const SearchJob job{band, planes, filters, wanted, best, pitch};
  const int products = nine.fits ? 0 : 3 * kProductViews * kThreads;
  const auto shared = (kViewsTogether * (3 * pitch + 4 * kLanes) + products) * sizeof(float);
  const Search kernel = search_of(job, nine);
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(shared)));
  const dim3 grid(blocks_for(band.length, kLanes), static_cast<unsigned>(band.count),
                  blocks_for(wanted.count(), kViewsTogether));
  launch(stream, work_of(job),
         [&] { kernel<<<grid, kThreads, shared, stream.get()>>>(job, nine); });
}

}  // namespace episcope::cuda
