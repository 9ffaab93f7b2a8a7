// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/check.cuh"
#include "engine/cuda/device/device_stream.cuh"

#include <cstdint>

namespace episcope::cuda {
namespace {

// Memory that a run frees stays with the program: asking the driver anew takes milliseconds.
void keep_freed_memory() {
  cudaMemPool_t pool = nullptr;
  check(cudaDeviceGetDefaultMemPool(&pool, 0));
  std::uint64_t all = UINT64_MAX;
  check(cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &all));
}

}  // namespace

DeviceStream::DeviceStream() {
  static const bool is_set = (keep_freed_memory(), true);
  static_cast<void>(is_set);
  check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
}

DeviceStream::~DeviceStream() {
  cudaStreamSynchronize(stream_);
  cudaStreamDestroy(stream_);
}

void DeviceStream::wait() const {
  check(cudaStreamSynchronize(stream_));
}

void DeviceStream::wait_for(const DeviceStream& other) const {
  cudaEvent_t reached = nullptr;
  check(cudaEventCreateWithFlags(&reached, cudaEventDisableTiming));
  check(cudaEventRecord(reached, other.get()));
  check(cudaStreamWaitEvent(stream_, reached));
  check(cudaEventDestroy(reached));  // when it is reached
}

}  // namespace episcope::cuda
