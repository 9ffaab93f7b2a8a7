// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/io/base/array_input.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Order in which the axes of an array are indexed.
enum class IndexOrder {
  C,       ///< As in the file: the last axis is contiguous (NumPy, h5py).
  Fortran  ///< Reversed: the first one is (MATLAB, NumPy in Fortran order).
};

/// Converts a stored shape, or letters of axes, to an index order.
[[nodiscard]] ArrayShape in_index_order(ArrayShape stored, IndexOrder order);
[[nodiscard]] std::string in_index_order(std::string axes, IndexOrder order);

/// Stands for an axis of length 1 without meaning.
inline constexpr char kSingle = '1';

/// Meaning of the axes of an array, a letter each: v and u for rows and columns of views, y and x
/// for rows and columns of pixels, c for channels, n for views in a list.
struct ArrayLayout {
  ArrayShape shape;  ///< As stored: the last axis is contiguous.
  std::string axes;  ///< Of `shape`.

  [[nodiscard]] bool has(char letter) const { return axes.find(letter) != std::string::npos; }
  /// Length of an axis; 1 if the array lacks it.
  [[nodiscard]] std::size_t length(char letter) const;
  /// Stride of an axis in elements of the file; 0 if the array lacks it.
  [[nodiscard]] std::size_t stride(char letter) const;
  /// Whether all views of a pixel lie together, not all pixels of a view.
  [[nodiscard]] bool views_are_fastest() const;
  [[nodiscard]] int height() const { return count('y'); }
  [[nodiscard]] int width() const { return count('x'); }
  /// Grid of the views; 1×N for a list. A damaged file may claim more views than an `int` counts.
  [[nodiscard]] GridShape grid() const;
  [[nodiscard]] bool has_one_view() const { return grid() == GridShape{1, 1}; }
  /// The layout with rows and columns of views exchanged.
  [[nodiscard]] ArrayLayout crossed() const;

 private:
  // The length as an `int`, or the largest one.
  [[nodiscard]] int count(char letter) const;
};

/// Lists every meaning that an array of this shape can have as a light field. Channels are 1, 3 or
/// 4 and lie first, last, or between grid and pixels. Rows and columns of views are adjacent, and
/// so are rows and columns of pixels. Views have more rows and columns than their grid. Further
/// axes have the length 1 and stand first. Rows come before columns in the order of indices. The
/// exception are pixels before views with channels first, as other programs write MATLAB's arrays:
/// columns come first. Arrays of 3 axes are lists of gray views. The list comes last only if it is
/// shorter than rows and columns of pixels, if these form a square, or if its length is a square
/// number less than one of the two. Arrays of 4 axes are gray views or lists. Where nothing else
/// fits, rows of views may stand beside rows of pixels ("vyuxc", "yvxuc"). In C order, 1×N views,
/// and N gray ones with one channel before rows of pixels, are a list too ("1nyxc", "ncyx").
[[nodiscard]] std::vector<ArrayLayout> possible_layouts(const ArrayShape& stored, IndexOrder order);

/// The letters of axes as `stated_layout` takes them, with v and u for t and s. Throws InvalidInput
/// for a letter that is no axis or stands there twice.
[[nodiscard]] std::string axis_letters(const std::string& axes);

/// Parses `axes` in the order of indices: "vuyxc", "v,u,y,x", or with t for rows and s for columns
/// of views, as in MATLAB's light fields. Throws InvalidInput that names `path` and shape if axes
/// and shape do not fit.
[[nodiscard]] ArrayLayout stated_layout(const std::filesystem::path& path, const ArrayShape& stored,
                                        const std::string& axes, IndexOrder order);

/// "9×9×512×512×3 (vuyxc)", in the order of indices.
[[nodiscard]] std::string layout_text(const ArrayLayout& layout, IndexOrder order);

/// Reads a view as an 8-bit RGB picture for a first look. Samples other than 8 and 16-bit ones are
/// scaled by the largest. Where all views of a pixel lie together, rows or columns are read for at
/// most 0.7 s, every 64th first; the others repeat their neighbors. Throws IoError.
[[nodiscard]] Image<std::uint8_t> array_preview(const ArrayInput& array, const ArrayLayout& layout,
                                                ViewIndex view);

/// Reads a window of at most `side`×`side` pixels from the middle of each view: the green or only
/// channel, of any range. Throws IoError.
[[nodiscard]] std::vector<Image<float>> array_windows(const ArrayInput& array,
                                                      const ArrayLayout& layout,
                                                      const std::vector<ViewIndex>& views,
                                                      int side);

}  // namespace episcope::io
