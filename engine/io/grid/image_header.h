// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <filesystem>
#include <optional>

namespace episcope::io {

/// What `decode_image` would make of a file.
struct ImageHeader {
  int height = 0;
  int width = 0;
  int channels = 0;
  SampleType sample_type = SampleType::UInt8;
};

/// What the header of a PNG, JPEG, TIFF, BMP or PNM says; `channels` is 0 if a palette decides.
/// Nothing for other and for damaged files.
[[nodiscard]] std::optional<ImageHeader> stated_image_header(const std::filesystem::path& path);

/// Reads the header of a PNG, JPEG, TIFF, BMP or PNM; where that does not tell, the image is
/// decoded. Throws IoError.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& path);

}  // namespace episcope::io
