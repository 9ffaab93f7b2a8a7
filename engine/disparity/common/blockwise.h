// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/map_block.h"
#include "engine/core/parallel/progress.h"

#include <functional>
#include <string>
#include <vector>

namespace episcope {

/// Reads what has been made of a block so far: the maps of the pass before, as long as the pass has
/// not replaced them, and one of those that were kept.
struct ReadBlock {
  std::function<BlockMaps(const MapBlock&)> maps;
  std::function<ViewStack<float>(const MapBlock&, int number)> kept;
  [[nodiscard]] BlockMaps operator()(const MapBlock& block) const { return maps(block); }
};

/// How the maps are cut: into bands of rows of all views, or into views.
enum class BlockUnit { Rows, Views };

/// What a block becomes.
struct FinishedBlock {
  BlockMaps maps;
  double finding = 0;                ///< Something of which the largest of all blocks is wanted.
  std::vector<double> facts{};       ///< For all further blocks; empty = nothing new.
  std::vector<std::string> notes{};  ///< For the estimate.
};

/// One pass over all maps. What it makes of a block depends on samples, on the facts, and on the
/// maps that the pass before left of the same block: not on how the maps are cut.
struct BlockPass {
  std::string step;  ///< For Progress.
  BlockUnit unit = BlockUnit::Rows;
  /// Of BlockUnit::Views: only these, one after the other. Empty = all.
  std::vector<ViewIndex> only{};
  /// Bytes of memory that a block of so many rows or views takes, samples that have to be looked at
  /// included if they are on disk.
  std::function<double(int count)> bytes;
  /// What all blocks have to know, found before the first from what passes before have found. If
  /// empty, they know just that.
  std::function<std::vector<double>(const ReadBlock&, const std::vector<double>& facts,
                                    const Progress&)>
      prepare;
  /// Throws Cancelled.
  std::function<FinishedBlock(const MapBlock&, const ReadBlock&, const std::vector<double>& facts,
                              const Progress&)>
      compute;
};

/// An estimate that can be made block by block, equal bit by bit to the one that is made at once.
/// Refers to its light field.
struct BlockwiseRun {
  MapGeometry maps;
  bool has_layers = false;  ///< Whether blocks have BlockMaps::layered.
  /// How many maps are kept for later passes. A pass that keeps a block must not read what was kept
  /// of it before: where the program ended, the block is made and kept once more.
  int kept = 0;
  Provenance provenance;  ///< With the range; the notes are completed by `notes`.
  std::vector<BlockPass> passes;
  /// Of the largest finding of the last pass and the facts at the end; may be empty.
  std::function<std::vector<std::string>(const BlockProgress& end)> notes;
};

}  // namespace episcope
