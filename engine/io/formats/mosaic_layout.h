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

/// What the name of a picture says about the views in it.
enum class MosaicName {
  Plain,     ///< Nothing.
  Mosaic,    ///< "lf.bmp", "lf.png", …: all views, in a way that is not told.
  Lenslets,  ///< "*_macpi.*", "*_lenslet.*", "*_lenslets.*".
  Eslf       ///< "*_eslf.*": lenslets of a Lytro camera.
};

/// Regardless of case. Plain for a file that is no image.
[[nodiscard]] MosaicName mosaic_name(const std::filesystem::path& path);

/// What the scene is called: "flower" of "Flower_eslf.png" and of "flower.png", in small letters.
[[nodiscard]] std::string scene_of_mosaic(const std::filesystem::path& path);

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

enum class Axis { X, Y };

/// Brightness along up to 400 rows (Axis::X) or columns (Axis::Y) spread over a picture: a line a
/// row, in units of the samples, the mean of the channels.
[[nodiscard]] Image<float> picture_lines(const AnyImage& picture, Axis axis);

/// Along one axis of a picture, equal tiles with equal lines of one colour between them.
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

/// The tiles of a picture with rows or columns of one colour at equal distances, of at least 32 px.
/// Nothing if there are none, or if margins and gaps are those of views that each have the same
/// border: these are views side by side.
[[nodiscard]] std::optional<ContactSheet> find_contact_sheet(const AnyImage& picture);

/// The tiles of the picture side by side.
[[nodiscard]] AnyImage without_gaps(const AnyImage& picture, const ContactSheet& sheet);

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
