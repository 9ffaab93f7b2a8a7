// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/reader.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

inline constexpr const char* kSequenceReader = "sequence";

/// Sequences of light fields: a folder of numbered folders or files that are light
/// fields of the same form and shape, or of the images of all of them. Opens the
/// frame of `OpenOptions::frame` by the reader of its form.
[[nodiscard]] Reader sequence_reader();

/// The folder or file of the frame that was read, or `folder/frame_3`, which is not there, of
/// images of one folder; empty for what is no sequence, or no longer one.
[[nodiscard]] std::filesystem::path frame_path(const LightFieldInfo& info);

/// Folders or files of one folder whose names differ in one running number.
struct NumberedFrames {
  std::vector<std::filesystem::path> paths;  ///< By their number.
  std::vector<long> numbers;                 ///< In names, ascending.
};

/// The folders, else the files, of `folder` whose names say that they follow each other: digits
/// alone ("0001"), or with a word for time ("frame_003", "f12", "t=4", "time_07.h5"), and one
/// number that is different in each. Empty if there are fewer than two, if other numbered folders
/// are beside them, or, with digits alone, any other folder. Looks at names only.
[[nodiscard]] NumberedFrames numbered_frames(const std::filesystem::path& folder);

/// Likewise the images of `folder`.
[[nodiscard]] NumberedFrames numbered_images(const std::filesystem::path& folder);

}  // namespace episcope::io
