// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <QImage>

#include <cstdint>

namespace episcope {

/// QImage over the samples of an RGBA8 image `[y][x][4]`, which it takes over without a copy, as
/// premultiplied ARGB, which draws fastest. Null for an empty image. Precondition: 4 channels.
[[nodiscard]] QImage to_qimage(Image<std::uint8_t>&& rgba);

/// Copies the samples as RGBA8 `[y][x][4]`; empty for a null picture.
[[nodiscard]] Image<std::uint8_t> to_picture(const QImage& picture);

}  // namespace episcope
