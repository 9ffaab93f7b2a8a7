// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/finding.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/disparity/estimator.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// What a run of a method needs, copied when it is asked for.
struct EstimateRequest {
  std::string method;
  ParameterSet parameters;
  RunOptions options{};
};

/// What a run makes.
struct FinishedEstimate {
  EstimatePtr estimate;    ///< With its provenance, the hash of the light field included.
  Interval display_range;  ///< Disparities that 98 % of the pixels of one view lie in.
  std::string warning{};   ///< The note that doubts the range; or empty.
};

/// Note of an estimate that was taken before the method was done.
inline constexpr const char* kTakenEarly = finding_text("run.early").data();
/// Whether it has that note.
[[nodiscard]] bool was_taken_early(const Estimate& estimate);

/// Runs a method on a scene, which keeps its equalized views (Scene::even). The notes of a result
/// say if it was ended early (Progress::finish_requested). Throws what the method throws.
[[nodiscard]] FinishedEstimate run_estimator(const Scene& scene, const Estimator& estimator,
                                             const ParameterSet& parameters,
                                             const RunOptions& options, const Progress& progress);

/// The views that a run covers: those that are wanted, else as many as the method can. Throws
/// InvalidInput if all views are wanted of a method that estimates one.
[[nodiscard]] ViewSelection views_to_estimate(const Estimator& estimator,
                                              std::optional<ViewSelection> wanted);

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
/// budget is set (memory.h).
[[nodiscard]] bool should_run_in_blocks(const LightField& light_field, const Estimator& estimator,
                                        const RunOptions& options);

/// Runs a method block by block into a result file, bit by bit as run_estimator and save_result
/// would write it. Continues the file that the same run of the same samples left unfinished,
/// however it ended; one that another run left is replaced. Throws as run_blocks and ResultDraft,
/// and IoError if the samples were lost while they were read: their file was truncated.
[[nodiscard]] FinishedBlocks run_in_blocks(const LightField& light_field,
                                           const Estimator& estimator, const BlockRequest& request,
                                           const Progress& progress);

}  // namespace episcope
