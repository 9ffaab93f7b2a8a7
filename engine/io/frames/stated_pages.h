// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/io/frames/channel_pages.h"

#include <optional>
#include <string>

namespace episcope::io {

/// What the pages of a TIFF file are, as the program that wrote it says.
struct StatedPages {
  std::string program;              ///< "ImageJ", "OME-TIFF", "tifffile".
  PageOrder order;                  ///< One channel if no pages are.
  std::optional<GridShape> grid{};  ///< Rows and columns, if two axes are neither channels nor 1.
};

/// Reads a text ImageDescription: hyperstacks of ImageJ (`channels=2`, `slices=9`, `frames=9`),
/// OME-XML (`SizeC`, `SizeZ`, `SizeT`, `DimensionOrder`), and the shape that tifffile writes
/// (`{"shape": [9, 9, 512, 512]}`), of whose axes before those of a page two are views, and of
/// three the last or the first are channels. More than 4 channels are views. Nothing where it says
/// nothing about `pages` pages.
[[nodiscard]] std::optional<StatedPages> stated_pages(const std::string& description, int pages);

}  // namespace episcope::io
