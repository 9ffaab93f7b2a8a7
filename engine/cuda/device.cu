// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device.h"

#include "engine/core/parallel.h"
#include "engine/cuda/device.cuh"

#include <cuda_runtime.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <mutex>

namespace episcope {
namespace {

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

// The compute capability that the oldest machine code is made for.
constexpr int kOldestMajor = 8;

}  // namespace

std::string cuda_runtime_version() {
  return version_text(CUDART_VERSION);
}

CudaDevice cuda_device() {
  CudaDevice device;
  int driver = 0, count = 0;
  device.runtime = cuda_runtime_version();
  if (cudaDriverGetVersion(&driver) != cudaSuccess || driver == 0) {
    device.why_not = "there is no NVIDIA driver";
    return device;
  }
  device.driver = version_text(driver);
  if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess || count == 0) {
    device.why_not = std::string("CUDA finds no GPU (") + cudaGetErrorString(error) + ")";
    return device;
  }
  cudaDeviceProp properties{};
  if (const cudaError_t error = cudaGetDeviceProperties(&properties, 0); error != cudaSuccess) {
    device.why_not = std::string("the GPU does not answer (") + cudaGetErrorString(error) + ")";
    return device;
  }
  device.name = properties.name;
  if (properties.major < kOldestMajor || !properties.memoryPoolsSupported) {
    device.why_not = device.name + " is too old (compute capability " +
                     std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                     ", needed 8.0)";
    return device;
  }
  if (const cudaError_t error = cudaMemGetInfo(&device.free_memory, &device.memory);
      error != cudaSuccess) {
    device.why_not = device.name + " cannot be used (" + cudaGetErrorString(error) + ")";
    return device;
  }
  device.is_available = true;
  return device;
}

namespace {

constexpr int kThreads = 256;
constexpr int kBlocks = 132 * 32;
constexpr int kSteps = 4096;
constexpr int kChains = 8;

// Independent chains of multiply-adds, so that none waits for another.
__global__ void multiply_add(float* out, float factor) {
  float values[kChains];
  for (int i = 0; i < kChains; ++i) values[i] = static_cast<float>(threadIdx.x + i);
  for (int step = 0; step < kSteps; ++step) {
#pragma unroll
    for (int i = 0; i < kChains; ++i) values[i] = values[i] * factor + 1;
  }
  float sum = 0;
  for (int i = 0; i < kChains; ++i) sum += values[i];
  out[blockIdx.x * kThreads + threadIdx.x] = sum;
}

// Seconds of one of several runs, after one that is not counted.
template <class Work>
double seconds_of(const cuda::DeviceStream& stream, const Work& work) {
  constexpr int kRuns = 5;
  cudaEvent_t begin = nullptr, end = nullptr;
  cuda::check(cudaEventCreate(&begin));
  cuda::check(cudaEventCreate(&end));
  work();
  cuda::check(cudaEventRecord(begin, stream.get()));
  for (int i = 0; i < kRuns; ++i) work();
  cuda::check(cudaEventRecord(end, stream.get()));
  cuda::check(cudaEventSynchronize(end));
  float milliseconds = 0;
  cuda::check(cudaEventElapsedTime(&milliseconds, begin, end));
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  return milliseconds / 1e3 / kRuns;
}

}  // namespace

DeviceBounds measure_device_bounds() {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  const cuda::DeviceStream stream;
  cuda::DeviceArray<char> from(kBytes, stream), to(kBytes, stream);
  cuda::DeviceArray<float> sums(static_cast<std::size_t>(kThreads) * kBlocks, stream);
  from.clear();
  DeviceBounds bounds;
  bounds.bytes = 2.0 * kBytes / seconds_of(stream, [&] {
                   cuda::check(cudaMemcpyAsync(to.data(), from.data(), kBytes,
                                               cudaMemcpyDeviceToDevice, stream.get()));
                 });
  const double operations = 2.0 * kThreads * kBlocks * kSteps * kChains;
  bounds.operations = operations / seconds_of(stream, [&] {
                        multiply_add<<<kBlocks, kThreads, 0, stream.get()>>>(sums.data(), 0.5F);
                        cuda::check(cudaGetLastError());
                      });
  return bounds;
}

}  // namespace episcope

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

SharedVolume upload_volume(VolumeView<const float> volume, const Progress& progress) {
  auto copy = std::make_shared<DeviceVolume>(volume.height, volume.layers, volume.width);
  upload_bytes(copy->values.data(), volume.data, copy->values.byte_size(), copy->stream, progress);
  return copy;
}

}  // namespace episcope::cuda

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
