// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/base/array_input.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// In which order people index the axes of an array.
enum class IndexOrder {
  C,       ///< As in the file: the last axis is contiguous (NumPy, h5py).
  Fortran  ///< Reversed: the first one is (MATLAB, NumPy in Fortran order).
};

/// The shape, or the letters of axes, in the other order of indices.
[[nodiscard]] ArrayShape in_index_order(ArrayShape stored, IndexOrder order);
[[nodiscard]] std::string in_index_order(std::string axes, IndexOrder order);

/// Instead of a letter, for an axis of length 1 that means nothing.
inline constexpr char kSingle = '1';

/// What the axes of an array mean: a letter each, v and u for rows and columns of views, y and x
/// for those of pixels, c for channels, n for views in a list.
struct ArrayLayout {
  ArrayShape shape;  ///< As stored: the last axis is contiguous.
  std::string axes;  ///< Of `shape`.

  [[nodiscard]] bool has(char letter) const { return axes.find(letter) != std::string::npos; }
  /// 1 for an axis that the array lacks.
  [[nodiscard]] std::size_t length(char letter) const;
  /// In elements of the file; 0 for an axis that the array lacks.
  [[nodiscard]] std::size_t stride(char letter) const;
  /// Whether all views of a pixel lie together, not all pixels of a view.
  [[nodiscard]] bool views_are_fastest() const;
  [[nodiscard]] int height() const { return count('y'); }
  [[nodiscard]] int width() const { return count('x'); }
  /// Of a list: 1×N. What a damaged file claims may have more views than an `int` counts.
  [[nodiscard]] GridShape grid() const;
  [[nodiscard]] bool has_one_view() const { return grid() == GridShape{1, 1}; }
  /// With rows and columns of views exchanged.
  [[nodiscard]] ArrayLayout crossed() const;

 private:
  // The length as an `int`, or the largest one.
  [[nodiscard]] int count(char letter) const;
};

/// Every meaning that an array of this shape can have as a light field: channels are 1, 3 or 4;
/// rows and columns of views lie side by side, as those of pixels do; views have more rows and
/// columns than their grid; channels lie first, last, or between grid and pixels; further axes have
/// the length 1 and stand first. Rows are taken to
/// come before columns in the order of indices, but for arrays of pixels before views with channels
/// first, as MATLAB's in other programs, in which columns come first. Arrays of 3 axes are lists of
/// grey views, which come last only if they are fewer than rows and columns of pixels, or if these
/// are a square, or if they are a square number less than one of the two; of 4, grey views or
/// lists. Where nothing else fits, rows of views may stand beside those of pixels ("vyuxc",
/// "yvxuc"). In C order 1×N views, and N grey ones with one channel before rows of pixels, are a
/// list, too ("1nyxc", "ncyx").
[[nodiscard]] std::vector<ArrayLayout> possible_layouts(const ArrayShape& stored, IndexOrder order);

/// The layout that `axes` states, in the order of indices ("vuyxc", "v,u,y,x"; s and t as in
/// MATLAB's light fields: t for rows, s for columns of views). Throws InvalidInput that names
/// `path` and shape if they do not fit each other.
[[nodiscard]] ArrayLayout stated_layout(const std::filesystem::path& path, const ArrayShape& stored,
                                        const std::string& axes, IndexOrder order);

/// "9×9×512×512×3 (vuyxc)", in the order of indices.
[[nodiscard]] std::string layout_text(const ArrayLayout& layout, IndexOrder order);

}  // namespace episcope::io
