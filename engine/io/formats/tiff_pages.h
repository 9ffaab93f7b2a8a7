// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/base/image_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Order of pages if the channels of a view are pages: one after the other, or a part of the list
/// each.
struct PageOrder {
  int channels = 1;
  /// Views that follow each other before the next channel: 1 if the channels of a view do.
  int views_in_turn = 1;

  /// Page of a channel of a view; all count from 0.
  [[nodiscard]] int page(int view, int channel) const {
    return view % views_in_turn + views_in_turn * (channel + channels * (view / views_in_turn));
  }
};

/// Meaning of the pages of a TIFF file, as stated by the program that wrote it.
struct StatedPages {
  std::string program;              ///< "ImageJ", "OME-TIFF", "tifffile".
  PageOrder order;                  ///< One channel if no pages are.
  std::optional<GridShape> grid{};  ///< Rows and columns, if two axes are neither channels nor 1.
};

/// Reads a text ImageDescription: hyperstacks of ImageJ (`channels=2`, `slices=9`, `frames=9`),
/// OME-XML (`SizeC`, `SizeZ`, `SizeT`, `DimensionOrder`), and the shape that tifffile writes
/// (`{"shape": [9, 9, 512, 512]}`). Of the axes of a shape before those of a page, two are views;
/// of three, the last or the first are channels. More than 4 channels are views. Empty if the text
/// does not describe `pages` pages.
[[nodiscard]] std::optional<StatedPages> stated_pages(const std::string& description, int pages);

/// Counts the pages of a TIFF file by its directories, up to `most` + 1, or of a large file of
/// ImageJ, whose pages follow the only directory's one after the other, as it states. 0 for other
/// or damaged files.
[[nodiscard]] int count_tiff_pages(const std::filesystem::path& path, int most);

/// Reads the text ImageDescription of the first page of a TIFF file, cut off after 64 KiB. Empty if
/// there is none.
[[nodiscard]] std::string tiff_description(const std::filesystem::path& path);

/// Reads the pages of a large file of ImageJ, which follow the only directory's one after the
/// other. Empty for other files. Throws IoError.
[[nodiscard]] std::vector<AnyImage> read_imagej_pages(const std::filesystem::path& path);

}  // namespace episcope::io
