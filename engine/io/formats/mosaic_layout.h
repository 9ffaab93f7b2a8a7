// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Meaning of the name of a picture for the views in it.
enum class MosaicName {
  Plain,     ///< Nothing.
  Mosaic,    ///< "lf.bmp", "lf.png", …: all views, in a way that is not told.
  Lenslets,  ///< "*_macpi.*", "*_lenslet.*", "*_lenslets.*".
  Quilt,     ///< "*_qs8x6a0.75.*": one line of views, side by side from the bottom left.
  Eslf       ///< "*_eslf.*": lenslets of a Lytro camera.
};

/// Classifies a name regardless of case. Plain for a file that is no image.
[[nodiscard]] MosaicName mosaic_name(const std::filesystem::path& path);

/// Name of the scene in small letters: "flower" of "Flower_eslf.png" and of "flower.png".
[[nodiscard]] std::string scene_of_mosaic(const std::filesystem::path& path);

/// Layout of all views in one picture. Pixel (x, y) of view (v, u) is at (x·columns + u, y·rows +
/// v) for lenslets, at (tile.u·width + x, tile.v·height + y) for views side by side.
struct MosaicLayout {
  Mosaic kind = Mosaic::Lenslets;  ///< Never Auto.
  GridShape grid;
  GridShape tiles;  ///< Rows and columns of views in the picture; of a quilt not the grid.
  int height = 0;   ///< Of a view, in px; what the grid does not divide is left over at the end.
  int width = 0;
  std::string evidence;  ///< What spoke for it: "the name", "the option --grid", with numbers.

  /// Where a view lies, of views side by side.
  [[nodiscard]] ViewIndex tile_of(ViewIndex view) const;
};

/// Finds the layout by the options `mosaic`, `lenslet` and `grid`, the name of the file, and the
/// period of the picture. Throws IoError, which names the options and calls the picture `subject`,
/// if the layout is not certain or does not fit the size; InvalidInput if options contradict each
/// other.
[[nodiscard]] MosaicLayout find_mosaic_layout(const AnyImage& picture,
                                              const std::filesystem::path& path,
                                              const OpenOptions& options,
                                              const std::string& subject = "this picture");

/// Whether lenslets so far apart need `with_whole_lenslets`.
[[nodiscard]] bool has_fraction(double pitch_px);

/// Resamples a picture of lenslets whose pitch is no whole number to the nearest one, along both
/// axes: cubically (Keys 1981), from the upper left corner, where a lenslet begins, to the last
/// whole lenslet. Disparity per view grows by the pitch over that number.
[[nodiscard]] SeenImage with_whole_lenslets(const SeenImage& picture, double pitch_px);

/// The layout of a picture of views side by side that shows by itself that it is one. Empty if it
/// does not, or cannot be decoded.
[[nodiscard]] std::optional<MosaicLayout> evident_mosaic(const std::filesystem::path& path);

/// Finds rows and columns of a lenslet from the decoded `top` of a picture of `height` px, as
/// `find_mosaic_layout` does for a picture named as one of lenslets. Empty if the top does not
/// tell.
[[nodiscard]] std::optional<GridShape> find_lenslets(const AnyImage& top, int height,
                                                     const std::filesystem::path& path,
                                                     const OpenOptions& options);

/// Equal tiles along one axis of a picture, with equal lines of one color between them.
struct TileGaps {
  int first = 0;  ///< Where the first tile begins, in px; a margin may come before it,
  int count = 1;
  int length = 0;  ///< Of a tile, in px.
  int gap = 0;     ///< Between two tiles, in px.
};

/// A contact sheet: views side by side with gaps.
struct ContactSheet {
  TileGaps x;
  TileGaps y;

  [[nodiscard]] GridShape grid() const { return {y.count, x.count}; }
  /// "gaps of 4×2 px left out".
  [[nodiscard]] std::string text() const;
};

/// Finds tiles of at least 32 px between rows or columns of one color at equal distances. Empty if
/// there are none, or if the gaps are equal borders of the views: these are views side by side.
[[nodiscard]] std::optional<ContactSheet> find_contact_sheet(const AnyImage& picture);

/// Joins the tiles of the picture side by side.
[[nodiscard]] AnyImage without_gaps(const AnyImage& picture, const ContactSheet& sheet);

/// Extracts one view of a mosaic. Precondition: the layout fits the picture.
[[nodiscard]] AnyImage mosaic_view(const AnyImage& picture, const MosaicLayout& layout,
                                   ViewIndex view);

/// Extracts all views of a mosaic, in parallel. Throws Cancelled.
[[nodiscard]] LightField::Samples split_mosaic(const AnyImage& picture, const MosaicLayout& layout,
                                               const Progress& progress);

/// Joins views of a light field to one picture of lenslets, `[y·rows + v][x·columns + u][c]`.
/// Throws Cancelled.
template <class T>
[[nodiscard]] Image<T> join_lenslets(const ViewStack<T>& views, const Progress& progress);

extern template Image<std::uint8_t> join_lenslets(const ViewStack<std::uint8_t>&, const Progress&);
extern template Image<std::uint16_t> join_lenslets(const ViewStack<std::uint16_t>&,
                                                   const Progress&);

}  // namespace episcope::io
