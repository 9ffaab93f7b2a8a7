// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/ray_labels.h"

#include "engine/cuda/device.cuh"
#include "engine/cuda/simplex_moves.cuh"

#include <algorithm>
#include <utility>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
// Labels that a thread sums up at once, in registers.
constexpr int kLabels = 16;
// Steps down a tree, for the count of operations.
constexpr double kTypicalDepth = 10;

struct Trees {
  const TreeNode* nodes;
  const int* roots;
  const int* votes_of;
  const float* votes;
  int count, pitch;
};

// The node of a tree, counted over all, in which a pixel ends whose features lie `stride` apart.
__device__ int leaf_of(const Trees& trees, int tree, const float* features, int stride) {
  const TreeNode* const nodes = trees.nodes + trees.roots[tree];
  int at = 0;
  for (;;) {
    const TreeNode node = nodes[at];
    const int next = node.next + (features[node.feature * stride] > node.threshold ? 1 : 0);
    if (next == at) return trees.roots[tree] + at;
    at = next;
  }
}

// Every thread keeps the features of its pixel in shared memory.
__global__ void walk(Trees trees, VolumeView<const float> features, float* out) {
  extern __shared__ float shared[];
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  if (x >= features.width) return;
  float* const values = shared + thread;
  for (int f = 0; f < features.layers; ++f) {
    values[f * stride] =
        features.data[(static_cast<long>(y) * features.layers + f) * features.width + x];
  }
  const int first = static_cast<int>(blockIdx.z) * kLabels;
  const int quads = min(kLabels, trees.pitch - first) / 4;
  float4 sums[kLabels / 4] = {};
  for (int tree = 0; tree < trees.count; ++tree) {
    const long leaf = trees.votes_of[leaf_of(trees, tree, values, stride)];
    const auto* const votes =
        reinterpret_cast<const float4*>(trees.votes + leaf * trees.pitch + first);
#pragma unroll
    for (int i = 0; i < kLabels / 4; ++i) {
      if (i >= quads) continue;
      const float4 vote = votes[i];
      sums[i].x += vote.x;
      sums[i].y += vote.y;
      sums[i].z += vote.z;
      sums[i].w += vote.w;
    }
  }
  const float scale = 1.0F / static_cast<float>(trees.count);
  auto* const to = reinterpret_cast<float4*>(
      out + (static_cast<long>(y) * features.width + x) * trees.pitch + first);
#pragma unroll
  for (int i = 0; i < kLabels / 4; ++i) {
    if (i >= quads) continue;
    to[i] = {sums[i].x * scale, sums[i].y * scale, sums[i].z * scale, sums[i].w * scale};
  }
}

// What is known of all views, on the device: borrowed. Null where nothing is.
struct ViewRays {
  GridShape grid;
  int height = 0, width = 0, layers = 0, channels = 0;
  const std::uint8_t* probabilities = nullptr;  // `[view][y][label][x]`
  const float *weights = nullptr, *disparity = nullptr;
  const std::uint8_t *valid = nullptr, *colors = nullptr;
  const std::int32_t* painted = nullptr;
  float price_of_held = 0;
  const float* costs = nullptr;   // 256
  const float* trusts = nullptr;  // most_difference + 1
  int most_difference = 0;
  float tolerance_px = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
  // The pixel of another view at which the ray of pixel (y, x) arrives, −1 if its point is not
  // seen there: find_ray_targets of engine/labeling/ray_labeling.h, to the same bits.
  [[nodiscard]] __device__ std::int32_t target(int view, int other, int y, int x) const {
    const long here = view * pixels() + static_cast<long>(y) * width + x;
    const float d = disparity[here];
    const auto step_x = static_cast<float>(other % grid.u - view % grid.u);
    const auto step_y = static_cast<float>(other / grid.u - view / grid.u);
    const float at_x = __fadd_rn(__fsub_rn(static_cast<float>(x), __fmul_rn(d, step_x)), 0.5F);
    const float at_y = __fadd_rn(__fsub_rn(static_cast<float>(y), __fmul_rn(d, step_y)), 0.5F);
    if (!(at_x >= 0 && at_x < static_cast<float>(width) && at_y >= 0 &&
          at_y < static_cast<float>(height))) {
      return -1;
    }
    const std::int32_t target = static_cast<int>(at_y) * width + static_cast<int>(at_x);
    const long there = other * pixels() + target;
    if (!(fabsf(disparity[there] - d) <= tolerance_px)) return -1;
    if (valid != nullptr && (valid[here] == 0 || valid[there] == 0)) return -1;
    return target;
  }
  // RayColors::trust of a pixel and of one of another view.
  [[nodiscard]] __device__ float trust(int view, std::int32_t pixel, int other,
                                       std::int32_t target) const {
    if (colors == nullptr) return 1;
    const std::uint8_t* const a = colors + (view * pixels() + pixel) * channels;
    const std::uint8_t* const b = colors + (other * pixels() + target) * channels;
    int sum = 0;
    for (int c = 0; c < channels; ++c) {
      const int difference = static_cast<int>(a[c]) - static_cast<int>(b[c]);
      sum += difference * difference;
    }
    if (channels == 1) sum *= 3;
    return trusts[sum < most_difference ? sum : most_difference];
  }
};

class ViewRaysMemory {
 public:
  // Uploads everything. The stream must outlive it. Throws DeviceFailure, Cancelled.
  ViewRaysMemory(const RayLabelsTask& task, const DeviceStream& stream, const Progress& progress);

  [[nodiscard]] const ViewRays& rays() const { return rays_; }

 private:
  DeviceArray<std::uint8_t> probabilities_, valid_, colors_;
  DeviceArray<float> weights_, disparity_, costs_, trusts_;
  DeviceArray<std::int32_t> painted_;
  ViewRays rays_;
};

// One map after the other; empty if the first view has none.
template <class T, class Map>
DeviceArray<T> upload_views(const RayLabelsTask& task, std::size_t each, const Map& map_of,
                            const DeviceStream& stream, const Progress& progress) {
  if (map_of(task.views.front()) == nullptr) return {};
  DeviceArray<T> maps(each * task.views.size(), stream);
  for (std::size_t i = 0; i < task.views.size(); ++i) {
    upload_bytes(maps.data() + i * each, map_of(task.views[i]), each * sizeof(T), stream, progress);
  }
  return maps;
}

// Empty if nothing is painted in any view.
DeviceArray<std::int32_t> upload_painted(const RayLabelsTask& task, std::size_t pixels,
                                         const DeviceStream& stream, const Progress& progress) {
  const auto is_painted = [](const RayView& view) { return view.painted != nullptr; };
  if (std::none_of(task.views.begin(), task.views.end(), is_painted)) return {};
  DeviceArray<std::int32_t> maps(pixels * task.views.size(), stream);
  // Bytes of −1.
  check(cudaMemsetAsync(maps.data(), 0xFF, maps.size() * sizeof(std::int32_t), stream.get()));
  for (std::size_t i = 0; i < task.views.size(); ++i) {
    if (!is_painted(task.views[i])) continue;
    upload_bytes(maps.data() + i * pixels, task.views[i].painted, pixels * sizeof(std::int32_t),
                 stream, progress);
  }
  return maps;
}

ViewRaysMemory::ViewRaysMemory(const RayLabelsTask& task, const DeviceStream& stream,
                               const Progress& progress) {
  const auto& first = task.views.front().probabilities;
  const std::size_t pixels =
      static_cast<std::size_t>(first.height) * static_cast<std::size_t>(first.width);
  const auto upload_maps = [&]<class T>(const T* RayView::*map, std::size_t each) {
    return upload_views<T>(
        task, each, [map](const RayView& view) { return view.*map; }, stream, progress);
  };
  probabilities_ = upload_views<std::uint8_t>(
      task, first.size(), [](const RayView& view) { return view.probabilities.data; }, stream,
      progress);
  weights_ = upload_maps(&RayView::weights, pixels);
  disparity_ = upload_maps(&RayView::disparity, pixels);
  valid_ = upload_maps(&RayView::valid, pixels);
  colors_ = upload_maps(&RayView::colors, pixels * static_cast<std::size_t>(task.channels));
  costs_ = upload(task.costs.data(), task.costs.size(), stream, progress);
  if (!colors_.empty()) {
    trusts_ = upload(task.trusts.data(), task.trusts.size(), stream, progress);
  }
  painted_ = upload_painted(task, pixels, stream, progress);
  rays_.grid = task.grid;
  rays_.height = first.height;
  rays_.width = first.width;
  rays_.layers = first.layers;
  rays_.channels = task.channels;
  rays_.probabilities = probabilities_.data();
  rays_.weights = weights_.data();
  rays_.disparity = disparity_.data();
  rays_.valid = valid_.data();
  rays_.colors = colors_.data();
  rays_.painted = painted_.data();
  rays_.price_of_held = task.price_of_held;
  rays_.costs = costs_.data();
  rays_.trusts = trusts_.data();
  rays_.most_difference = static_cast<int>(task.trusts.size()) - 1;
  rays_.tolerance_px = task.tolerance_px;
}

// Which view each problem of a batch is of; of the one solved before, if any.
struct ProblemViews {
  int count = 0;
  std::int16_t view[kMostProblems] = {};
  std::int16_t last[kMostProblems] = {};
};

constexpr int kProbabilities = 256;

// The first of the `near` places nearest to `here` of `count`, as many at the border.
__device__ int first_near(int here, int near, int count) {
  return max(min(here - near / 2, count - near), 0);
}

// Adds the costs of another view's ray, weighted by its trust, which it returns.
__device__ float add_ray(const ViewRays& rays, int view, int other, int y, int x,
                         const float* costs, float* sums, int stride) {
  const std::int32_t target = rays.target(view, other, y, x);
  if (target < 0) return 0;
  const float trust = rays.trust(view, y * rays.width + x, other, target);
  if (trust == 0) return 0;
  const std::uint8_t* const p =
      rays.probabilities +
      (static_cast<long>(other) * rays.height + target / rays.width) * rays.layers * rays.width +
      target % rays.width;
  for (int l = 0; l < rays.layers; ++l) {
    sums[l * stride] =
        __fadd_rn(sums[l * stride], __fmul_rn(trust, costs[p[static_cast<long>(l) * rays.width]]));
  }
  return trust;
}

__global__ void fill(ViewRays rays, ProblemViews views, int near, SimplexFields fields) {
  extern __shared__ float shared[];
  float* const costs = shared;
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  for (int i = thread; i < kProbabilities; i += stride) costs[i] = rays.costs[i];
  __syncthreads();
  float* const sums = shared + kProbabilities + thread;
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const auto problem = static_cast<int>(blockIdx.z);
  if (x >= rays.width) return;
  const int view = views.view[problem];
  const std::uint8_t* const own =
      rays.probabilities + (static_cast<long>(view) * rays.height + y) * rays.layers * rays.width +
      x;
  for (int l = 0; l < rays.layers; ++l) {
    sums[l * stride] = costs[own[static_cast<long>(l) * rays.width]];
  }
  float weight = 1;
  const int v0 = first_near(view / rays.grid.u, near, rays.grid.v);
  const int u0 = first_near(view % rays.grid.u, near, rays.grid.u);
  for (int v = v0; v < min(v0 + near, rays.grid.v); ++v) {
    for (int u = u0; u < min(u0 + near, rays.grid.u); ++u) {
      const int other = v * rays.grid.u + u;
      if (other != view) weight += add_ray(rays, view, other, y, x, costs, sums, stride);
    }
  }
  float* const out = fields.cost + fields.unknown(problem, y, x);
  const long pixel = static_cast<long>(view) * rays.pixels() + static_cast<long>(y) * rays.width;
  const std::int32_t painted = rays.painted != nullptr ? rays.painted[pixel + x] : -1;
  for (int l = 0; l < rays.layers; ++l) {
    const float cost = __fdiv_rn(sums[l * stride], weight);
    const float held = l == painted ? 0 : rays.price_of_held;
    out[static_cast<long>(l) * rays.width] = painted < 0 ? cost : held;
  }
  fields.weights[fields.pixel(problem, y, x)] =
      rays.weights != nullptr ? rays.weights[pixel + x] : 1.0F;
}

__global__ void find(ViewRays rays, ProblemViews views, std::int32_t* places) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= rays.width) return;
  places[problem * rays.pixels() + static_cast<long>(y) * rays.width + x] =
      rays.target(views.view[problem], views.last[problem], y, x);
}

dim3 blocks(const ViewRays& rays, const ProblemViews& views, int threads) {
  return dim3(blocks_for(rays.width, threads), static_cast<unsigned>(rays.height),
              static_cast<unsigned>(views.count));
}

// Costs of the labels of each problem's view: of each ray by its own probabilities, or with
// `near` > 0 the mean over the rays of the same point in the nearest `near`² views, as
// `fill_track_costs` has it, to the same bits; and the weights of boundaries. Throws
// DeviceFailure.
void fill_problems(const ViewRays& rays, const ProblemViews& views, int near,
                   const SimplexFields& fields, const DeviceStream& stream) {
  const int threads = column_threads(rays.layers);
  const double pixels = static_cast<double>(rays.pixels()) * views.count;
  const double others = near > 0 ? near * near - 1 : 0;
  const std::size_t shared =
      sizeof(float) * static_cast<std::size_t>(kProbabilities + rays.layers * threads);
  // Views that several problems look at are in the cache for all but the first.
  launch(stream,
         {"labels: costs of rays", pixels * (5.0 * rays.layers + 4),
          pixels * others * (2.0 * rays.layers + 20)},
         [&] {
           fill<<<blocks(rays, views, threads), static_cast<unsigned>(threads), shared,
                  stream.get()>>>(rays, views, near, fields);
         });
}

// Where the pixels of each problem's view were in the one before, `[problem][y][x]`.
void find_places(const ViewRays& rays, const ProblemViews& views, std::int32_t* places,
                 const DeviceStream& stream) {
  const double pixels = static_cast<double>(rays.pixels()) * views.count;
  launch(stream, {"labels: places", 12 * pixels, 10 * pixels}, [&] {
    find<<<blocks(rays, views, kThreads), kThreads, 0, stream.get()>>>(rays, views, places);
  });
}

// The votes of one pixel, `stride` apart.
struct Ballot {
  const ViewRays& rays;
  const std::int32_t* labels;
  int view, y, x;
  float* votes;
  int stride;

  __device__ void add(int other) const {
    const std::int32_t target = rays.target(view, other, y, x);
    if (target < 0) return;
    float& votes_of = votes[labels[other * rays.pixels() + target] * stride];
    votes_of = __fadd_rn(votes_of, rays.trust(view, y * rays.width + x, other, target));
  }
};

__global__ void vote(ViewRays rays, const std::int32_t* labels, std::int32_t* decided) {
  extern __shared__ float shared[];
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const auto view = static_cast<int>(blockIdx.z);
  if (x >= rays.width) return;
  float* const votes = shared + thread;
  for (int l = 0; l < rays.layers; ++l) votes[l * stride] = 0;
  const Ballot ballot{rays, labels, view, y, x, votes, stride};
  const int v = view / rays.grid.u, u = view % rays.grid.u;
  for (int other = 0; other < rays.grid.u; ++other) {
    if (other != u) ballot.add(v * rays.grid.u + other);
  }
  for (int other = 0; other < rays.grid.v; ++other) {
    if (other != v) ballot.add(other * rays.grid.u + u);
  }
  const long at = view * rays.pixels() + static_cast<long>(y) * rays.width + x;
  const std::int32_t own = labels[at];
  if (rays.painted != nullptr && rays.painted[at] >= 0) {
    decided[at] = rays.painted[at];
    return;
  }
  votes[own * stride] += 1;
  int most = 0;
  for (int l = 1; l < rays.layers; ++l) {
    if (votes[l * stride] > votes[most * stride]) most = l;
  }
  decided[at] = votes[most * stride] > votes[own * stride] ? most : own;
}

// Labels of all views, `[view][y][x]`, after each ray has taken the label that most rays of its
// point in its row and column of the grid have: as `vote_along_rays` of
// engine/labeling/regularizer.h, to the same bits. Throws DeviceFailure.
void vote_along_rays(const ViewRays& rays, const std::int32_t* labels, std::int32_t* decided,
                     const DeviceStream& stream) {
  const int threads = column_threads(rays.layers);
  const dim3 blocks(blocks_for(rays.width, threads), static_cast<unsigned>(rays.height),
                    static_cast<unsigned>(rays.grid.count()));
  const double pixels = static_cast<double>(rays.pixels()) * rays.grid.count();
  const double others = rays.grid.u + rays.grid.v - 2;
  launch(stream, {"labels: votes", pixels * (12.0 + rays.channels), pixels * others * 20}, [&] {
    vote<<<blocks, static_cast<unsigned>(threads),
           sizeof(float) * static_cast<std::size_t>(rays.layers * threads), stream.get()>>>(
        rays, labels, decided);
  });
}

// Chains that are solved side by side: as many as half of the free memory holds.
int chains_at_once(const RayLabelsTask& task) {
  std::size_t free = 0, all = 0;
  check(cudaMemGetInfo(&free, &all));
  const auto& view = task.views.front().probabilities;
  const std::size_t each = SimplexBatch::bytes_of_problem(view.height, view.layers, view.width);
  const auto most = std::min<std::size_t>(kMostProblems, task.chains.size());
  return static_cast<int>(std::clamp<std::size_t>(free / 2 / each, 1, most));
}

class Labeling {
 public:
  Labeling(const RayLabelsTask& task, const Progress& progress)
      : task_(task),
        memory_(task, stream_, progress),
        rays_(memory_.rays()),
        at_once_(chains_at_once(task)),
        batch_(at_once_, rays_.height, rays_.layers, rays_.width, stream_),
        places_(static_cast<std::size_t>(rays_.pixels() * at_once_), stream_),
        labels_(static_cast<std::size_t>(rays_.pixels() * rays_.grid.count()), stream_) {}

  RayLabelsAnswer solve(const Progress& progress);
  void vote();
  void download(const Progress& progress, ViewStack<std::int32_t>& labels) {
    cuda::download(labels, labels_, stream_, progress);
  }

 private:
  void solve_link(const ProblemViews& views, bool is_first, const Progress& progress,
                  RayLabelsAnswer& sum);
  void solve_chains(std::size_t begin, std::size_t end, const Progress& progress,
                    RayLabelsAnswer& sum);

  const RayLabelsTask& task_;
  DeviceStream stream_;
  ViewRaysMemory memory_;
  const ViewRays& rays_;
  int at_once_;
  SimplexBatch batch_;
  DeviceArray<std::int32_t> places_, labels_;
};

// One view of each chain.
void Labeling::solve_link(const ProblemViews& views, bool is_first, const Progress& progress,
                          RayLabelsAnswer& sum) {
  fill_problems(rays_, views, task_.near_views, batch_.fields(), stream_);
  const std::int32_t* places = nullptr;
  if (!is_first && rays_.disparity != nullptr) {
    find_places(rays_, views, places_.data(), stream_);
    places = places_.data();
  }
  const SimplexSettings settings{task_.smoothness, task_.gap, task_.max_iterations,
                                 task_.check_every, task_.racing_iterations};
  for (const SimplexAnswer& answer : batch_.solve(views.count, places, settings, progress)) {
    sum.energy += answer.energy;
    sum.bound += answer.bound;
    sum.iterations = std::max(sum.iterations, answer.iterations);
  }
  for (int i = 0; i < views.count; ++i) {
    check(cudaMemcpyAsync(labels_.data() + views.view[i] * rays_.pixels(),
                          batch_.labels() + i * rays_.pixels(),
                          static_cast<std::size_t>(rays_.pixels()) * sizeof(std::int32_t),
                          cudaMemcpyDeviceToDevice, stream_.get()));
  }
}

void Labeling::solve_chains(std::size_t begin, std::size_t end, const Progress& progress,
                            RayLabelsAnswer& sum) {
  const auto longest = [&] {
    std::size_t length = 0;
    for (std::size_t i = begin; i < end; ++i) length = std::max(length, task_.chains[i].size());
    return length;
  }();
  for (std::size_t link = 0; link < longest; ++link) {
    ProblemViews views;
    // Those that go on keep their places.
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<int>& chain = task_.chains[i];
      if (link >= chain.size()) continue;
      views.view[views.count] = static_cast<std::int16_t>(chain[link]);
      views.last[views.count] = static_cast<std::int16_t>(chain[link > 0 ? link - 1 : 0]);
      ++views.count;
    }
    solve_link(views, link == 0, progress, sum);
    progress.report(static_cast<double>(begin + (end - begin) * (link + 1) / longest) /
                    static_cast<double>(task_.chains.size()));
  }
}

RayLabelsAnswer Labeling::solve(const Progress& progress) {
  RayLabelsAnswer sum;
  const auto step = static_cast<std::size_t>(at_once_);
  for (std::size_t begin = 0; begin < task_.chains.size(); begin += step) {
    solve_chains(begin, std::min(begin + step, task_.chains.size()), progress, sum);
  }
  return sum;
}

void Labeling::vote() {
  for (int round = 0; round < task_.votes; ++round) {
    DeviceArray<std::int32_t> decided(labels_.size(), stream_);
    vote_along_rays(rays_, labels_.data(), decided.data(), stream_);
    labels_ = std::move(decided);
  }
}

}  // namespace

struct DeviceForest::Memory {
  DeviceStream stream;
  DeviceArray<TreeNode> nodes;
  DeviceArray<int> roots, votes_of;
  DeviceArray<float> votes;
  int pitch = 0;

  Memory(const ForestTables& forest, const Progress& progress)
      : nodes(upload(forest.nodes.data(), forest.nodes.size(), stream, progress)),
        roots(upload(forest.roots.data(), forest.roots.size(), stream, progress)),
        votes_of(upload(forest.votes_of.data(), forest.votes_of.size(), stream, progress)),
        votes(upload(forest.votes.data(), forest.votes.size(), stream, progress)),
        pitch(forest.pitch) {}
  [[nodiscard]] Trees trees() const {
    return {
        nodes.data(), roots.data(), votes_of.data(), votes.data(), static_cast<int>(roots.size()),
        pitch};
  }
};

DeviceForest::DeviceForest(const ForestTables& forest, const Progress& progress)
    : memory_(std::make_unique<Memory>(forest, progress)) {}
DeviceForest::~DeviceForest() = default;

void DeviceForest::vote(VolumeView<const float> features, const Progress& progress,
                        float* votes) const {
  const DeviceStream stream;
  const Trees trees = memory_->trees();
  const DeviceArray<float> values = upload(features.data, features.size(), stream, progress);
  const std::size_t pixels = features.size() / static_cast<std::size_t>(features.layers);
  DeviceArray<float> sums(pixels * static_cast<std::size_t>(trees.pitch), stream);
  const VolumeView<const float> on_device{values.data(), features.height, features.layers,
                                          features.width};
  const dim3 blocks(blocks_for(features.width, kThreads), static_cast<unsigned>(features.height),
                    blocks_for(trees.pitch, kLabels));
  const auto all = static_cast<double>(pixels);
  launch(stream,
         {"labels: forest", 4 * all * (features.layers + trees.pitch),
          all * trees.count * (3 * kTypicalDepth + trees.pitch)},
         [&] {
           walk<<<blocks, kThreads,
                  sizeof(float) * static_cast<std::size_t>(features.layers * kThreads),
                  stream.get()>>>(trees, on_device, sums.data());
         });
  stream.wait();  // Not while others wait for the transfers.
  download_bytes(votes, sums.data(), sums.byte_size(), stream, progress);
}

RayLabelsAnswer label_rays(const RayLabelsTask& task, const Progress& progress,
                           ViewStack<std::int32_t>& labels) {
  Labeling labeling(task, progress.part(0, 0));
  const RayLabelsAnswer answer = labeling.solve(progress.part(0, 0.9));
  labeling.vote();
  labeling.download(progress.part(1, 1), labels);
  return answer;
}

}  // namespace episcope::cuda
