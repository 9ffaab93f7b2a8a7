// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/ray_labels.h"

#include "engine/cuda/device.cuh"

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

}  // namespace episcope::cuda
