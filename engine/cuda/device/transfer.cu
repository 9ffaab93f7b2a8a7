// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parallel/parallel.h"
#include "engine/cuda/device/transfer.cuh"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

namespace episcope::cuda {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{32} << 20;
constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

// Pinned buffers: while one is copied by the device, another is by the host. Pinning takes
// milliseconds, so the program keeps them.
class PinnedBuffers {
 public:
  static constexpr std::size_t kCount = 3;
  PinnedBuffers() {
    for (Buffer& buffer : buffers_) {
      check(cudaHostAlloc(&buffer.memory, kBufferBytes, cudaHostAllocDefault));
      check(cudaEventCreateWithFlags(&buffer.copied, cudaEventDisableTiming));
    }
  }
  struct Buffer {
    void* memory = nullptr;
    cudaEvent_t copied = nullptr;
  };
  [[nodiscard]] Buffer& buffer(std::size_t chunk) { return buffers_[chunk % buffers_.size()]; }

 private:
  std::array<Buffer, kCount> buffers_;  // never freed: the driver may be gone before static objects
};

std::mutex buffers_lock;

PinnedBuffers& pinned_buffers() {
  static PinnedBuffers* const buffers = new PinnedBuffers;
  return *buffers;
}

void copy_on_host(void* to, const void* from, std::size_t bytes, const Progress& progress) {
  const auto pieces = static_cast<int>((bytes + kPieceBytes - 1) / kPieceBytes);
  parallel_for(pieces, progress.part(0, 0), [&](int i) {
    const std::size_t first = i * kPieceBytes;
    std::memcpy(static_cast<char*>(to) + first, static_cast<const char*>(from) + first,
                std::min(kPieceBytes, bytes - first));
  });
}

struct Chunk {
  std::size_t first = 0;
  std::size_t bytes = 0;
};

Chunk chunk_of(std::size_t number, std::size_t bytes) {
  const std::size_t first = number * kBufferBytes;
  return {first, std::min(kBufferBytes, bytes - first)};
}

}  // namespace

void upload_bytes(void* device, const void* host, std::size_t bytes, const DeviceStream& stream,
                  const Progress& progress) {
  const std::lock_guard lock(buffers_lock);
  PinnedBuffers& buffers = pinned_buffers();
  const std::size_t chunks = (bytes + kBufferBytes - 1) / kBufferBytes;
  for (std::size_t i = 0; i < chunks; ++i) {
    const Chunk chunk = chunk_of(i, bytes);
    auto& buffer = buffers.buffer(i);
    if (i >= 2) check(cudaEventSynchronize(buffer.copied));
    copy_on_host(buffer.memory, static_cast<const char*>(host) + chunk.first, chunk.bytes,
                 progress);
    check(cudaMemcpyAsync(static_cast<char*>(device) + chunk.first, buffer.memory, chunk.bytes,
                          cudaMemcpyHostToDevice, stream.get()));
    check(cudaEventRecord(buffer.copied, stream.get()));
  }
  stream.wait();
}

void download_bytes(std::initializer_list<void*> hosts, const void* device, std::size_t bytes,
                    const DeviceStream& stream, const Progress& progress) {
  const std::lock_guard lock(buffers_lock);
  PinnedBuffers& buffers = pinned_buffers();
  const std::size_t chunks = (bytes + kBufferBytes - 1) / kBufferBytes;
  const auto begin = [&](std::size_t i) {
    const Chunk chunk = chunk_of(i, bytes);
    auto& buffer = buffers.buffer(i);
    check(cudaMemcpyAsync(buffer.memory, static_cast<const char*>(device) + chunk.first,
                          chunk.bytes, cudaMemcpyDeviceToHost, stream.get()));
    check(cudaEventRecord(buffer.copied, stream.get()));
  };
  if (chunks > 0) begin(0);
  for (std::size_t i = 0; i < chunks; ++i) {
    if (i + 1 < chunks) begin(i + 1);
    auto& buffer = buffers.buffer(i);
    check(cudaEventSynchronize(buffer.copied));
    const Chunk chunk = chunk_of(i, bytes);
    for (void* host : hosts) {
      copy_on_host(static_cast<char*>(host) + chunk.first, buffer.memory, chunk.bytes, progress);
    }
  }
  stream.wait();
}

void download_bytes(void* host, const void* device, std::size_t bytes, const DeviceStream& stream,
                    const Progress& progress) {
  download_bytes({host}, device, bytes, stream, progress);
}

PipelinedDownload::PipelinedDownload(const DeviceStream& computed, const Progress& progress)
    : lock_(buffers_lock), computed_(computed), progress_(progress) {}

void PipelinedDownload::add(void* host, const void* device, std::size_t bytes) {
  PinnedBuffers& buffers = pinned_buffers();
  copies_.wait_for(computed_);
  const std::size_t chunks = (bytes + kBufferBytes - 1) / kBufferBytes;
  for (std::size_t i = 0; i < chunks; ++i) {
    while (pending_.size() >= PinnedBuffers::kCount) complete_oldest();
    const Chunk chunk = chunk_of(i, bytes);
    auto& buffer = buffers.buffer(begun_);
    check(cudaMemcpyAsync(buffer.memory, static_cast<const char*>(device) + chunk.first,
                          chunk.bytes, cudaMemcpyDeviceToHost, copies_.get()));
    check(cudaEventRecord(buffer.copied, copies_.get()));
    pending_.push_back({begun_++, static_cast<char*>(host) + chunk.first, chunk.bytes});
  }
}

void PipelinedDownload::complete_oldest() {
  const Piece piece = pending_.front();
  auto& buffer = pinned_buffers().buffer(piece.number);
  check(cudaEventSynchronize(buffer.copied));
  copy_on_host(piece.host, buffer.memory, piece.bytes, progress_);
  pending_.pop_front();
}

void PipelinedDownload::finish() {
  while (!pending_.empty()) complete_oldest();
  copies_.wait();
}

}  // namespace episcope::cuda
