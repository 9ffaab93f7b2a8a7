// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/net_layers.cuh"

#include "engine/cuda/device_data.cuh"

#include <math_constants.h>

#include <vector>

namespace episcope::cuda {
namespace {

constexpr int kColumns = 32;  // Of a block, whose warps each have another disparity.
constexpr int kLabelsAtOnce = 8;

// Views as kernels compare them.

struct Preparation {
  DeviceSamples samples;
  const int2* views;  // v, u
  float4* pixels;
  float* down;
  float* guide;  // Of the first view.
  TensorShape guide_shape;
};

__device__ float3 color_at(const DeviceSamples& from, long pixel) {
  const float first = from.at(pixel, 0);
  if (from.channels == 1) return {first, first, first};
  return {first, from.at(pixel, 1), from.at(pixel, 2)};
}
__device__ float grey_at(const DeviceSamples& from, long pixel) {
  const float3 color = color_at(from, pixel);
  return (color.x + color.y + color.z) / 3;
}

__global__ void prepare_views(Preparation work) {
  const DeviceSamples& from = work.samples;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= from.width) return;
  const int2 view = work.views[blockIdx.z];
  const auto pixel = [&](int row, int column) {
    return from.pixel(view.x, view.y, min(max(row, 0), from.height - 1),
                      min(max(column, 0), from.width - 1));
  };
  const long here = pixel(y, x);
  // The pixel itself stands for a neighbor that is invalid.
  const auto neighbor = [&](int row, int column) {
    const long at = pixel(row, column);
    return from.valid != nullptr && from.valid[at] == 0 ? here : at;
  };
  const long left = neighbor(y, x - 1), right = neighbor(y, x + 1);
  const long above = neighbor(y - 1, x), below = neighbor(y + 1, x);
  float3 color = color_at(from, here);
  const float along = grey_at(from, right) - grey_at(from, left);
  const float down = grey_at(from, below) - grey_at(from, above);
  if (blockIdx.z == 0) {
    const float guide[kNetGuide] = {color.x - kNetGrey, color.y - kNetGrey, color.z - kNetGrey,
                                    kNetContrast * along, kNetContrast * down};
    for (int c = 0; c < kNetGuide; ++c) work.guide[work.guide_shape.at(c, 0, y, x)] = guide[c];
  }
  if (from.valid != nullptr && from.valid[here] == 0) color.x = CUDART_NAN_F;
  const long at = (static_cast<long>(blockIdx.z) * from.height + y) * from.width + x;
  work.pixels[at] = {color.x, color.y, color.z, along};
  work.down[at] = down;
}

// Evidence.

// Where a view is sampled: the first of four pixels, the weights of the second column and row.
struct Sample {
  int column, row;
  int next_column, next_row;
  float along, below;
  bool is_within;
};

// As the CPU has it of a disparity that all pixels share: the shift is rounded once for all
// columns.
__device__ Sample shifted_sample(const NetViewPointers& views, int x, int y, float2 offset,
                                 float d) {
  const float shift = __fmul_rn(-d, offset.x);
  const float row = __fsub_rn(static_cast<float>(y), __fmul_rn(d, offset.y));
  const float whole = floorf(shift);
  Sample sample;
  sample.column = x + static_cast<int>(whole);
  sample.along = shift - whole;
  sample.next_column = sample.along > 0 ? sample.column + 1 : sample.column;
  sample.is_within = row >= 0 && row <= static_cast<float>(views.height - 1) &&
                     sample.column >= 0 && sample.next_column < views.width;
  sample.row = static_cast<int>(row);
  sample.next_row = min(sample.row + 1, views.height - 1);
  sample.below = row - static_cast<float>(sample.row);
  return sample;
}

// As the CPU has it of maps.
__device__ Sample mapped_sample(const NetViewPointers& views, int x, int y, float2 offset,
                                float d) {
  const float column = static_cast<float>(x) - d * offset.x;
  const float row = static_cast<float>(y) - d * offset.y;
  const float inside_x = fmaxf(fminf(column, static_cast<float>(views.width - 1)), 0);
  const float inside_y = fmaxf(fminf(row, static_cast<float>(views.height - 1)), 0);
  Sample sample;
  sample.column = min(static_cast<int>(inside_x), max(views.width - 2, 0));
  sample.row = min(static_cast<int>(inside_y), max(views.height - 2, 0));
  sample.next_column = min(sample.column + 1, views.width - 1);
  sample.next_row = min(sample.row + 1, views.height - 1);
  sample.along = inside_x - static_cast<float>(sample.column);
  sample.below = inside_y - static_cast<float>(sample.row);
  sample.is_within = inside_x == column && inside_y == row;
  return sample;
}

struct Distance {
  float color;
  float difference;
};

// How far a sample is from a pixel of the reference; NaN where an invalid pixel enters.
__device__ Distance distance_of(const float4* pixels, const float* down, int width,
                                const Sample& at, float4 reference, float reference_down) {
  const int upper = at.row * width, lower = at.next_row * width;
  const float weights[4] = {(1 - at.along) * (1 - at.below), at.along * (1 - at.below),
                            (1 - at.along) * at.below, at.along * at.below};
  const int places[4] = {upper + at.column, upper + at.next_column, lower + at.column,
                         lower + at.next_column};
  float4 off{-reference.x, -reference.y, -reference.z, -reference.w};
  float off_down = -reference_down;
#pragma unroll
  for (int i = 0; i < 4; ++i) {
    const float4 pixel = pixels[places[i]];
    off.x += weights[i] * pixel.x;
    off.y += weights[i] * pixel.y;
    off.z += weights[i] * pixel.z;
    off.w += weights[i] * pixel.w;
    off_down += weights[i] * down[places[i]];
  }
  return {fabsf(off.x) + fabsf(off.y) + fabsf(off.z), fabsf(off.w) + fabsf(off_down)};
}

__device__ float evidence_of(float sum, float count, float channels) {
  if (!(count > 0)) return kNetNoViews;
  return kNetScale * (logf(sum / (count * channels) + kNetFloor) + kNetAdd);
}

// Evidence at a pixel, number by number to `take(channel, value)`.
template <bool kIsPlane, class Take>
__device__ void find_evidence(const NetViewPointers& views, int x, int y, float d,
                              const Take& take) {
  const long pixels = static_cast<long>(views.height) * views.width;
  const long here = static_cast<long>(y) * views.width + x;
  const float4 reference = views.pixels[here];
  const float reference_down = views.down[here];
#pragma unroll 1
  for (int sector = 0; sector < kNetSectors; ++sector) {
    float color = 0, difference = 0, count = 0;
#pragma unroll 2
    for (int i = views.sector_begin[sector]; i < views.sector_begin[sector + 1]; ++i) {
      const float2 offset = views.offsets[i];
      const Sample at =
          kIsPlane ? shifted_sample(views, x, y, offset, d) : mapped_sample(views, x, y, offset, d);
      if (!at.is_within) continue;
      const Distance distance = distance_of(views.pixels + i * pixels, views.down + i * pixels,
                                            views.width, at, reference, reference_down);
      if (!(distance.color + distance.difference >= 0)) continue;
      color += distance.color;
      difference += distance.difference;
      ++count;
    }
    take(sector, evidence_of(color, count, 3));
    take(kNetSectors + sector, evidence_of(difference, count, 2));
  }
}

struct Planes {
  NetViewPointers views;
  float* out;
  TensorShape shape;
  int first_row;
  float first, last;  // Labels.
};

__global__ __launch_bounds__(kColumns* kLabelsAtOnce) void find_planes(Planes work) {
  const int x = static_cast<int>(blockIdx.x) * kColumns + static_cast<int>(threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  const int label = static_cast<int>(blockIdx.z) * kLabelsAtOnce + static_cast<int>(threadIdx.y);
  if (x >= work.views.width || label >= work.shape.depth) return;
  const float part = static_cast<float>(label) / static_cast<float>(work.shape.depth - 1);
  const float d = __fadd_rn(work.first, __fmul_rn(work.last - work.first, part));
  find_evidence<true>(work.views, x, work.first_row + y, d, [&](int channel, float value) {
    work.out[work.shape.at(channel, label, y, x)] = value;
  });
}

// Evidence at maps, reduced.

// Weights in shared memory.
struct Reducing {
  float first[kNetEvidence][kNetEvidence];
  float first_bias[kNetEvidence];
  float second[kNetReduced][kNetEvidence];
  float second_bias[kNetReduced];
};

__device__ float leaky(float value) {
  return fmaxf(value, kNetLeak * value);
}

__device__ void reduce(const Reducing& weights, const float (&evidence)[kNetEvidence],
                       float (&reduced)[kNetReduced]) {
  float inner[kNetEvidence];
#pragma unroll
  for (int o = 0; o < kNetEvidence; ++o) {
    float sum = weights.first_bias[o];
#pragma unroll
    for (int i = 0; i < kNetEvidence; ++i) sum += weights.first[o][i] * evidence[i];
    inner[o] = leaky(sum);
  }
#pragma unroll
  for (int o = 0; o < kNetReduced; ++o) {
    float sum = weights.second_bias[o];
#pragma unroll
    for (int i = 0; i < kNetEvidence; ++i) sum += weights.second[o][i] * inner[i];
    reduced[o] = leaky(sum);
  }
}

struct Maps {
  NetViewPointers views;
  const float* maps;     // `[map][y][x]`; of offsets one.
  float step;            // From offset to offset.
  const float* weights;  // Reducing.
  float* out;
  TensorShape shape;
};

// Each warp has one of kCount disparities of 32 pixels: maps, or offsets from one, of which the
// first is subtracted from the others.
template <int kCount, bool kAreOffsets>
__global__ __launch_bounds__(kColumns* kCount) void reduce_maps(Maps work) {
  __shared__ Reducing weights;
  __shared__ float all[kCount][kNetEvidence][kColumns];
  const int column = static_cast<int>(threadIdx.x), number = static_cast<int>(threadIdx.y);
  for (int i = number * kColumns + column; i < static_cast<int>(sizeof(Reducing) / sizeof(float));
       i += kColumns * kCount) {
    reinterpret_cast<float*>(&weights)[i] = work.weights[i];
  }
  const int x = static_cast<int>(blockIdx.x) * kColumns + column;
  const int y = static_cast<int>(blockIdx.y);
  const int width = work.views.width;
  const long here = static_cast<long>(y) * width + min(x, width - 1);
  const long map = kAreOffsets ? 0 : static_cast<long>(work.views.height) * width * number;
  float d = work.maps[map + here];
  if constexpr (kAreOffsets) {
    constexpr float kOffset[] = {kNetOffset[0], kNetOffset[1], kNetOffset[2], kNetOffset[3],
                                 kNetOffset[4]};
    d = __fadd_rn(d, __fmul_rn(kOffset[number], work.step));
  }
  find_evidence<false>(work.views, min(x, width - 1), y, d,
                       [&](int channel, float value) { all[number][channel][column] = value; });
  __syncthreads();
  float evidence[kNetEvidence], reduced[kNetReduced];
#pragma unroll
  for (int c = 0; c < kNetEvidence; ++c) {
    evidence[c] = all[number][c][column];
    if (kAreOffsets && number > 0) {
      evidence[c] = (evidence[c] - all[0][c][column]) * kNetOffsetGain;
    }
  }
  reduce(weights, evidence, reduced);
  if (x >= width) return;
  for (int c = 0; c < kNetReduced; ++c) {
    work.out[work.shape.at(number * kNetReduced + c, 0, y, x)] = reduced[c];
  }
}

template <int kCount, bool kAreOffsets>
void launch_maps(const Maps& work, int views, const DeviceStream& stream) {
  const double samples = static_cast<double>(kCount) * work.shape.plane() * views;
  launch(stream, {"net: evidence at maps", 20 * samples / kCount, 60 * samples}, [&] {
    const dim3 grid(blocks_for(work.shape.width, kColumns), work.shape.height);
    reduce_maps<kCount, kAreOffsets><<<grid, dim3(kColumns, kCount), 0, stream.get()>>>(work);
  });
}

}  // namespace

NetViews::NetViews(const NetTask& task, const DeviceStream& stream, const Progress& progress) {
  const auto light_field = on_device(task.light_field, progress.part(0, 0));
  std::vector<int2> views{{task.view.v, task.view.u}};
  std::vector<float2> offsets{{0, 0}};
  std::vector<int> sector_begin;
  for (int k = 0; k < kNetSectors; ++k) {
    sector_begin.push_back(static_cast<int>(views.size()));
    for (const auto& [view, way] : task.sectors[k]) {
      views.push_back({view.v, view.u});
      offsets.push_back({static_cast<float>(way.u), static_cast<float>(way.v)});
    }
  }
  sector_begin.push_back(static_cast<int>(views.size()));
  views_ = static_cast<int>(views.size());
  const DeviceSamples& samples = light_field->samples();
  const auto count = static_cast<std::size_t>(samples.height) * samples.width * views.size();
  colors_ = DeviceArray<float4>(count, stream);
  down_ = DeviceArray<float>(count, stream);
  offsets_ = upload(offsets.data(), offsets.size(), stream, progress.part(0, 0));
  sector_begin_ = upload(sector_begin.data(), sector_begin.size(), stream, progress.part(0, 0));
  guide_ = NetTensor({kNetGuide, 1, samples.height, samples.width}, stream);
  const auto indices = upload(views.data(), views.size(), stream, progress.part(0, 0));
  const Preparation work{samples,      indices.data(),       colors_.data(),
                         down_.data(), guide_.values.data(), guide_.shape};
  launch(stream, {"net: views", 23.0 * static_cast<double>(count), 0}, [&] {
    constexpr int kThreads = 128;
    const dim3 grid(blocks_for(samples.width, kThreads), samples.height, views_);
    prepare_views<<<grid, kThreads, 0, stream.get()>>>(work);
  });
  stream.wait();  // Then nobody needs the samples.
  pointers_ = {colors_.data(),       down_.data(),   offsets_.data(),
               sector_begin_.data(), samples.height, samples.width};
}

NetTensor NetViews::evidence(const NetTask& task, int first, int end,
                             const DeviceStream& stream) const {
  NetTensor out({kNetEvidence, task.labels, end - first, width()}, stream);
  const Planes work{pointers_, out.values.data(), out.shape, first, task.first, task.last};
  const auto size = static_cast<double>(out.shape.size());
  const double samples = size / kNetEvidence * views_;
  launch(stream, {"net: evidence of labels", 4 * size, 60 * samples}, [&] {
    const dim3 grid(blocks_for(width(), kColumns), end - first,
                    blocks_for(task.labels, kLabelsAtOnce));
    find_planes<<<grid, dim3(kColumns, kLabelsAtOnce), 0, stream.get()>>>(work);
  });
  return out;
}

NetTensor NetViews::guide(int first, int end, const DeviceStream& stream) const {
  NetTensor part({kNetGuide, 1, end - first, width()}, stream);
  for (int c = 0; c < kNetGuide; ++c) {
    check(cudaMemcpyAsync(part.values.data() + part.shape.at(c, 0, 0, 0),
                          guide_.values.data() + guide_.shape.at(c, 0, first, 0),
                          part.shape.plane() * sizeof(float), cudaMemcpyDeviceToDevice,
                          stream.get()));
  }
  return part;
}

void NetViews::reduce_hypotheses(const float* maps, const float* weights, NetTensor& inputs,
                                 const DeviceStream& stream) const {
  launch_maps<kNetHypotheses, false>(
      {pointers_, maps, 0, weights, inputs.values.data(), inputs.shape}, views_, stream);
}

void NetViews::reduce_offsets(const float* map, float step, const float* weights, NetTensor& inputs,
                              const DeviceStream& stream) const {
  launch_maps<kNetOffsets, true>(
      {pointers_, map, step, weights, inputs.values.data(), inputs.shape}, views_, stream);
}

std::vector<float> ordered_reduction(const NetReduction& reduction) {
  std::vector<float> ordered;
  for (const NetConvolution* const form : {&reduction.first, &reduction.second}) {
    ordered.insert(ordered.end(), form->weights.begin(), form->weights.end());
    ordered.insert(ordered.end(), form->bias.begin(), form->bias.end());
  }
  return ordered;
}

}  // namespace episcope::cuda
