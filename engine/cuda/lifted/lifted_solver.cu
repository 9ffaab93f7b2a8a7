// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/device_volume.cuh"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/lifted/lifted_fields.cuh"
#include "engine/cuda/lifted/lifted_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace episcope::cuda {
namespace {

class Lifting {
 public:
  Lifting(const LiftedTask& task, const Progress& progress);

  void iterate() { iterate_lifting(fields_, stream_); }
  // Renews energy, bound and labels of `result` if better ones are found.
  void measure(LiftedLabels& result);
  // The energies of the cuts as they are; likewise.
  void compare_cuts(LiftedLabels& result);
  void unload(LiftedLabels& result, const Progress& progress);

 private:
  // Adds the parts of a sum.
  [[nodiscard]] double total(int sum) const;
  void download_sums();

  DeviceStream stream_;
  LiftedFields fields_;
  std::size_t pixels_;
  DeviceArray<float> unknowns_, limits_;
  DeviceArray<int> labels_;  // Of each cut, then the best.
  DeviceArray<double> sums_;
  std::vector<double> host_sums_;
};

Lifting::Lifting(const LiftedTask& task, const Progress& progress) {
  fields_.cost = task.cost->view();
  fields_.steps = fields_.cost.layers - 1;
  pixels_ = static_cast<std::size_t>(fields_.height()) * fields_.width();
  const std::size_t size = pixels_ * fields_.steps;
  unknowns_ = DeviceArray<float>((2 + kLiftedPairs) * size, stream_);
  limits_ = DeviceArray<float>(kLiftedPairs * pixels_, stream_);
  labels_ = DeviceArray<int>((kLiftedThresholdCount + 1) * pixels_, stream_);
  fields_.phi = unknowns_.data();
  fields_.ahead = unknowns_.data() + size;
  for (int k = 0; k < kLiftedPairs; ++k) {
    fields_.duals[k] = unknowns_.data() + (2 + k) * size;
    fields_.limits[k] = limits_.data() + k * pixels_;
  }
  for (int k = 0; k < kLiftedThresholdCount; ++k) fields_.cuts[k] = labels_.data() + k * pixels_;
  // Each pixel is in 8 pairs, so |K|² ≤ 16; φ moves within [0, 1], the duals within about Λ.
  fields_.primal_step = static_cast<float>(1 / (4 * task.smoothness));
  fields_.dual_step = static_cast<float>(task.smoothness / 4);
  sums_ =
      DeviceArray<double>(static_cast<std::size_t>(kLiftedSums) * lifted_parts(fields_), stream_);
  host_sums_.resize(sums_.size());
  const auto g = upload(task.g.data, pixels_, stream_, progress);
  fill_limits(fields_, g.data(), static_cast<float>(task.smoothness), stream_);
  start_lifting(fields_, stream_);
}

void Lifting::download_sums() {
  check(cudaMemcpyAsync(host_sums_.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                        stream_.get()));
  stream_.wait();
}

double Lifting::total(int sum) const {
  const int parts = lifted_parts(fields_);
  const auto first = host_sums_.begin() + static_cast<std::ptrdiff_t>(sum) * parts;
  return std::accumulate(first, first + parts, 0.0);
}

void Lifting::measure(LiftedLabels& result) {
  measure_bound(fields_, sums_.data(), stream_);
  compare_cuts(result);
  result.bound = std::max(result.bound, total(0));
}

void Lifting::compare_cuts(LiftedLabels& result) {
  measure_energies(fields_, sums_.data() + lifted_parts(fields_), stream_);
  download_sums();
  for (int k = 0; k < kLiftedThresholdCount; ++k) {
    const double energy = total(1 + k);
    if (energy >= result.energy) continue;
    result.energy = energy;
    check(cudaMemcpyAsync(labels_.data() + kLiftedThresholdCount * pixels_, fields_.cuts[k],
                          pixels_ * sizeof(int), cudaMemcpyDeviceToDevice, stream_.get()));
  }
}

void Lifting::unload(LiftedLabels& result, const Progress& progress) {
  result.labels = Image<int>(fields_.height(), fields_.width());
  download_bytes(result.labels.data(), labels_.data() + kLiftedThresholdCount * pixels_,
                 pixels_ * sizeof(int), stream_, progress);
}

double gap_of(const LiftedLabels& result) {
  const double gap = result.energy - result.bound;
  return gap == 0 ? 0 : gap / std::abs(result.energy);
}

}  // namespace

LiftedLabels solve_lifted(const LiftedTask& task, const std::function<void(int, double)>& report,
                          const Progress& progress) {
  Lifting lifting(task, progress);
  LiftedLabels result;
  result.energy = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  if (task.smoothness == 0) {  // each pixel for itself
    lifting.compare_cuts(result);
    result.bound = result.energy;
    result.converged = true;
    lifting.unload(result, progress);
    return result;
  }
  for (bool is_last = false; !is_last;) {
    progress.check();
    lifting.iterate();
    ++result.iterations;
    is_last = result.iterations >= task.max_iterations || progress.finish_requested();
    if (!is_last && result.iterations % std::max(1, task.check_every) != 0) continue;
    lifting.measure(result);
    const double gap = gap_of(result);
    result.converged = gap <= task.gap;
    is_last = is_last || result.converged;
    report(result.iterations, gap);
  }
  lifting.unload(result, progress);
  return result;
}

}  // namespace episcope::cuda
