// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/net.h"

#include "engine/cuda/net_layers.cuh"

#include <algorithm>
#include <utility>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
// Rows that one of the volume sees, and the distance of rows that all its levels have.
constexpr int kVolumeReach = 96, kVolumeStep = 8;

// Maps `[y][x]` of the size of a view.
struct MapSize {
  int height;
  int width;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
};

dim3 grid_of(MapSize size) {
  return {blocks_for(size.width, kThreads), static_cast<unsigned>(size.height)};
}

// The pixel of a thread.
struct Pixel {
  int y, x;
  long at;
  bool is_within;
};
__device__ Pixel pixel_of(MapSize size) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  return {y, x, static_cast<long>(y) * size.width + x, x < size.width};
}

// Modes of the volume.

struct Modes {
  MapSize size;  // Of the rows that count.
  TensorShape shape;
  const float* logits;
  int skipped, first_row;  // Rows of the logits before the first that counts, and its number.
  float* log;              // `[label][y][x]`
  float* own;
  float* second;
  float first, step;
  long pixels;  // Of all rows.
};

// The disparity of the labels around one, weighted by their probabilities.
__device__ float peak_at(const Modes& work, const float* logits, long stride, float most, int at) {
  float sum = 0, weighted = 0;
  const int end = min(at + kNetPeak + 1, work.shape.depth);
  for (int i = max(at - kNetPeak, 0); i < end; ++i) {
    const float probability = expf(logits[i * stride] - most);
    sum += probability;
    weighted += probability * static_cast<float>(i);
  }
  return work.first + weighted / sum * work.step;
}

__global__ void find_modes(Modes work) {
  const Pixel pixel = pixel_of(work.size);
  if (!pixel.is_within) return;
  const float* const logits = work.logits + work.shape.at(0, 0, work.skipped + pixel.y, pixel.x);
  const long stride = work.shape.plane();
  int first = 0;
  float most = logits[0];
  for (int i = 1; i < work.shape.depth; ++i) {
    const float logit = logits[i * stride];
    if (logit > most) first = i;
    most = fmaxf(most, logit);
  }
  const long at = pixel.at + static_cast<long>(work.first_row) * work.size.width;
  float sum = 0, greatest = 0;
  int other = -1;
  for (int i = 0; i < work.shape.depth; ++i) {
    const float logit = logits[i * stride];
    sum += expf(logit - most);
    if (abs(i - first) <= kNetModesApart || (other >= 0 && logit <= greatest)) continue;
    other = i;
    greatest = logit;
  }
  const float log_sum = logf(sum);
  for (int i = 0; i < work.shape.depth; ++i) {
    work.log[i * work.pixels + at] = logits[i * stride] - most - log_sum;
  }
  work.own[at] = peak_at(work, logits, stride, most, first);
  work.second[at] = peak_at(work, logits, stride, most, other);
}

// Windows.

// Maximum and minimum of the pixels around that exist.
__global__ void find_extremes(MapSize size, const float* map, int radius, float* most,
                              float* least) {
  const Pixel pixel = pixel_of(size);
  if (!pixel.is_within) return;
  float greatest = map[pixel.at], smallest = greatest;
  for (int y = max(pixel.y - radius, 0); y < min(pixel.y + radius + 1, size.height); ++y) {
    for (int x = max(pixel.x - radius, 0); x < min(pixel.x + radius + 1, size.width); ++x) {
      const float value = map[static_cast<long>(y) * size.width + x];
      greatest = fmaxf(greatest, value);
      smallest = fminf(smallest, value);
    }
  }
  most[pixel.at] = greatest;
  least[pixel.at] = smallest;
}

// The number that at most half of a window is less than, and more than half not greater.
__global__ void find_medians(MapSize size, const float* map, int apart, float* medians) {
  constexpr int kCount = kNetWindow * kNetWindow, kRadius = kNetWindow / 2;
  const Pixel pixel = pixel_of(size);
  if (!pixel.is_within) return;
  float window[kCount];
#pragma unroll
  for (int i = 0; i < kCount; ++i) {
    const int y = min(max(pixel.y + (i / kNetWindow - kRadius) * apart, 0), size.height - 1);
    const int x = min(max(pixel.x + (i % kNetWindow - kRadius) * apart, 0), size.width - 1);
    window[i] = map[static_cast<long>(y) * size.width + x];
  }
  float median = 0;
#pragma unroll
  for (int i = 0; i < kCount; ++i) {
    int less = 0, up_to = 0;
#pragma unroll
    for (int j = 0; j < kCount; ++j) {
      less += window[j] < window[i] ? 1 : 0;
      up_to += window[j] <= window[i] ? 1 : 0;
    }
    if (less <= kCount / 2 && up_to > kCount / 2) median = window[i];
  }
  medians[pixel.at] = median;
}

struct Selection {
  MapSize size;
  const float* hypotheses;  // kNetHypotheses maps.
  const float* log;         // Null without a volume.
  int labels;
  float first, step;
  const float* guide;
  TensorShape guide_shape;
  float* inputs;
  TensorShape shape;
};

// Log-probability of a disparity, linear between labels.
__device__ float log_at(const Selection& work, long at, float disparity) {
  const float place =
      fminf(fmaxf((disparity - work.first) / work.step, 0), static_cast<float>(work.labels - 1));
  const int i = min(static_cast<int>(place), work.labels - 2);
  const float part = place - static_cast<float>(i);
  const long pixels = work.size.pixels();
  return work.log[i * pixels + at] * (1 - part) + work.log[(i + 1) * pixels + at] * part;
}

__device__ float squash(float disparity) {
  return copysignf(kNetSquash * log1pf(fabsf(disparity) / kNetSquashUnit), disparity);
}

// Inputs of the selection beside the evidence.
__global__ void write_hypotheses(Selection work) {
  const Pixel pixel = pixel_of(work.size);
  if (!pixel.is_within) return;
  int channel = kNetHypotheses * kNetReduced;
  const auto put = [&](float value) {
    work.inputs[work.shape.at(channel++, 0, pixel.y, pixel.x)] = value;
  };
  const long pixels = work.size.pixels();
  const bool has_volume = work.log != nullptr;
  for (int i = 0; i < kNetHypotheses; ++i) {
    const float log =
        has_volume ? log_at(work, pixel.at, work.hypotheses[i * pixels + pixel.at]) : 0;
    put(fminf(fmaxf(log, kNetLeastLog), 0) / kNetLogScale);
  }
  const float own = work.hypotheses[pixel.at];
  for (int i = 1; i < kNetHypotheses; ++i) {
    put(squash(work.hypotheses[i * pixels + pixel.at] - own));
  }
  put(has_volume ? 1 : 0);
  for (int c = 0; c < kNetGuide; ++c) put(work.guide[work.guide_shape.at(c, 0, pixel.y, pixel.x)]);
}

struct Decision {
  MapSize size;
  const float* logits;
  TensorShape shape;
  float* hypotheses;  // The mode takes the place of the first, the other disparity of the last.
  float* probability;
  float* second_probability;
  float* to_mean;
};

__device__ float kernel_of(float distance) {
  return expf(-(distance / kNetSame) * (distance / kNetSame));
}

__global__ void decide(Decision work) {
  constexpr int kCount = kNetHypotheses;
  const Pixel pixel = pixel_of(work.size);
  if (!pixel.is_within) return;
  const long pixels = work.size.pixels();
  float h[kCount], weight[kCount], score[kCount];
  float most = 0, sum = 0, mean = 0;
  for (int i = 0; i < kCount; ++i) {
    h[i] = work.hypotheses[i * pixels + pixel.at];
    weight[i] = work.logits[work.shape.at(i, 0, pixel.y, pixel.x)];
    most = i == 0 ? weight[i] : fmaxf(most, weight[i]);
  }
  for (int i = 0; i < kCount; ++i) sum += weight[i] = expf(weight[i] - most);
  for (int i = 0; i < kCount; ++i) {
    weight[i] /= sum;
    mean += weight[i] * h[i];
  }
  int best = 0, other = -1;
  for (int i = 0; i < kCount; ++i) {
    score[i] = 0;
    for (int j = 0; j < kCount; ++j) score[i] += kernel_of(h[i] - h[j]) * weight[j];
    if (score[i] > score[best]) best = i;
  }
  float near = 0, weighted = 0;
  for (int i = 0; i < kCount; ++i) {
    const float share = weight[i] * kernel_of(h[i] - h[best]);
    near += share;
    weighted += share * h[i];
    const bool is_far = !(fabsf(h[i] - h[best]) < kNetOther);
    if (is_far && (other < 0 || score[i] > score[other])) other = i;
  }
  const float mode = weighted / fmaxf(near, kNetLeastShare);
  const bool has_other = other >= 0 && score[other] > 0;
  work.hypotheses[pixel.at] = mode;
  work.hypotheses[(kCount - 1) * pixels + pixel.at] = has_other ? h[other] : mode;
  work.probability[pixel.at] = fminf(score[best], 1);
  work.second_probability[pixel.at] = has_other ? fminf(score[other], 1) : 0;
  work.to_mean[pixel.at] = mean - mode;
}

struct Refinement {
  MapSize size;
  float* disparity;
  const float* probability;
  const float* windows;  // kNetWindows maps.
  const float* guide;
  TensorShape guide_shape;
  float* inputs;
  TensorShape shape;
};

// Inputs of a refinement beside the evidence.
__global__ void write_surroundings(Refinement work) {
  const Pixel pixel = pixel_of(work.size);
  if (!pixel.is_within) return;
  int channel = kNetOffsets * kNetReduced;
  const auto put = [&](float value) {
    work.inputs[work.shape.at(channel++, 0, pixel.y, pixel.x)] = value;
  };
  for (int i = 0; i < kNetWindows; ++i) {
    put(squash(work.windows[i * work.size.pixels() + pixel.at] - work.disparity[pixel.at]));
  }
  put(work.probability[pixel.at]);
  for (int c = 0; c < kNetGuide; ++c) put(work.guide[work.guide_shape.at(c, 0, pixel.y, pixel.x)]);
}

__global__ void move(MapSize size, const float* outputs, TensorShape shape, float reach,
                     float* disparity, float* confidence) {
  const Pixel pixel = pixel_of(size);
  if (!pixel.is_within) return;
  disparity[pixel.at] += reach * tanhf(outputs[shape.at(0, 0, pixel.y, pixel.x)]);
  confidence[pixel.at] = 1 / (1 + expf(-outputs[shape.at(1, 0, pixel.y, pixel.x)]));
}

__global__ void add_map(MapSize size, const float* other, float* map) {
  const Pixel pixel = pixel_of(size);
  if (pixel.is_within) map[pixel.at] += other[pixel.at];
}

// Memory that this program may still take.
double free_bytes() {
  std::size_t free = 0, all = 0;
  check(cudaMemGetInfo(&free, &all));
  cudaMemPool_t pool = nullptr;
  check(cudaDeviceGetDefaultMemPool(&pool, 0));
  std::uint64_t reserved = 0, used = 0;
  check(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent, &reserved));
  check(cudaMemPoolGetAttribute(pool, cudaMemPoolAttrUsedMemCurrent, &used));
  return static_cast<double>(free) + static_cast<double>(reserved - used);
}

}  // namespace

struct DeviceNet::Memory {
  DeviceStream stream;
  DevicePart volume, selection;
  std::array<DevicePart, kNetRefinements> refinements;
  DeviceArray<float> selection_reduction;
  std::array<DeviceArray<float>, kNetRefinements> refinement_reductions;

  Memory(const NetParts& parts, const Progress& progress)
      : volume(parts.volume, stream, progress),
        selection(parts.selection, stream, progress),
        refinements{DevicePart(parts.refinements[0], stream, progress),
                    DevicePart(parts.refinements[1], stream, progress)},
        selection_reduction(uploaded(parts.selection_reduction, progress)),
        refinement_reductions{uploaded(parts.refinement_reductions[0], progress),
                              uploaded(parts.refinement_reductions[1], progress)} {
    stream.wait();
  }

 private:
  [[nodiscard]] DeviceArray<float> uploaded(const NetReduction& reduction,
                                            const Progress& progress) const {
    const std::vector<float> weights = ordered_reduction(reduction);
    return upload(weights.data(), weights.size(), stream, progress);
  }
};

namespace {

// One view: maps on the device and what is done with them.
class NetRun {
 public:
  NetRun(const NetTask& task, const DevicePart& volume, const Progress& progress)
      : task_(task),
        volume_(volume),
        views_(task, stream_, progress),
        size_{views_.height(), views_.width()},
        hypotheses_(kNetHypotheses * size_.pixels(), stream_),
        others_(kOthers * size_.pixels(), stream_) {}

  void find_volume(const Progress& progress) {
    progress.step("volume");
    log_ = DeviceArray<float>(task_.labels * size_.pixels(), stream_);
    const int band = rows_at_once();
    for (int first = 0; first < size_.height; first += band) {
      const double height = size_.height;
      const int end = std::min(first + band, size_.height);
      find_band(first, end, progress.part(first / height, end / height));
    }
  }
  void take_start(const Progress& progress) {
    const Image<float>& start = *task_.start;
    for (float* const map : {hypothesis(0), hypothesis(kNetHypotheses - 1)}) {
      upload_bytes(map, start.data(), start.size() * sizeof(float), stream_, progress.part(0, 0));
    }
  }

  // A round: maps become those that the selection decides for.
  void select(const DevicePart& selection, const DeviceArray<float>& reduction,
              const Progress& progress) {
    progress.step("selection");
    make_hypotheses();
    NetTensor inputs({kNetSelectionInputs, 1, size_.height, size_.width}, stream_);
    views_.reduce_hypotheses(hypothesis(0), reduction.data(), inputs, stream_);
    const NetTensor& guide = views_.whole_guide();
    on_pixels("net: hypotheses", write_hypotheses,
              Selection{size_, hypothesis(0), log_.data(), task_.labels, task_.first, label_step(),
                        guide.values.data(), guide.shape, inputs.values.data(), inputs.shape});
    const NetTensor logits = run_on(selection, std::move(inputs), progress);
    on_pixels("net: decisions", decide,
              Decision{size_, logits.values.data(), logits.shape, hypothesis(0),
                       other(kProbability), other(kSecondProbability), other(kToMean)});
  }

  void refine(const DevicePart& refinement, const DeviceArray<float>& reduction, float step,
              const Progress& progress) {
    progress.step("refinement");
    float* const map = hypothesis(0);
    on_pixels("net: windows", find_extremes, size_, map, kNetWindow / 2, hypothesis(1),
              hypothesis(2));
    on_pixels("net: windows", find_medians, size_, map, 1, hypothesis(3));
    NetTensor inputs({kNetRefinementInputs, 1, size_.height, size_.width}, stream_);
    views_.reduce_offsets(map, step, reduction.data(), inputs, stream_);
    const NetTensor& guide = views_.whole_guide();
    on_pixels("net: surroundings", write_surroundings,
              Refinement{size_, map, other(kProbability), hypothesis(1), guide.values.data(),
                         guide.shape, inputs.values.data(), inputs.shape});
    const NetTensor outputs = run_on(refinement, std::move(inputs), progress);
    on_pixels("net: moves", move, size_, outputs.values.data(), outputs.shape, step * kNetReach,
              map, other(kConfidence));
  }

  [[nodiscard]] NetAnswer answer(const Progress& progress) {
    if (task_.takes_mean) on_pixels("net: means", add_map, size_, other(kToMean), hypothesis(0));
    return {downloaded(hypothesis(0), progress), downloaded(other(kConfidence), progress),
            downloaded(hypothesis(kNetHypotheses - 1), progress),
            downloaded(other(kSecondProbability), progress)};
  }

 private:
  // Maps beside the hypotheses.
  enum Other { kProbability, kSecondProbability, kToMean, kConfidence, kOthers };

  [[nodiscard]] float* hypothesis(int i) { return hypotheses_.data() + i * size_.pixels(); }
  [[nodiscard]] float* other(Other i) { return others_.data() + i * size_.pixels(); }
  [[nodiscard]] float label_step() const {
    return task_.labels < 2 ? 1 : (task_.last - task_.first) / static_cast<float>(task_.labels - 1);
  }

  template <class Kernel, class... Arguments>
  void on_pixels(const char* name, Kernel* kernel, const Arguments&... arguments) {
    const auto bytes = 8.0 * static_cast<double>(size_.pixels());
    launch(stream_, {name, bytes, 0},
           [&] { kernel<<<grid_of(size_), kThreads, 0, stream_.get()>>>(arguments...); });
  }

  [[nodiscard]] NetTensor run_on(const DevicePart& part, NetTensor inputs,
                                 const Progress& progress) {
    std::vector<NetTensor> sources;
    sources.push_back(std::move(inputs));
    return part.run(std::move(sources), stream_, progress);
  }

  // Rows of the volume for which memory is free, with those that they see.
  [[nodiscard]] int rows_at_once() const {
    constexpr double kShare = 0.8;
    constexpr int kRows = 1024;
    const double bytes = volume_.bytes(
        {{kNetEvidence, task_.labels, kRows, size_.width}, {kNetGuide, 1, kRows, size_.width}});
    const double rows = kShare * free_bytes() / bytes * kRows;
    if (rows >= size_.height) return size_.height;
    const int band = static_cast<int>(rows) - 2 * kVolumeReach;
    return std::max(band, kVolumeStep) / kVolumeStep * kVolumeStep;
  }

  void find_band(int first, int end, const Progress& progress) {
    const int begin = std::max(first - kVolumeReach, 0);
    const int behind = std::min(end + kVolumeReach, size_.height);
    std::vector<NetTensor> sources;
    sources.push_back(views_.evidence(task_, begin, behind, stream_));
    stream_.wait();
    progress.check();
    sources.push_back(views_.guide(begin, behind, stream_));
    const NetTensor logits = volume_.run(std::move(sources), stream_, progress);
    const Modes work{{end - first, size_.width},
                     logits.shape,
                     logits.values.data(),
                     first - begin,
                     first,
                     log_.data(),
                     hypothesis(0),
                     hypothesis(kNetHypotheses - 1),
                     task_.first,
                     label_step(),
                     size_.pixels()};
    launch(stream_, {"net: modes", 8.0 * static_cast<double>(logits.shape.size()), 0},
           [&] { find_modes<<<grid_of(work.size), kThreads, 0, stream_.get()>>>(work); });
  }

  // Of the first map and its maxima, minima and medians.
  void make_hypotheses() {
    const auto extremes = [&](int map, int size, int most) {
      on_pixels("net: windows", find_extremes, size_, hypothesis(map), size / 2, hypothesis(most),
                hypothesis(most + 1));
    };
    extremes(0, kNetWindow, 1);
    on_pixels("net: windows", find_medians, size_, hypothesis(0), 1, hypothesis(3));
    extremes(3, kNetWideWindow, 4);
    on_pixels("net: windows", find_medians, size_, hypothesis(0), kNetMedianApart, hypothesis(6));
  }

  [[nodiscard]] Image<float> downloaded(const float* map, const Progress& progress) const {
    Image<float> image(size_.height, size_.width);
    download_bytes(image.data(), map, image.size() * sizeof(float), stream_, progress.part(0, 0));
    return image;
  }

  const NetTask& task_;
  const DevicePart& volume_;
  DeviceStream stream_;
  NetViews views_;
  MapSize size_;
  DeviceArray<float> hypotheses_, others_, log_;
};

}  // namespace

DeviceNet::DeviceNet(const NetParts& parts, const Progress& progress)
    : memory_(std::make_unique<Memory>(parts, progress)) {}
DeviceNet::~DeviceNet() = default;

NetAnswer DeviceNet::run(const NetTask& task, const Progress& progress) const {
  NetRun run(task, memory_->volume, progress.part(0, 0.02));
  const double begin = task.start != nullptr ? 0.02 : 0.65;
  task.start != nullptr ? run.take_start(progress) : run.find_volume(progress.part(0.02, begin));
  const auto at = [&](double round) { return begin + (0.9 - begin) * round / task.rounds; };
  for (int round = 0; round < task.rounds; ++round) {
    run.select(memory_->selection, memory_->selection_reduction,
               progress.part(at(round), at(round + 1)));
  }
  for (int i = 0; i < kNetRefinements; ++i) {
    run.refine(memory_->refinements[i], memory_->refinement_reductions[i], kNetSteps[i],
               progress.part(0.9 + 0.05 * i, 0.95 + 0.05 * i));
  }
  return run.answer(progress);
}

}  // namespace episcope::cuda
