// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/rays/ray_votes.cuh"
#include "engine/cuda/simplex/simplex_fields.cuh"

namespace episcope::cuda {
namespace {

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
  votes[own * stride] += 1;
  int most = 0;
  for (int l = 1; l < rays.layers; ++l) {
    if (votes[l * stride] > votes[most * stride]) most = l;
  }
  decided[at] = votes[most * stride] > votes[own * stride] ? most : own;
}

}  // namespace

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

}  // namespace episcope::cuda
