// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

inline constexpr const char* kSequenceReader = "sequence";

/// Sequences of light fields: a folder of numbered folders or files (frame_names.h) that are light
/// fields of the same form and shape, or of the images of all of them (camera_frames.h). Opens the
/// frame of `OpenOptions::frame` by the reader of its form.
[[nodiscard]] Reader sequence_reader();

/// The folder or file of the frame that was read, or `folder/frame_3`, which is not there, of
/// images of one folder; empty for what is no sequence, or no longer one.
[[nodiscard]] std::filesystem::path frame_path(const LightFieldInfo& info);

}  // namespace episcope::io
