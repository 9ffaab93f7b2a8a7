// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/messages/message_labeling.h"

#include "engine/cuda/device/device_volume.cuh"
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/messages/message_sweeps.cuh"

#include <bit>
#include <numeric>
#include <vector>

namespace episcope::cuda {
namespace {

// Labels that the kernels are made for: up to four of each lane, or a power of two.
int padded_labels(int labels) {
  const auto each = static_cast<unsigned>((labels + kWarp - 1) / kWarp);
  return kWarp * static_cast<int>(each <= 4 ? each : std::bit_ceil(each));
}

// A power of two of lanes, beyond whose labels no difference is below the truncation.
int reach_of(const MessageTask& task, int each) {
  int reach = 1;
  while (reach < kWarp && task.slope * static_cast<float>(each * reach + 1) < task.most) reach *= 2;
  return reach;
}

DeviceArray<float> upload_weights(ImageView<const float> weights, const MessageTask& task,
                                  const DeviceStream& stream, const Progress& progress) {
  const std::size_t size = static_cast<std::size_t>(task.cost.height) * task.cost.width;
  if (!weights.empty()) return upload(weights.data, size, stream, progress);
  const std::vector<float> ones(size, 1.0F);
  return upload(ones.data(), size, stream, progress);
}

// All that the device holds.
class Passing {
 public:
  Passing(const MessageTask& task, const Progress& progress)
      : across_weights_(upload_weights(task.across, task, stream_, progress)),
        down_weights_(upload_weights(task.down, task, stream_, progress)),
        pixels_(static_cast<std::size_t>(task.cost.height) * task.cost.width) {
    field_.height = task.cost.height;
    field_.width = task.cost.width;
    field_.labels = padded_labels(task.cost.layers);
    const std::size_t size = pixels_ * field_.labels;
    cost_ = {size, stream_};
    across_ = {size, stream_};
    down_ = {size, stream_};
    labels_ = {pixels_, stream_};
    sums_ = {static_cast<std::size_t>(field_.height), stream_};
    across_.clear();
    down_.clear();
    gather_labels(stream_, task.cost.values.data(), task.cost.layers, field_, cost_.data());
    field_.cost = cost_.data();
    field_.weight_across = across_weights_.data();
    field_.weight_down = down_weights_.data();
    field_.across = across_.data();
    field_.down = down_.data();
    field_.slope = task.slope;
    field_.most = task.most;
    field_.reach = reach_of(task, field_.each());
    handed_ = {handed_size(field_), stream_};
  }

  // Returns the bound.
  double iterate() {
    sweep_down(stream_, field_, handed_.data(), sums_.data());
    sweep_up(stream_, field_, handed_.data(), sums_.data());
    return sum();
  }
  void finish(MessageAnswer& answer, const Progress& progress) {
    read_off(stream_, field_, labels_.data());
    label_energies(stream_, field_, labels_.data(), sums_.data());
    answer.energy = sum();
    answer.labels = Image<int>(field_.height, field_.width);
    download_bytes(answer.labels.data(), labels_.data(), labels_.byte_size(), stream_, progress);
  }

 private:
  double sum() {
    std::vector<double> rows(sums_.size());
    check(cudaMemcpyAsync(rows.data(), sums_.data(), sums_.byte_size(), cudaMemcpyDeviceToHost,
                          stream_.get()));
    stream_.wait();
    return std::accumulate(rows.begin(), rows.end(), 0.0);
  }

  DeviceStream stream_;
  DeviceArray<float> across_weights_, down_weights_;
  std::size_t pixels_;
  MessageField field_;
  DeviceArray<float> cost_, across_, down_, handed_;
  DeviceArray<int> labels_;
  DeviceArray<double> sums_;
};

}  // namespace

MessageAnswer solve_by_messages(const MessageTask& task, int iterations, const Progress& progress) {
  Passing passing(task, progress.part(0, 0));
  MessageAnswer answer;
  while (answer.iterations < iterations && !progress.finish_requested()) {
    progress.check();
    answer.bound = passing.iterate();
    ++answer.iterations;
    progress.report(static_cast<double>(answer.iterations) / (iterations + 1));
  }
  passing.finish(answer, progress.part(1, 1));
  return answer;
}

}  // namespace episcope::cuda
