// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/reader.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

inline constexpr const char* kSequenceReader = "sequence";

/// Sequences of light fields: a folder of numbered folders or files that are light fields of one
/// form and shape, a folder with the views of all frames, or a folder for each camera. Opens the
/// frame of `OpenOptions::frame` by the reader of its form.
[[nodiscard]] Reader sequence_reader();

/// Folder or file of the frame that was read; for images of one folder `folder/frame_3`, which does
/// not exist. Empty for anything but a sequence.
[[nodiscard]] std::filesystem::path frame_path(const LightFieldInfo& info);

/// Folders or files of one folder whose names differ in one running number.
struct NumberedFrames {
  std::vector<std::filesystem::path> paths;  ///< By their number.
  std::vector<long> numbers;                 ///< In names, ascending.
};

/// Finds folders, else files, of `folder` that are numbered frames: digits alone ("0001"), or with
/// a word for time ("frame_003", "f12", "t=4", "time_07.h5"), with one number that differs in each.
/// Empty if there are fewer than two, if other numbered folders exist beside them, or, with digits
/// alone, any other folder. Looks at names only.
[[nodiscard]] NumberedFrames numbered_frames(const std::filesystem::path& folder);

}  // namespace episcope::io
