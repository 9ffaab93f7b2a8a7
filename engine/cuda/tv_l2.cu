// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/tv_l2.cuh"
#include "engine/cuda/tv_l2_iteration.cuh"
#include "engine/cuda/tv_l2_multigrid.cuh"
#include "engine/cuda/tv_l2_steps.cuh"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/solvers/shared_constants.h"
#include "engine/solvers/tv_l2.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::cuda {
namespace {

// Iterations between two looks whether the run is to end.
constexpr int kTgvCheckEvery = 25;

// What the solver holds, planes `[y][x]`: q is the dual of ∇u − p, r of ℰp (xx, yy, and xy twice).
struct Planes {
  int height = 0, width = 0;
  const float* f = nullptr;
  const float* w = nullptr;
  const float* g = nullptr;
  float *u, *ahead_u, *px, *py, *ahead_px, *ahead_py, *qx, *qy, *rxx, *ryy, *rxy;
};

struct Place {
  int y, x;
  long at;
  bool is_inside;
};
__device__ Place place_of(const Planes& planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  return {y, x, static_cast<long>(y) * planes.width + x, x < planes.width && y < planes.height};
}

__global__ void move_duals(Planes planes, float bend) {
  const Place place = place_of(planes);
  if (!place.is_inside) return;
  const long at = place.at, width = planes.width;
  const float limit = planes.g[at];
  const float here = planes.ahead_u[at];
  const float px = planes.ahead_px[at], py = planes.ahead_py[at];
  float qx = planes.qx[at], qy = planes.qy[at];
  if (place.x + 1 < planes.width) qx += kTgvStep * (planes.ahead_u[at + 1] - here - px);
  if (place.y + 1 < planes.height) qy += kTgvStep * (planes.ahead_u[at + width] - here - py);
  const float shrink = 1 / fmaxf(1.0F, sqrtf(qx * qx + qy * qy) / limit);
  planes.qx[at] = qx * shrink;
  planes.qy[at] = qy * shrink;
  const long left = place.x > 0 ? at - 1 : at, above = place.y > 0 ? at - width : at;
  const float xx = planes.rxx[at] + kTgvStep * (px - planes.ahead_px[left]);
  const float yy = planes.ryy[at] + kTgvStep * (py - planes.ahead_py[above]);
  const float xy =
      planes.rxy[at] + kTgvStep * 0.5F * (px - planes.ahead_px[above] + py - planes.ahead_py[left]);
  const float size = sqrtf(xx * xx + yy * yy + 2 * xy * xy);
  const float shrink_r = 1 / fmaxf(1.0F, size / (bend * limit));
  planes.rxx[at] = xx * shrink_r;
  planes.ryy[at] = yy * shrink_r;
  planes.rxy[at] = xy * shrink_r;
}

__global__ void move_unknowns(Planes planes, float inverse_lambda) {
  const Place place = place_of(planes);
  if (!place.is_inside) return;
  const long at = place.at, width = planes.width;
  const bool has_right = place.x + 1 < planes.width, has_below = place.y + 1 < planes.height;
  const bool has_left = place.x > 0, has_above = place.y > 0;
  const float qx = has_right ? planes.qx[at] : 0.0F, qy = has_below ? planes.qy[at] : 0.0F;
  float divergence = qx;
  if (has_left) divergence -= planes.qx[at - 1];
  divergence += qy;
  if (has_above) divergence -= planes.qy[at - width];
  const float c = kTgvStep * inverse_lambda * planes.w[at], u = planes.u[at];
  const float moved = (u + kTgvStep * divergence + c * planes.f[at]) / (1 + c);
  planes.ahead_u[at] = 2 * moved - u;
  planes.u[at] = moved;
  // Of r, minus the adjoint of ℰ: backward differences, none across the first row and column.
  const auto along = [&](const float* r) {
    return (has_right ? r[at + 1] : 0.0F) - (has_left ? r[at] : 0.0F);
  };
  const auto down = [&](const float* r) {
    return (has_below ? r[at + width] : 0.0F) - (has_above ? r[at] : 0.0F);
  };
  const float old_x = planes.px[at], old_y = planes.py[at];
  const float px = old_x + kTgvStep * (qx + (along(planes.rxx) + down(planes.rxy)));
  const float py = old_y + kTgvStep * (qy + (along(planes.rxy) + down(planes.ryy)));
  planes.ahead_px[at] = 2 * px - old_x;
  planes.ahead_py[at] = 2 * py - old_y;
  planes.px[at] = px;
  planes.py[at] = py;
}

DeviceArray<float> upload_or_ones(ImageView<const float> image, std::size_t size,
                                  const DeviceStream& stream, const Progress& progress) {
  if (!image.empty()) return upload(image.data, size, stream, progress);
  const Image<float> ones(1, static_cast<int>(size), 1, 1.0F);
  return upload(ones.data(), size, stream, progress);
}

constexpr int kCheckEvery = TvL2Options{}.check_every;

// The data term from images `[view][y][x]`.
struct Load {
  TvL2Level level;
  TvL2Images images;
  float inverse_lambda = 1;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      const long from = (static_cast<long>(view) * level.height + y) * level.width + x;
      const long to = level.at(y, x);
      const float value = images.f[from];
      const bool known = isfinite(value);
      const float weight = known ? (images.w ? images.w[from] : 1.0F) : 0.0F;
      const float c = fmaxf(weight, kTvL2MinWeight) * inverse_lambda;
      level.of(TvL2Plane::C, view)[to] = c;
      level.of(TvL2Plane::Cf, view)[to] = known ? c * value : 0.0F;
      level.of(TvL2Plane::G, view)[to] = images.g ? fmaxf(images.g[from], kTvL2MinWeight) : 1.0F;
    });
  }
};

struct Center {
  TvL2Level level;
  const TvL2View* views;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      const long at = level.at(y, x);
      level.of(TvL2Plane::Cf, view)[at] -= views[view].offset * level.of(TvL2Plane::C, view)[at];
    });
  }
};

// u to an image `[view][y][x]`.
struct Unload {
  TvL2Level level;
  const TvL2View* views;
  float* u;

  __device__ void operator()(int view, int y, int i) const {
    for_pixels(level, i, [&](int x) {
      u[(static_cast<long>(view) * level.height + y) * level.width + x] =
          level.of(TvL2Plane::U, view)[level.at(y, x)] + views[view].offset;
    });
  }
};

// Of the free memory, what the solver may take.
constexpr double kShare = 0.8;

// Views that fit at once, at least one.
int views_at_once(const DeviceSamples& samples, int wanted) {
  std::size_t free = 0, total = 0;
  check(cudaMemGetInfo(&free, &total));
  const std::size_t pixels = static_cast<std::size_t>(samples.height) * samples.width;
  const std::size_t each =
      TvL2Grids::bytes_per_view(samples.height, samples.width) + 2 * pixels * sizeof(float);
  const auto fit = static_cast<std::size_t>(kShare * static_cast<double>(free)) / each;
  return std::clamp(static_cast<int>(std::min<std::size_t>(fit, 1 << 20)), 1, wanted);
}

// Which views kernels work on: block z is number `first` + z of the mapped ones.
struct Views {
  DeviceSamples samples;
  MappedViews mapped;
  int first = 0;

  [[nodiscard]] __device__ long pixel(int number, int y, int x) const {
    const int at = first + number;
    return samples.pixel(mapped.first.v + at / mapped.grid.u, mapped.first.u + at % mapped.grid.u,
                         y, x);
  }
};

__device__ long map_at(const DeviceSamples& samples, int number, int y, int x) {
  return (static_cast<long>(number) * samples.height + y) * samples.width + x;
}

// exp(−β |∇I|); 1 where an invalid pixel is part of the gradient.
__global__ void fill_edges(Views views, float strength, float* edges) {
  const DeviceSamples& samples = views.samples;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= samples.width || y >= samples.height) return;
  const int number = static_cast<int>(blockIdx.z);
  const long here = views.pixel(number, y, x);
  const long right = views.pixel(number, y, min(x + 1, samples.width - 1));
  const long below = views.pixel(number, min(y + 1, samples.height - 1), x);
  float energy = 0;
  for (int c = 0; c < samples.channels; ++c) {
    const float own = samples.at(here, c);
    const float dx = samples.at(right, c) - own, dy = samples.at(below, c) - own;
    energy += dx * dx + dy * dy;
  }
  const bool is_valid =
      samples.valid == nullptr ||
      (samples.valid[here] != 0 && samples.valid[right] != 0 && samples.valid[below] != 0);
  const float weight = strength == 0 ? 1.0F : expf(-strength * sqrtf(energy));
  edges[map_at(samples, number, y, x)] = is_valid ? weight : 1.0F;
}

// r^power, at least the minimum.
struct Power {
  double power = 1;
  float minimum = 0;

  [[nodiscard]] __device__ float operator()(float r) const {
    const int whole = static_cast<int>(power);
    float raised = 1;
    if (whole == power) {
      for (int i = 0; i < whole; ++i) raised *= r;
    } else {
      raised = powf(r, static_cast<float>(power));
    }
    return fmaxf(raised, minimum);
  }
};

__global__ void fill_data(const float* confidence, Power power, long count, float* data) {
  const long at = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (at < count) data[at] = power(confidence[at]);
}

// local_noise_variance of a map at a pixel: in the direction in which it is least, the mean square
// of second differences over a window.
struct MapNoise {
  const float* map;
  int height = 0, width = 0;

  [[nodiscard]] __device__ float square(int y, int x, int way_y, int way_x) const {
    const int row = min(max(y, 1), height - 2), column = min(max(x, 1), width - 2);
    const float* const here = map + static_cast<long>(row) * width + column;
    const long step = static_cast<long>(way_y) * width + way_x;
    const float d = here[-step] - 2 * here[0] + here[step];
    return d * d / kSecondDifference;
  }
  [[nodiscard]] __device__ float window(int y, int x, int way_y, int way_x) const {
    const int top = max(y - kNoiseRadius, 0), bottom = min(y + kNoiseRadius, height - 1);
    const int left = max(x - kNoiseRadius, 0), right = min(x + kNoiseRadius, width - 1);
    float sum = 0;
    for (int i = left; i <= right; ++i) {
      for (int j = top; j <= bottom; ++j) sum += square(j, i, way_y, way_x);
    }
    return sum / static_cast<float>((right - left + 1) * (bottom - top + 1));
  }
  [[nodiscard]] __device__ float operator()(int y, int x) const {
    if (height < 3 || width < 3) return 0;
    return fminf(fminf(window(y, x, 0, 1), window(y, x, 1, 0)),
                 fminf(window(y, x, 1, 1), window(y, x, 1, -1)));
  }
};

// More weight where the map is trusted and its noise is less than `noise`: see `denoise`.
__global__ void raise_steady(DeviceSamples samples, const float* disparity, float noise,
                             float* data) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= samples.width || y >= samples.height) return;
  const long at = map_at(samples, static_cast<int>(blockIdx.z), y, x);
  const MapNoise variance{disparity + map_at(samples, static_cast<int>(blockIdx.z), 0, 0),
                          samples.height, samples.width};
  const float own = sqrtf(variance(y, x));
  const float more = fmaxf(noise / fmaxf(own, noise / kMostSteadyGain), 1.0F) - 1;
  data[at] *= 1 + more * fminf(data[at] / kTrustedWeight, 1.0F);
}

constexpr int kIterations = TvL2Options{}.max_iterations;
constexpr double kGap = TvL2Options{}.gap;

}  // namespace

void solve_tgv_l2(Image<float>& f, const TgvTask& task, int iterations, const Progress& progress) {
  constexpr int kPlanes = 11;
  const DeviceStream stream;
  const std::size_t size = f.size();
  const auto observed = upload(f.data(), size, stream, progress);
  const auto w = upload_or_ones(task.w, size, stream, progress);
  const auto g = upload_or_ones(task.g, size, stream, progress);
  DeviceArray<float> memory(kPlanes * size, stream);
  memory.clear();
  const auto plane = [&](int number) { return memory.data() + number * size; };
  const Planes planes{f.height(), f.width(), observed.data(), w.data(), g.data(), plane(0),
                      plane(1),   plane(2),  plane(3),        plane(4), plane(5), plane(6),
                      plane(7),   plane(8),  plane(9),        plane(10)};
  for (float* const start : {planes.u, planes.ahead_u}) {
    check(cudaMemcpyAsync(start, observed.data(), observed.byte_size(), cudaMemcpyDeviceToDevice,
                          stream.get()));
  }
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(f.width(), 32), blocks_for(f.height(), 8));
  const auto pixels = static_cast<double>(size);
  for (int i = 0; i < iterations && !progress.finish_requested(); ++i) {
    launch(stream, {"tgv: duals", pixels * 56, pixels * 50}, [&] {
      move_duals<<<grid, block, 0, stream.get()>>>(planes, static_cast<float>(task.bend));
    });
    launch(stream, {"tgv: unknowns", pixels * 72, pixels * 40}, [&] {
      move_unknowns<<<grid, block, 0, stream.get()>>>(planes, static_cast<float>(1 / task.lambda));
    });
    if (i % kTgvCheckEvery != kTgvCheckEvery - 1) continue;
    stream.wait();
    progress.check();
    progress.report(static_cast<double>(i + 1) / iterations);
  }
  download_bytes(f.data(), planes.u, size * sizeof(float), stream, progress);
}

TvL2DeviceSolver::TvL2DeviceSolver(int height, int width, int views, const DeviceStream& stream)
    : stream_(stream), grids_(height, width, views, stream) {
  const TvL2Levels& levels = grids_.levels();
  while (first_of_tail_ + 1 < levels.count && !fits_in_tail(levels, first_of_tail_))
    ++first_of_tail_;
  const std::size_t count =
      static_cast<std::size_t>(views) * chunks_of(levels.level[0]) * kTvL2Sums;
  sums_ = DeviceArray<double>(count, stream);
  host_sums_.resize(count);
}

TvL2Level TvL2DeviceSolver::level(int k, int stage) const {
  TvL2Level level = grids_.levels().level[k];
  level.data_scale = static_cast<float>(1 << (k - stage));
  return level;
}

template <class Step>
void TvL2DeviceSolver::run(const char* name, const Step& step, const TvL2Level& level,
                           double floats, double operations) {
  run_on_grid(stream_, name, step, extent_of(level), grids_.views(), grids_.of_views(), floats,
              operations);
}

template <class Step>
void TvL2DeviceSolver::run_cells(const char* name, const Step& step, const TvL2Level& coarse,
                                 double floats, double operations) {
  run_on_grid(stream_, name, step, cells_of(coarse), grids_.views(), grids_.of_views(), floats,
              operations);
}

void TvL2DeviceSolver::load(const TvL2Images& problem) {
  views_.assign(grids_.views(), {});
  grids_.set_views(views_, stream_);
  const TvL2Level finest = level(0, 0);
  run("tv_l2: load", Load{finest, problem, static_cast<float>(1 / problem.lambda)}, finest, 12, 6);
  sum_moments(stream_, finest, grids_.views(), sums_.data());
  center();
  for (int k = 1; k < grids_.levels().count; ++k) {
    run("tv_l2: coarser problem", CoarsenProblem{level(k - 1, k - 1), level(k, k)}, level(k, k), 30,
        24);
  }
}

// Takes the mean off the data, and fits the penalty to their spread.
void TvL2DeviceSolver::center() {
  measure();
  const int chunks = chunks_of(level(0, 0));
  for (std::size_t v = 0; v < views_.size(); ++v) {
    double sums[kTvL2Sums] = {};
    for (int i = 0; i < chunks * kTvL2Sums; ++i) {
      sums[i % kTvL2Sums] += host_sums_[v * chunks * kTvL2Sums + i];
    }
    const double mean = sums[1] / sums[0], variance = sums[2] / sums[0] - mean * mean;
    const float spread = variance > 1e-12 ? static_cast<float>(std::sqrt(variance)) : 1.0F;
    views_[v].offset = static_cast<float>(mean);
    views_[v].scale = kTvL2PenaltyScale / spread;
    views_[v].knee = kTvL2PenaltyKnee * spread;
  }
  grids_.set_views(views_, stream_);
  run("tv_l2: center", Center{level(0, 0), grids_.of_views()}, level(0, 0), 6, 4);
}

// Brings the sums of all chunks to the host.
void TvL2DeviceSolver::measure() {
  check(cudaMemcpyAsync(host_sums_.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                        stream_.get()));
  stream_.wait();
}

void TvL2DeviceSolver::renew_penalty(int stage, bool first) {
  const TvL2Level solved = level(stage, stage);
  run("tv_l2: penalty", Penalize{solved, grids_.of_views(), first}, solved, 20, 60);
  for (int k = stage + 1; k < first_of_tail_; ++k) {
    run_cells("tv_l2: coarser penalty",
              CoarsenPenalty{level(k - 1, stage), level(k, stage), grids_.of_views()},
              level(k, stage), 6, 4);
    run("tv_l2: diagonal", InvertDiagonal{level(k, stage)}, level(k, stage), 8, 14);
  }
  renew_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()}, stage);
}

// The correction of level stage + 1.
void TvL2DeviceSolver::correct(int stage) {
  for (int k = stage + 1; k < first_of_tail_; ++k) {
    descend_level(stream_, level(k, stage), level(k + 1, stage), grids_.views(), grids_.of_views());
  }
  correct_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()},
               stage);
  for (int k = first_of_tail_; --k > stage;) {
    ascend_level(stream_, level(k, stage), level(k + 1, stage), grids_.views(), grids_.of_views());
  }
}

void TvL2DeviceSolver::iterate(int stage, int iteration, const Progress& progress) {
  progress.check();
  if (iteration % kTvL2PenaltyEvery == 0) renew_penalty(stage, iteration == 0);
  if (iteration > 0) correct(stage);
  const TvL2Level solved = level(stage, stage);
  const auto run = has_enough_strips(solved, grids_.views()) ? iterate_by_strips : iterate_by_tiles;
  run(stream_, solved, level(stage + 1, stage), grids_.views(), grids_.of_views(), iteration == 0);
  grids_.swap_moved(stage);
}

// Coarse to fine, up to the start of the finest level.
void TvL2DeviceSolver::climb(const Progress& progress) {
  const int count = grids_.levels().count;
  climb_tail(stream_, {grids_.levels(), first_of_tail_, grids_.views(), grids_.of_views()},
             kTvL2CoarseCycles, kTvL2PenaltyEvery);
  // Of a tail that is the single pixel alone, nothing was solved.
  int stage = std::min(first_of_tail_, count - 2);
  if (stage < first_of_tail_)
    run("tv_l2: start", StartFromData{level(stage, stage)}, level(stage, stage), 12, 2);
  for (; stage > 0; --stage) {
    if (stage < first_of_tail_) {
      for (int i = 0; i < kTvL2CoarseCycles; ++i) iterate(stage, i, progress);
      run("tv_l2: project", Project{level(stage, stage)}, level(stage, stage), 10, 14);
    }
    const TvL2Level fine = level(stage - 1, stage - 1);
    run("tv_l2: prolong", Prolong{level(stage, stage), fine}, fine, 12, 40);
    run("tv_l2: project", Project{fine}, fine, 10, 14);
  }
}

// Ends views that have converged, and slows those down whose gap grows.
void TvL2DeviceSolver::judge(double gap, std::vector<double>& gaps_before) {
  sum_energies(stream_, level(0, 0), grids_.views(), sums_.data());
  measure();
  const int chunks = chunks_of(level(0, 0));
  for (std::size_t v = 0; v < views_.size(); ++v) {
    TvL2Outcome& outcome = outcomes_[v];
    if (views_[v].is_active == 0) continue;
    double energy = 0, dual = 0;
    for (int i = 0; i < chunks; ++i) {
      energy += host_sums_[(v * chunks + i) * kTvL2Sums];
      dual += host_sums_[(v * chunks + i) * kTvL2Sums + 1];
    }
    outcome.energy = energy;
    outcome.gap = energy - dual;
    outcome.converged = outcome.gap <= gap * energy;
    if (outcome.converged) views_[v].is_active = 0;
    if (outcome.gap > 2 * gaps_before[v]) {
      views_[v].coarse_edge = views_[v].relaxation = kTvL2SafePace;
    }
    gaps_before[v] = outcome.gap;
  }
  grids_.set_views(views_, stream_);
}

std::vector<TvL2Outcome> TvL2DeviceSolver::solve(const TvL2Images& problem, int max_iterations,
                                                 double gap, const Progress& progress, float* u) {
  load(problem);
  climb(progress);
  outcomes_.assign(grids_.views(), {});
  std::vector<double> gaps_before(grids_.views(), std::numeric_limits<double>::infinity());
  const auto is_active = [](const TvL2View& view) { return view.is_active != 0; };
  bool is_last = false;
  for (int i = 0; !is_last && std::ranges::any_of(views_, is_active); ++i) {
    is_last = i + 1 >= max_iterations || progress.finish_requested();
    iterate(0, i, progress);
    for (std::size_t v = 0; v < views_.size(); ++v) outcomes_[v].iterations += views_[v].is_active;
    if (is_last || (i + 1) % kCheckEvery == 0) judge(gap, gaps_before);
    progress.report(static_cast<double>(i + 1) / max_iterations);
  }
  for (TvL2View& view : views_) view.is_active = 1;
  grids_.set_views(views_, stream_);
  run("tv_l2: unload", Unload{level(0, 0), grids_.of_views(), u}, level(0, 0), 4, 2);
  return outcomes_;
}

std::vector<double> denoise_on_device(const DeviceSamples& samples, const MappedViews& views,
                                      const MapDenoising& denoising, const float* confidence,
                                      float* disparity, const DeviceStream& stream,
                                      const Progress& progress) {
  const int count = views.grid.count();
  const int at_once = views_at_once(samples, count);
  const std::size_t pixels = static_cast<std::size_t>(samples.height) * samples.width;
  DeviceArray<float> data(at_once * pixels, stream), edges(at_once * pixels, stream);
  std::vector<double> gaps;
  for (int first = 0; first < count; first += at_once) {
    const int now = std::min(at_once, count - first);
    float* const maps = disparity + first * pixels;
    fill_weights(samples, views, first, now, denoising, confidence + first * pixels, maps,
                 {data.data(), edges.data()}, stream);
    TvL2DeviceSolver solver(samples.height, samples.width, now, stream);
    const Progress part =
        progress.part(static_cast<double>(first) / count, static_cast<double>(first + now) / count);
    for (const TvL2Outcome& outcome :
         solver.solve({maps, data.data(), edges.data(), denoising.lambda}, denoising.max_iterations,
                      denoising.gap, part, maps)) {
      gaps.push_back(outcome.relative_gap());
    }
  }
  return gaps;
}

void fill_weights(const DeviceSamples& samples, const MappedViews& views, int first, int count,
                  const MapDenoising& denoising, const float* confidence, const float* disparity,
                  const DenoisingWeights& weights, const DeviceStream& stream) {
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(samples.width, 32), blocks_for(samples.height, 8),
                  static_cast<unsigned>(count));
  const double pixels = static_cast<double>(samples.height) * samples.width * count;
  const auto strength =
      static_cast<float>(denoising.edge_strength * std::sqrt(channel_weight(samples.channels)));
  launch(stream, {"denoise: edges", pixels * (samples.channels + 4), pixels * 20}, [&] {
    fill_edges<<<grid, block, 0, stream.get()>>>({samples, views, first}, strength, weights.edges);
  });
  const auto all = static_cast<long>(pixels);
  const Power power{denoising.weight_power, denoising.min_weight};
  launch(stream, {"denoise: weights", pixels * 8, pixels * 7}, [&] {
    fill_data<<<blocks_for(all, 256), 256, 0, stream.get()>>>(confidence, power, all, weights.data);
  });
  if (!(denoising.map_noise > 0)) return;
  launch(stream, {"denoise: steady pixels", pixels * 12, pixels * 600}, [&] {
    raise_steady<<<grid, block, 0, stream.get()>>>(samples, disparity, denoising.map_noise,
                                                   weights.data);
  });
}

std::vector<double> denoise_maps(const LightField& lf, const MapDenoising& denoising,
                                 const ViewStack<float>& confidence, ViewStack<float>& disparity,
                                 const Progress& progress) {
  const auto light_field = on_device(lf, progress);
  const DeviceStream stream;
  const auto weights = upload(confidence.data(), confidence.size(), stream, progress);
  auto maps = upload(disparity.data(), disparity.size(), stream, progress);
  const std::vector<double> gaps =
      denoise_on_device(light_field->samples(), {disparity.grid(), disparity.first()}, denoising,
                        weights.data(), maps.data(), stream, progress);
  download(disparity, maps, stream, progress);
  return gaps;
}

std::vector<double> denoise_maps(const LightField& lf, const MapDenoising& denoising,
                                 DeviceMaps& maps, const Progress& progress) {
  MapMemory& memory = maps.memory();
  return denoise_on_device(memory.samples(lf, progress), {memory.grid, memory.first}, denoising,
                           memory.confidence.data(), memory.disparity.data(), memory.stream,
                           progress);
}

void solve_tv_l2(Image<float>& f, const Image<float>& w, ImageView<const float> g, double lambda,
                 const Progress& progress) {
  const DeviceStream stream;
  auto map = upload(f.data(), f.size(), stream, progress);
  const auto weights = upload(w.data(), w.size(), stream, progress);
  const auto edges = upload(g.data, f.size(), stream, progress);
  TvL2DeviceSolver solver(f.height(), f.width(), 1, stream);
  (void)solver.solve({map.data(), weights.data(), edges.data(), lambda}, kIterations, kGap,
                     progress, map.data());
  download_bytes(f.data(), map.data(), map.byte_size(), stream, progress);
}

}  // namespace episcope::cuda
