// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/parallel/progress.h"
#include "engine/cuda/device/device_array.cuh"

#include <cstddef>
#include <deque>
#include <future>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <utility>

namespace episcope::cuda {

/// Copies bytes to the device, by way of pinned memory. The host's may change when it returns.
/// Throws DeviceFailure, Cancelled.
void upload_bytes(void* device, const void* host, std::size_t bytes, const DeviceStream& stream,
                  const Progress& progress);
/// Copies bytes from the device, when what was begun on the stream is done. Throws DeviceFailure,
/// Cancelled.
void download_bytes(void* host, const void* device, std::size_t bytes, const DeviceStream& stream,
                    const Progress& progress);
/// The same to several places.
void download_bytes(std::initializer_list<void*> hosts, const void* device, std::size_t bytes,
                    const DeviceStream& stream, const Progress& progress);

/// An array like that of the host, of `size` elements.
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
