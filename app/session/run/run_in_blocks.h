// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/run/run_estimator.h"
#include "engine/core/light_field/map_block.h"
#include "engine/disparity/blocks/run_blocks.h"

#include <filesystem>
#include <string>

namespace episcope {

/// A run whose maps go to a file block by block.
struct BlockRequest {
  EstimateRequest run;
  std::filesystem::path output;  ///< The result file; until it is complete, OUTPUT.partial.
  std::string input;             ///< As the user named the light field.
  BlockMemory memory;            ///< See run_blocks.
};

struct FinishedBlocks {
  Provenance provenance;  ///< As of the same run at once, but for the seconds.
  MapGeometry maps;
  std::string remark{};  ///< What became of a file that an earlier run left, if there was one.
};

/// Whether a run should be made in blocks, which is done by the processor: the method can, no other
/// device is asked for, and its maps and what it takes beside them may exceed what is free, or a
/// budget is set (memory_budget.h).
[[nodiscard]] bool should_run_in_blocks(const LightField& light_field, const Estimator& estimator,
                                        const RunOptions& options);

/// Runs a method block by block into a result file, whose maps equal those of run_estimator and
/// save_result bit by bit. Continues the file that the same run of the same samples left
/// unfinished, however it ended; one that another run left is replaced. Throws as run_blocks and
/// ResultDraft, and IoError if the samples were lost while they were read: their file was
/// truncated.
[[nodiscard]] FinishedBlocks run_in_blocks(const LightField& light_field,
                                           const Estimator& estimator, const BlockRequest& request,
                                           const Progress& progress);

}  // namespace episcope
