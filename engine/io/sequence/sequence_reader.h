// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

inline constexpr const char* kSequenceReader = "sequence";

/// Sequences of light fields: a folder of numbered folders or files (frame_names.h) that are light
/// fields of the same form and shape. Opens the frame of `OpenOptions::frame` by the reader of its
/// form.
[[nodiscard]] Reader sequence_reader();

/// The folder or file of the frame that was read; empty for what is no sequence, or no longer one.
[[nodiscard]] std::filesystem::path frame_path(const LightFieldInfo& info);

}  // namespace episcope::io
