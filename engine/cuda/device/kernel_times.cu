// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/kernel_times.h"

#include "engine/cuda/device/launch.cuh"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace episcope {
namespace {

struct Entry {
  cuda::KernelWork work;
  cudaEvent_t begin = nullptr, end = nullptr;
};

std::atomic<bool> is_on = false;
std::mutex entries_lock;
std::vector<Entry> entries;

void forget_entries() {
  for (const Entry& entry : entries) {
    cudaEventDestroy(entry.begin);
    cudaEventDestroy(entry.end);
  }
  entries.clear();
}

}  // namespace

namespace cuda {

TimedLaunch::TimedLaunch(const DeviceStream& stream, const KernelWork& work)
    : stream_(stream.get()) {
  if (!is_on) return;
  Entry entry{work};
  check(cudaEventCreate(&entry.begin));
  check(cudaEventCreate(&entry.end));
  check(cudaEventRecord(entry.begin, stream_));
  const std::lock_guard lock(entries_lock);
  entry_ = static_cast<int>(entries.size());
  entries.push_back(entry);
}

void TimedLaunch::finish() {
  if (entry_ < 0) return;
  const std::lock_guard lock(entries_lock);
  check(cudaEventRecord(entries[entry_].end, stream_));
}

}  // namespace cuda

void time_kernels(bool on) {
  const std::lock_guard lock(entries_lock);
  forget_entries();
  is_on = on;
}

std::vector<KernelTime> kernel_times() {
  const std::lock_guard lock(entries_lock);
  cuda::check(cudaDeviceSynchronize());
  std::vector<KernelTime> times;
  for (const Entry& entry : entries) {
    const auto has_name = [&](const KernelTime& time) { return time.name == entry.work.name; };
    auto place = std::ranges::find_if(times, has_name);
    if (place == times.end()) place = times.insert(times.end(), KernelTime{entry.work.name});
    float milliseconds = 0;
    cuda::check(cudaEventElapsedTime(&milliseconds, entry.begin, entry.end));
    ++place->launches;
    place->milliseconds += milliseconds;
    place->bytes += entry.work.bytes;
    place->operations += entry.work.operations;
  }
  return times;
}

}  // namespace episcope
