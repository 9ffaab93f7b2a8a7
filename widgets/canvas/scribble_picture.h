// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/label_set.h"
#include "annotation/paint/pixel_region.h"
#include "engine/core/array/image.h"
#include "engine/render/shade.h"

#include <QImage>

#include <cstdint>

namespace episcope {

/// The labels of one view, `[y][x]`; an empty image stands for zeros.
struct ScribbleLayers {
  ImageView<const std::uint8_t> painted;
  ImageView<const std::uint8_t> carried;  ///< From other views; drawn where nothing is painted.
};

/// The pixels of `rect`, in the colours of the labels, on a transparent ground: painted ones
/// opaque and in this style, carried ones as fainter stripes. Unknown labels get their default
/// colour. Linear in the pixels of `rect`, which lies inside the view.
[[nodiscard]] QImage scribble_picture(const ScribbleLayers& layers, const LabelSet& labels,
                                      const PixelRect& rect, const render::LabelStyle& style = {});

}  // namespace episcope
