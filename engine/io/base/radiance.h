// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <filesystem>

namespace episcope::io {

/// Whether a file begins as a Radiance picture (.hdr) does.
[[nodiscard]] bool has_radiance_signature(const std::filesystem::path& path);

/// Decodes a Radiance picture, rows from top to bottom, four bytes a pixel (RGB with a common
/// exponent) as they are or in runs, to three linear channels. Throws IoError for other kinds and
/// for a file that is damaged. By ourselves, because OpenCV 4.6 leaves a file open with each that
/// is damaged. Source: Ward, "Real Pixels", Graphics Gems II, 1991.
[[nodiscard]] Image<float> decode_radiance(const std::filesystem::path& path);

}  // namespace episcope::io
