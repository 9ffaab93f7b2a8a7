// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo_matcher.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/matching_costs.cuh"
#include "engine/disparity/kernels/shared_constants.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

struct Planes {
  float* before;
  float* here;
  float* after;
  float* mean;
};

__device__ const float* column_of(const VolumeView<const float>& costs, int y, int x) {
  return costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
}

__global__ void take_costs(VolumeView<const float> costs, const int* labels, Planes planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float* const column = column_of(costs, y, x);
  float sum = 0;
#pragma unroll 8
  for (int l = 0; l < costs.layers; ++l) sum += column[static_cast<long>(l) * costs.width];
  const long at = static_cast<long>(y) * costs.width + x;
  const int label = labels[at];
  const auto cost = [&](int l) { return column[static_cast<long>(l) * costs.width]; };
  planes.before[at] = cost(max(label - 1, 0));
  planes.here[at] = cost(label);
  planes.after[at] = cost(min(label + 1, costs.layers - 1));
  planes.mean[at] = sum / static_cast<float>(costs.layers);
}

// The label of least cost of a column, of equals the lowest.
__device__ int least_label(const VolumeView<const float>& costs, const float* column) {
  float least = column[0];
  int best = 0;
#pragma unroll 8
  for (int l = 1; l < costs.layers; ++l) {
    const float cost = column[static_cast<long>(l) * costs.width];
    best = cost < least ? l : best;
    least = fminf(least, cost);
  }
  return best;
}

__global__ void find_least(VolumeView<const float> costs, int* labels) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  labels[static_cast<long>(y) * costs.width + x] = least_label(costs, column_of(costs, y, x));
}

__global__ void sum_best(VolumeView<const float> costs, const std::uint8_t* valid, int reach,
                         double* parts) {
  __shared__ double shared[kThreads];
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  double own = 0;
  if (x < costs.width && (valid == nullptr || valid[static_cast<long>(y) * costs.width + x] != 0)) {
    const float* const column = column_of(costs, y, x);
    const int best = least_label(costs, column);
    const int first = max(0, best - reach), last = min(costs.layers - 1, best + reach);
    for (int l = first; l <= last; ++l) {
      own += static_cast<double>(column[static_cast<long>(l) * costs.width]);
    }
    own /= last - first + 1;
  }
  shared[threadIdx.x] = own;
  __syncthreads();
  for (int half = kThreads / 2; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) shared[threadIdx.x] += shared[threadIdx.x + half];
    __syncthreads();
  }
  if (threadIdx.x == 0) parts[static_cast<long>(blockIdx.y) * gridDim.x + blockIdx.x] = shared[0];
}

dim3 grid_of(const VolumeView<const float>& costs) {
  return {blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height)};
}

constexpr int kWays = 4;

struct ViewSamples {
  DeviceSamples samples;
  ViewIndex view;

  [[nodiscard]] __device__ float at(int y, int x, int channel) const {
    return samples.at(samples.pixel(view.v, view.u, y, x), channel);
  }
};

// Squared second differences along four ways, `[way][y][x]`.
__global__ void square_differences(ViewSamples view, float* squares) {
  const int height = view.samples.height, width = view.samples.width;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= width || y >= height) return;
  const int row = min(max(y, 1), height - 2), column = min(max(x, 1), width - 2);
  const float scale = 1 / (kSecondDifference * static_cast<float>(view.samples.channels));
  const int ways[kWays][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}};
  for (int i = 0; i < kWays; ++i) {
    const int down = ways[i][0], along = ways[i][1];
    float sum = 0;
    for (int c = 0; c < view.samples.channels; ++c) {
      const float d = view.at(row - down, column - along, c) - 2 * view.at(row, column, c) +
                      view.at(row + down, column + along, c);
      sum = __fadd_rn(sum, __fmul_rn(d, d));  // as the CPU rounds
    }
    squares[(static_cast<long>(i) * height + y) * width + x] = sum * scale;
  }
}

// The least over the ways of the means over windows.
__global__ void take_least_means(const float* squares, int height, int width, float most,
                                 float* least) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= width || y >= height) return;
  const int top = max(y - kNoiseRadius, 0), bottom = min(y + kNoiseRadius, height - 1);
  const int left = max(x - kNoiseRadius, 0), right = min(x + kNoiseRadius, width - 1);
  float result = most;
  for (int i = 0; i < kWays; ++i) {
    const float* const plane = squares + static_cast<long>(i) * height * width;
    float sum = 0;
    for (int column = left; column <= right; ++column) {
      float down = 0;
      for (int row = top; row <= bottom; ++row) {
        down += plane[static_cast<long>(row) * width + column];
      }
      sum += down;
    }
    const float mean =
        sum / static_cast<float>(right - left + 1) / static_cast<float>(bottom - top + 1);
    result = fminf(result, mean);
  }
  least[static_cast<long>(y) * width + x] = result;
}

// local_noise_variance of a view, `[y][x]`, at most `most`.
DeviceArray<float> local_noise_on_device(const DeviceSamples& samples, ViewIndex view, float most,
                                         const DeviceStream& stream) {
  const int height = samples.height, width = samples.width;
  const auto pixels = static_cast<std::size_t>(height) * width;
  DeviceArray<float> least(pixels, stream);
  if (height < 3 || width < 3) {
    least.clear();
    return least;
  }
  DeviceArray<float> squares(kWays * pixels, stream);
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(width, 32), blocks_for(height, 8));
  const auto all = static_cast<double>(pixels);
  launch(stream, {"stereo: second differences", all * (samples.channels + 16), all * 60}, [&] {
    square_differences<<<grid, block, 0, stream.get()>>>({samples, view}, squares.data());
  });
  launch(stream, {"stereo: noise", all * 20, all * 110}, [&] {
    take_least_means<<<grid, block, 0, stream.get()>>>(squares.data(), height, width, most,
                                                       least.data());
  });
  return least;
}

// The bits of a value ≥ 0 grow with it: what has a rank is found digit by digit.
constexpr int kDigitBits = 11;
constexpr int kDigits = 1 << kDigitBits;

// Of the values whose bits above the digit are those of a rank, a row of blocks each, how many have
// each digit, `[rank][digit]`.
__global__ void count_digits(const float* values, int count, int shift, const unsigned* above,
                             unsigned* counts) {
  __shared__ unsigned own[kDigits];
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    own[i] = 0;
  }
  __syncthreads();
  const unsigned wanted = above[blockIdx.y];
  const int step = static_cast<int>(gridDim.x * blockDim.x);
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < count; i += step) {
    const unsigned digit = __float_as_uint(values[i]) >> shift;
    if (digit / kDigits == wanted) atomicAdd(&own[digit % kDigits], 1U);
  }
  __syncthreads();
  unsigned* const of_rank = counts + blockIdx.y * kDigits;
  for (int i = static_cast<int>(threadIdx.x); i < kDigits; i += static_cast<int>(blockDim.x)) {
    if (own[i] != 0) atomicAdd(&of_rank[i], own[i]);
  }
}

// Where a rank falls: its digit, and its rank among the values of that digit.
unsigned digit_of(const unsigned* counts, unsigned& rank) {
  unsigned digit = 0;
  while (digit + 1 < kDigits && counts[digit] <= rank) rank -= counts[digit++];
  return digit;
}

// Of `count` values ≥ 0, infinite ones among them, those of these ranks in ascending order, each
// rank in [0, count). Waits for the device. Throws DeviceFailure.
std::vector<float> ranked_on_device(const float* values, int count, const std::vector<int>& ranks,
                                    const DeviceStream& stream) {
  constexpr int kThreads = 512, kBlocks = 64;
  const std::size_t size = ranks.size();
  DeviceArray<unsigned> counts(size * kDigits, stream), above_there(size, stream);
  std::vector<unsigned> left(ranks.begin(), ranks.end()), above(size, 0), found(size * kDigits);
  for (int shift = 2 * kDigitBits; shift >= 0; shift -= kDigitBits) {
    counts.clear();
    check(cudaMemcpyAsync(above_there.data(), above.data(), above_there.byte_size(),
                          cudaMemcpyHostToDevice, stream.get()));
    launch(stream, {"stereo: ranks", 4.0 * count * static_cast<double>(size)}, [&] {
      count_digits<<<dim3(kBlocks, static_cast<unsigned>(size)), kThreads, 0, stream.get()>>>(
          values, count, shift, above_there.data(), counts.data());
    });
    check(cudaMemcpyAsync(found.data(), counts.data(), counts.byte_size(), cudaMemcpyDeviceToHost,
                          stream.get()));
    stream.wait();
    for (std::size_t i = 0; i < size; ++i) {
      above[i] = above[i] * kDigits + digit_of(&found[i * kDigits], left[i]);
    }
  }
  std::vector<float> results;
  for (const unsigned bits : above) results.push_back(std::bit_cast<float>(bits));
  return results;
}

// The median as `quantile` has it, of at least one value.
float median_on_device(const float* values, int count, const DeviceStream& stream) {
  return ranked_on_device(values, count, {count / 2}, stream).front();
}

__global__ void divide(VolumeView<float> costs, const float* caps, float mean) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float factor = mean / caps[static_cast<long>(y) * costs.width + x];
  float* const column = costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
#pragma unroll 8
  for (int l = 0; l < costs.layers; ++l) column[static_cast<long>(l) * costs.width] *= factor;
}

// Divides the costs of every pixel by its cap, `[y][x]`, and multiplies them by `mean`.
void divide_by_caps(DeviceVolume& costs, const float* caps, float mean,
                    const DeviceStream& stream) {
  const auto values = static_cast<double>(costs.values.size());
  const dim3 grid(blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height));
  const VolumeView<float> view{costs.values.data(), costs.height, costs.layers, costs.width};
  launch(stream, {"stereo: division by caps", 8 * values, values},
         [&] { divide<<<grid, kThreads, 0, stream.get()>>>(view, caps, mean); });
}

// Costs that are held at once, where only the winners are asked for.
constexpr std::size_t kBandBytes = std::size_t{1} << 29;
constexpr int kLeastBandRows = 32;
// Pixels, labels and views of one launch: some ten milliseconds.
constexpr double kSamplesAtOnce = 1e10;

}  // namespace

CostsAtLabels costs_at_labels(const DeviceVolume& volume, const Image<int>& labels,
                              const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  const std::size_t pixels = labels.size();
  const auto on_device = upload(labels.data(), pixels, stream, progress);
  DeviceArray<float> planes(4 * pixels, stream);
  const Planes to{planes.data(), planes.data() + pixels, planes.data() + 2 * pixels,
                  planes.data() + 3 * pixels};
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: costs at labels", 4 * values, values}, [&] {
    take_costs<<<grid_of(costs), kThreads, 0, stream.get()>>>(costs, on_device.data(), to);
  });
  CostsAtLabels result;
  std::size_t number = 0;
  for (Image<float>* image : {&result.before, &result.here, &result.after, &result.mean}) {
    *image = Image<float>(labels.height(), labels.width());
    download_bytes(image->data(), planes.data() + number++ * pixels, pixels * sizeof(float), stream,
                   progress);
  }
  return result;
}

Image<int> least_labels(const DeviceVolume& volume, const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  Image<int> labels(costs.height, costs.width);
  DeviceArray<int> on_device(labels.size(), stream);
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: least labels", 4 * values, 2 * values}, [&] {
    find_least<<<grid_of(costs), kThreads, 0, stream.get()>>>(costs, on_device.data());
  });
  download_bytes(labels.data(), on_device.data(), on_device.byte_size(), stream, progress);
  return labels;
}

double sum_around_best(const DeviceVolume& volume, const std::uint8_t* valid, int reach,
                       const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  const auto pixels = static_cast<std::size_t>(costs.height) * costs.width;
  const auto mask = upload(valid, valid == nullptr ? 0 : pixels, stream, progress);
  const dim3 grid = grid_of(costs);
  std::vector<double> parts(static_cast<std::size_t>(grid.x) * grid.y);
  DeviceArray<double> on_device(parts.size(), stream);
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: cost unit", 4 * values, 2 * values}, [&] {
    sum_best<<<grid, kThreads, 0, stream.get()>>>(costs, mask.data(), reach, on_device.data());
  });
  download_bytes(parts.data(), on_device.data(), on_device.byte_size(), stream, progress);
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

struct StereoMatcher::State {
  std::shared_ptr<const DeviceLightField> compared, shown;
  ViewIndex view;
  DeviceStream stream;
  DeviceArray<float> samples_of_views, noise, guide, caps, surfaces;
  Visibility visibility;
  float mean_cap = 0;
  ViewPlanes planes;
  int radius = 0;

  [[nodiscard]] const DeviceSamples& samples() const { return compared->samples(); }
  [[nodiscard]] DeviceMatching on_device(const StereoMatching& matching) const {
    return {matching, planes, noise.data(), stream};
  }
  [[nodiscard]] CostRows with_margin(const CostRows& rows) const;
  void compute(const MatchingTables& tables, const CostRows& rows, float* costs,
               const Progress& progress) const;
  void aggregate(const CostRows& from, const float* costs, const CostRows& to,
                 float* filtered) const;
};

// The rows that aggregation needs.
CostRows StereoMatcher::State::with_margin(const CostRows& rows) const {
  const int first = std::max(rows.first - 2 * radius, 0);
  const int end = std::min(rows.first + rows.rows + 2 * radius, samples().height);
  return {first, end - first, rows.labels};
}

// Piece by piece, so that a stop request need not wait long.
void StereoMatcher::State::compute(const MatchingTables& tables, const CostRows& rows, float* costs,
                                   const Progress& progress) const {
  const double row_samples =
      static_cast<double>(samples().width) * tables.labels * tables.view_count;
  const int at_once = std::max(kLeastBandRows, static_cast<int>(kSamplesAtOnce / row_samples) /
                                                   kLeastBandRows * kLeastBandRows);
  const bool is_long = rows.rows > at_once;
  for (int row = 0; row < rows.rows; row += at_once) {
    progress.check();
    const std::size_t begin = static_cast<std::size_t>(row) * rows.labels * samples().width;
    compute_costs(tables, rows.first + row, std::min(at_once, rows.rows - row), costs + begin,
                  stream);
    if (is_long) stream.wait();
    progress.report(static_cast<double>(row + at_once) / rows.rows);
  }
}

void StereoMatcher::State::aggregate(const CostRows& from, const float* costs, const CostRows& to,
                                     float* filtered) const {
  const DeviceGuide tables{guide.data(), radius, samples().height, samples().width,
                           shown->samples().channels};
  filter_costs(tables, from, costs, to, filtered, stream);
}

StereoMatcher::StereoMatcher(const LightField& compared, const LightField& shown, ViewIndex view,
                             bool is_cross_hair, const Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.shown = on_device(shown, progress);
  s.compared =
      &compared == &shown ? s.shown : std::make_shared<DeviceLightField>(compared, progress);
  s.view = view;
  const DeviceSamples& samples = s.samples();
  s.planes = {nullptr,       samples.grid,    view, is_cross_hair, samples.height,
              samples.width, samples.channels};
  s.samples_of_views = make_view_planes(samples, s.planes, s.stream);
  s.planes.planes = s.samples_of_views.data();
}
StereoMatcher::~StereoMatcher() = default;

std::vector<float> StereoMatcher::least_costs(const StereoMatching& matching,
                                              const std::vector<int>& rows, float most,
                                              const std::vector<int>& ranks,
                                              const Progress& progress) {
  State& s = *state_;
  progress.check();
  const DeviceMatching tables = s.on_device(matching);
  const auto on_device = upload(rows.data(), rows.size(), s.stream, progress);
  DeviceArray<float> found(rows.size() * s.samples().width, s.stream);
  find_least_costs(tables.tables(), s.samples(), on_device.data(), static_cast<int>(rows.size()),
                   most, found.data(), s.stream);
  return ranked_on_device(found.data(), static_cast<int>(found.size()), ranks, s.stream);
}

void StereoMatcher::compensate_noise(float most, const Progress& progress) {
  State& s = *state_;
  progress.check();
  s.noise = local_noise_on_device(s.samples(), s.view, most, s.stream);
}

float StereoMatcher::median_noise() const {
  const State& s = *state_;
  if (s.noise.empty()) return 0;
  return median_on_device(s.noise.data(), static_cast<int>(s.noise.size()), s.stream);
}

float StereoMatcher::noise_variance(const Progress& progress) const {
  progress.check();
  const DeviceArray<float> noise =
      local_noise_on_device(state_->shown->samples(), state_->view,
                            std::numeric_limits<float>::infinity(), state_->stream);
  return median_on_device(noise.data(), static_cast<int>(noise.size()), state_->stream);
}

void StereoMatcher::aggregate(int radius, double regularization) {
  State& s = *state_;
  s.radius = radius;
  s.guide = make_guide_planes(s.shown->samples(), s.view, radius, regularization, s.stream);
}

void StereoMatcher::choose(const StereoMatching& matching, const LabelPlaces& places,
                           ImageView<float> disparity, ImageView<float> confidence,
                           const Progress& progress) {
  State& s = *state_;
  const DeviceMatching tables = s.on_device(matching);
  const int height = s.samples().height, width = s.samples().width;
  const std::size_t row_size = static_cast<std::size_t>(matching.labels) * width;
  const int fit = static_cast<int>(kBandBytes / (row_size * sizeof(float)));
  const int at_once = std::min(height, std::max(fit, kLeastBandRows));
  const int margins = std::min(height, at_once + 4 * s.radius);
  DeviceArray<float> costs(margins * row_size, s.stream);
  DeviceArray<float> filtered(s.radius > 0 ? at_once * row_size : 0, s.stream);
  const std::size_t pixels = static_cast<std::size_t>(height) * width;
  DeviceArray<float> maps(2 * pixels, s.stream);
  for (int y = 0; y < height; y += at_once) {
    const CostRows rows{y, std::min(at_once, height - y), matching.labels};
    const CostRows needed = s.with_margin(rows);
    const Progress part =
        progress.part(static_cast<double>(y) / height, static_cast<double>(y + rows.rows) / height);
    s.compute(tables.tables(), needed, costs.data(), part);
    if (s.radius > 0) s.aggregate(needed, costs.data(), rows, filtered.data());
    const VolumeView<const float> band{s.radius > 0 ? filtered.data() : costs.data(), rows.rows,
                                       matching.labels, width};
    float* const from_y = maps.data() + static_cast<std::size_t>(y) * width;
    choose_winners(band, places, from_y, from_y + pixels, s.stream);
  }
  // Memory that was never touched takes as long as the costs: meanwhile.
  for (const ImageView<float>& map : {disparity, confidence}) std::fill_n(map.data, pixels, 0.0F);
  PipelinedDownload download(s.stream, progress);
  download.add(disparity.data, maps.data(), pixels * sizeof(float));
  download.add(confidence.data, maps.data() + pixels, pixels * sizeof(float));
  download.finish();
}

Image<float> StereoMatcher::noise(const Progress& progress) const {
  const State& s = *state_;
  if (s.noise.empty()) return {};
  Image<float> noise(s.samples().height, s.samples().width);
  download_bytes(noise.data(), s.noise.data(), s.noise.byte_size(), s.stream, progress);
  return noise;
}

void StereoMatcher::set_caps(const Image<float>& caps, const Progress& progress) {
  State& s = *state_;
  s.caps = upload(caps.data(), caps.size(), s.stream, progress);
  s.visibility.caps = s.caps.data();
  s.mean_cap = static_cast<float>(std::accumulate(caps.begin(), caps.end(), 0.0) /
                                  static_cast<double>(caps.size()));
}

void StereoMatcher::set_occluders(const Image<float>& surface, float tolerance, float softness,
                                  const Progress& progress) {
  State& s = *state_;
  const auto disparity = upload(surface.data(), surface.size(), s.stream, progress);
  s.surfaces = {};  // before the next ones take their place
  s.surfaces = cast_surfaces(s.planes, disparity.data(), s.stream);
  s.visibility.nearest = s.surfaces.data();
  s.visibility.tolerance = tolerance;
  s.visibility.softness = softness;
}

SharedVolume StereoMatcher::volume(const StereoMatching& matching, const Progress& progress) {
  State& s = *state_;
  const DeviceMatching tables(matching, s.planes, s.noise.data(), s.stream, s.visibility);
  const CostRows all{0, s.samples().height, matching.labels};
  const auto make = [&] {
    return std::make_shared<DeviceVolume>(all.rows, all.labels, s.samples().width);
  };
  // The stream of a volume frees it; what is written here comes after its allocation there.
  auto costs = make();
  costs->stream.wait();
  s.compute(tables.tables(), all, costs->values.data(), progress);
  if (s.radius > 0) {
    auto filtered = make();
    filtered->stream.wait();
    s.aggregate(all, costs->values.data(), all, filtered->values.data());
    s.stream.wait();
    costs = std::move(filtered);
  }
  if (s.visibility.caps != nullptr) {
    divide_by_caps(*costs, s.visibility.caps, s.mean_cap, s.stream);
  }
  s.stream.wait();
  return costs;
}

}  // namespace episcope::cuda
