// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_size.h"

#include "engine/io/grid/image_header.h"

namespace episcope::io {

std::optional<ImageSize> image_size(const std::filesystem::path& path) {
  const auto header = stated_image_header(path);
  return header ? std::optional(ImageSize{header->height, header->width}) : std::nullopt;
}

}  // namespace episcope::io
