// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

namespace episcope::io {

struct ImageSize {
  int height = 0;
  int width = 0;
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
  [[nodiscard]] long long area() const { return static_cast<long long>(height) * width; }
};

/// The size of an image as its header says, of PNG, JPEG, BMP and TIFF files; nothing is decoded.
/// Nothing for other and for damaged files.
[[nodiscard]] std::optional<ImageSize> image_size(const std::filesystem::path& path);

}  // namespace episcope::io
