// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/host_pages.h"

#include "engine/core/memory.h"
#include "engine/core/parallel.h"

#include <algorithm>

namespace episcope::cuda {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{8} << 20;

void take_all(char* memory, std::size_t bytes, const Progress& progress) {
  const auto pieces = static_cast<int>((bytes + kPieceBytes - 1) / kPieceBytes);
  parallel_for(pieces, progress.part(0, 0), [&](int i) {
    const std::size_t first = i * kPieceBytes;
    take_pages(memory + first, std::min(kPieceBytes, bytes - first));
  });
}

}  // namespace

std::future<void> begin_pages(void* memory, std::size_t bytes, const Progress& progress) {
  return std::async(std::launch::async, [memory, bytes, progress] {
    take_all(static_cast<char*>(memory), bytes, progress);
  });
}

}  // namespace episcope::cuda
