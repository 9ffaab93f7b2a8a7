// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/input/input.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope::cli {

/// One light field of many.
struct SceneInput {
  std::string input;           ///< What opens it.
  std::string name;            ///< That no other of them has, for files.
  std::optional<int> frame{};  ///< Of a sequence, if its frames are taken one by one.
};

/// Whether a sequence stands for its frames, or for the one that the reading options name.
enum class Frames { One, All };

/// The light fields that the INPUTs stand for: a folder that is no light field itself stands for
/// those below it, and a sequence for its frames if that is wanted. Throws UsageError for an
/// unknown built-in scene, IoError for a path that does not exist, Cancelled.
[[nodiscard]] std::vector<SceneInput> scene_inputs(const std::vector<std::string>& inputs,
                                                   const ReadOptions& options, Frames frames,
                                                   const Progress& progress);

/// The same, for runs of which one that fails does not stop the others: an INPUT that cannot be
/// read stands for itself, so that opening it says why.
[[nodiscard]] std::vector<SceneInput> scene_inputs_and_failed(
    const std::vector<std::string>& inputs, const ReadOptions& options, Frames frames,
    const Progress& progress);

/// Whether an INPUT is a folder that is no light field itself but holds some.
[[nodiscard]] bool is_collection(const std::string& input, const ReadOptions& options,
                                 const Progress& progress);

}  // namespace episcope::cli
