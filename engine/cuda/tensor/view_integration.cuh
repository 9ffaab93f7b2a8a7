// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Tensors at one lane of sheared coordinates: derivatives across the views, products, and their
/// integration along the views.

#include "engine/cuda/tensor/cpu_order.cuh"
#include "engine/cuda/tensor/sheared_epi.cuh"
#include "engine/cuda/tensor/tensor_choice.cuh"

namespace episcope::cuda {

/// Where the derivatives of a view stand for lane 0 of sheared coordinates.
__device__ inline int derivatives_at(const SearchJob& job, const ShearFrame& shear, int epi,
                                     int channel, int view) {
  const EpiBand& band = job.band;
  const int plane = shear.is_half(view) ? DerivativePlanes::half(band, channel, view)
                                        : DerivativePlanes::whole(band, channel, view);
  return plane + epi * band.pitch + shear.source(view);
}

/// Tones strong gradients down; what an invalid sample entered counts nothing.
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

/// The gradient at a view whose filters are symmetric, with five taps; pairs are added first.
/// `in` are the derivatives of the five views.
__device__ inline float2 inner_gradient(const float* smooth, const float* derivative,
                                        const float2& a, const float2& b, const float2& c,
                                        const float2& d, const float2& e) {
  float along = two_products(smooth[2], c.x, smooth[1], b.x + d.x);
  along = __fmaf_rn(smooth[0], a.x + e.x, along);
  return {along, two_products(derivative[1], b.y - d.y, derivative[0], a.y - e.y)};
}

/// Of nine views, for one of them.
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

/// Writes the tensors of one lane: place `lane` of the first wanted view.
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

/// Integrates at lane `at` for nine views.
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

/// The gradient of any view. Taps of zero are left out: what they would read may be invalid.
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

/// Views whose products `integrate_views` keeps, at most.
inline constexpr int kProductViews = kViewsTogether + ViewFilter::kMaxTaps - 1;

/// The same for any number of views and any filters. `products` has a column for each thread.
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

}  // namespace episcope::cuda
