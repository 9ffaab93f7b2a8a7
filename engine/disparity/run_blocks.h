// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/disparity/estimator.h"

#include <cstddef>

namespace episcope {

/// Keeps the maps of an unfinished estimate and its progress beyond the end of the program.
class BlockStore {
 public:
  virtual ~BlockStore() = default;
  /// Progress of a former program.
  [[nodiscard]] virtual BlockProgress progress() const = 0;
  [[nodiscard]] virtual BlockMaps read(const MapBlock& block) const = 0;
  /// Records progress alone.
  virtual void note(const BlockProgress& after) = 0;
  /// Keeps a block, then notes the progress; `replaces` if the pass needs what was there to make
  /// the block again. If the program ends in between, either both or neither is found again.
  virtual void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
                     bool replaces) = 0;
};

/// Bytes of memory for blocks: maps, samples on disk and intermediate results. The program itself
/// and a light field in memory come on top.
struct BlockMemory {
  std::size_t wanted = 0;  ///< Blocks are as large as this allows,
  std::size_t most = 0;    ///< but the smallest may take this.
};

/// Throws InvalidInput, with the least that will do, if the smallest block of a pass exceeds the
/// memory. For callers that have something to prepare, or to replace, before a run.
void require_memory(const BlockwiseRun& run, BlockMemory memory);

/// Completes an estimate and returns its notes and seconds. The last pass marks invalid pixels.
/// Throws as require_memory, before anything is made; Cancelled; what the method and the store
/// throw.
[[nodiscard]] Provenance run_blocks(const LightField& light_field, const BlockwiseRun& run,
                                    BlockStore& store, BlockMemory memory,
                                    const Progress& progress);

}  // namespace episcope
