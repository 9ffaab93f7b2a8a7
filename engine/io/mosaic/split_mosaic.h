// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/mosaic/mosaic_layout.h"

namespace episcope::io {

/// One view of a mosaic; its precondition is that the layout fits the picture.
[[nodiscard]] AnyImage mosaic_view(const AnyImage& picture, const MosaicLayout& layout,
                                   ViewIndex view);

/// All views of a mosaic, in parallel. Throws Cancelled.
[[nodiscard]] LightField::Samples split_mosaic(const AnyImage& picture, const MosaicLayout& layout,
                                               const Progress& progress);

/// Views of a light field as one picture of lenslets, `[y·rows + v][x·columns + u][c]`. Throws
/// Cancelled.
template <class T>
[[nodiscard]] Image<T> join_lenslets(const ViewStack<T>& views, const Progress& progress);

extern template Image<std::uint8_t> join_lenslets(const ViewStack<std::uint8_t>&, const Progress&);
extern template Image<std::uint16_t> join_lenslets(const ViewStack<std::uint16_t>&,
                                                   const Progress&);

}  // namespace episcope::io
