// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <deque>
#include <future>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace episcope::cuda {

/// Throws DeviceFailure unless `error` is success.
inline void check(cudaError_t error) {
  if (error == cudaSuccess) return;
  cudaGetLastError();  // so that the next call does not report it again
  if (error == cudaErrorMemoryAllocation) {
    throw DeviceFailure("the GPU has too little free memory for this light field");
  }
  throw DeviceFailure(std::string("the GPU failed: ") + cudaGetErrorString(error));
}

/// What a run does on the device, in order. Every run has one of its own. Not copyable.
class DeviceStream {
 public:
  /// Throws DeviceFailure.
  DeviceStream();
  /// Waits for what was begun.
  ~DeviceStream();
  DeviceStream(const DeviceStream&) = delete;
  DeviceStream& operator=(const DeviceStream&) = delete;

  [[nodiscard]] cudaStream_t get() const { return stream_; }
  /// Waits for what was begun. Throws DeviceFailure if any of it failed.
  void wait() const;
  /// What is begun from now on waits for what was begun on the other. Throws DeviceFailure.
  void wait_for(const DeviceStream& other) const;

 private:
  cudaStream_t stream_ = nullptr;
};

/// Memory of the device, in the order of a stream: uninitialized, freed when the array goes, after
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

/// Whoever makes one waits for its stream before others see it.
struct DeviceVolume {
  DeviceStream stream;
  int height = 0, layers = 0, width = 0;
  DeviceArray<float> values;  ///< `[y][layer][x]`

  DeviceVolume(int rows, int labels, int columns)
      : height(rows),
        layers(labels),
        width(columns),
        values(static_cast<std::size_t>(rows) * labels * columns, stream) {}
  [[nodiscard]] VolumeView<const float> view() const {
    return {values.data(), height, layers, width};
  }
};

/// What a launch has to do at least, for `kernel_times`.
struct KernelWork {
  const char* name;       ///< A literal.
  double bytes = 0;       ///< Read and written, each once.
  double operations = 0;  ///< Floating-point.
};

/// A launch that is timed while `time_kernels` is on; begin with construction, end with `finish`.
class TimedLaunch {
 public:
  TimedLaunch(const DeviceStream& stream, const KernelWork& work);
  void finish();

 private:
  cudaStream_t stream_;
  int entry_ = -1;
};

/// Launches: `launch()` holds one kernel<<<…>>> call on the stream. Throws DeviceFailure.
template <class Launch>
void launch(const DeviceStream& stream, const KernelWork& work, const Launch& kernel) {
  TimedLaunch timed(stream, work);
  kernel();
  check(cudaGetLastError());
  timed.finish();
}

/// Blocks of `size` that cover `count`.
constexpr unsigned blocks_for(long count, int size) {
  return static_cast<unsigned>((count + size - 1) / size);
}

/// Copies bytes to the device, by way of pinned memory. The host's may change when it returns.
/// Throws DeviceFailure, Cancelled.
void upload_bytes(void* device, const void* host, std::size_t bytes, const DeviceStream& stream,
                  const Progress& progress);
/// Copies bytes from the device, when what was begun on the stream is done. Throws DeviceFailure,
/// Cancelled.
void download_bytes(void* host, const void* device, std::size_t bytes, const DeviceStream& stream,
                    const Progress& progress);
/// Copies to several places.
void download_bytes(std::initializer_list<void*> hosts, const void* device, std::size_t bytes,
                    const DeviceStream& stream, const Progress& progress);

/// A copy of the array of the host, of `size` elements.
template <class T>
[[nodiscard]] DeviceArray<T> upload(const T* host, std::size_t size, const DeviceStream& stream,
                                    const Progress& progress) {
  DeviceArray<T> array(size, stream);
  upload_bytes(array.data(), host, array.byte_size(), stream, progress);
  return array;
}

/// Fills a stack, which must have the array's size.
template <class T>
void download(ViewStack<T>& host, const DeviceArray<T>& array, const DeviceStream& stream,
              const Progress& progress) {
  download_bytes(host.data(), array.data(), array.byte_size(), stream, progress);
}

/// Begins `copy(stream)` on a thread of its own, with a stream of its own that waits for what
/// `computed` was told so far: what is ready comes over while the device goes on computing.
template <class Copy>
[[nodiscard]] auto begin_copies(const DeviceStream& computed, Copy copy) {
  auto copies = std::make_unique<DeviceStream>();
  copies->wait_for(computed);
  return std::async(std::launch::async,
                    [copies = std::move(copies), copy = std::move(copy)] { return copy(*copies); });
}

/// Copies from the device piece by piece, while it computes what follows. One at a time in the
/// program, and no other transfer meanwhile.
class PipelinedDownload {
 public:
  /// Of what `computed` is told to do. Throws DeviceFailure.
  PipelinedDownload(const DeviceStream& computed, const Progress& progress);
  /// A piece that is ready when what the stream was told so far is done. Returns before, but may
  /// wait for pieces before it. Throws DeviceFailure, Cancelled.
  void add(void* host, const void* device, std::size_t bytes);
  /// Returns when all pieces are there. Throws DeviceFailure, Cancelled.
  void finish();

 private:
  struct Piece {
    std::size_t number;  // among all
    char* host;
    std::size_t bytes;
  };
  void complete_oldest();

  std::unique_lock<std::mutex> lock_;
  const DeviceStream& computed_;
  Progress progress_;
  DeviceStream copies_;
  std::size_t begun_ = 0;
  std::deque<Piece> pending_;
};

}  // namespace episcope::cuda
