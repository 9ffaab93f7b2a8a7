// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/decode_image.h"
#include "engine/io/open/open_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// How one picture holds all views. Of lenslets, view (v, u) has its pixel (x, y) at
/// (x·columns + u, y·rows + v); of views side by side, at (u·width + x, v·height + y).
struct MosaicLayout {
  Mosaic kind = Mosaic::Lenslets;  ///< Never Auto.
  GridShape grid;
  int height = 0;  ///< Of a view, in px; what the grid does not divide is left over at the end.
  int width = 0;
  std::string evidence;  ///< What spoke for it: "the name", "the option --grid", with numbers.
};

/// Finds the layout by the options `mosaic`, `lenslet` and `grid`, the name of the file, and the
/// period of the picture. Throws IoError, which names the options, if that is not certain or does
/// not fit the size of the picture, which they call `subject`; InvalidInput if options contradict
/// each other.
[[nodiscard]] MosaicLayout find_mosaic_layout(const AnyImage& picture,
                                              const std::filesystem::path& path,
                                              const OpenOptions& options,
                                              const std::string& subject = "this picture");

/// Rows and columns of a lenslet of a picture of `height` px of which only `top` is decoded, as
/// `find_mosaic_layout` would find them if its name tells that it consists of lenslets; nothing
/// where the top does not tell.
[[nodiscard]] std::optional<GridShape> find_lenslets(const AnyImage& top, int height,
                                                     const std::filesystem::path& path,
                                                     const OpenOptions& options);

}  // namespace episcope::io
