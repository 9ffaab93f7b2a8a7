// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/check.cuh"
#include "engine/cuda/device/device_stream.cuh"

#include <cstddef>
#include <utility>

namespace episcope::cuda {

/// Memory of the device, in the order of a stream: uninitialised, freed when the array goes, after
/// what was begun before. Move-only. The stream must outlive it.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  /// Throws DeviceFailure if there is too little.
  DeviceArray(std::size_t size, const DeviceStream& stream) : size_(size), stream_(stream.get()) {
    if (size == 0) return;
    void* memory = nullptr;
    check(cudaMallocAsync(&memory, size * sizeof(T), stream_));
    data_ = static_cast<T*>(memory);
  }
  ~DeviceArray() {
    if (data_) cudaFreeAsync(data_, stream_);
  }
  DeviceArray(DeviceArray&& other) noexcept { swap(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    DeviceArray taken(std::move(other));
    swap(taken);
    return *this;
  }

  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t byte_size() const { return size_ * sizeof(T); }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  /// Every byte becomes 0.
  void clear() { check(cudaMemsetAsync(data_, 0, byte_size(), stream_)); }

 private:
  void swap(DeviceArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(stream_, other.stream_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  cudaStream_t stream_ = nullptr;
};

}  // namespace episcope::cuda
