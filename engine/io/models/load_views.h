// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/names/view_files.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {

/// Called with an 8-bit RGB picture of the center view before the others are read.
using OnCenterView = std::function<void(const Image<std::uint8_t>& center_rgb)>;

/// Samples of views, and which of their pixels hold something.
struct LoadedViews {
  LightField::Samples samples;
  /// 0 = transparent, or nothing is stored (`decode_seen`); empty = all are seen, or none is: of
  /// pictures that are transparent as a whole alpha means nothing.
  ViewStack<std::uint8_t> valid{};
};

/// Joins what is seen of each view (`SeenImage`) as in LoadedViews. An image of another size counts
/// as seen.
[[nodiscard]] ViewStack<std::uint8_t> joined_seen(const std::vector<Image<std::uint8_t>>& seen,
                                                  GridShape grid, ImageSize size);

/// Decodes the views in parallel, upright, the center first. Throws IoError that names the file if
/// one cannot be decoded or differs from the center view in size, channels or depth. Throws
/// Cancelled.
[[nodiscard]] LoadedViews load_views(const ViewFiles& views, const OnCenterView& on_center,
                                     const Progress& progress);

/// Samples of the views of a grid that can be used together.
struct UsableViews {
  LoadedViews pixels;
  ViewFiles views;                   ///< All, or the part of them that `pixels` holds.
  std::optional<PartOfGrid> kept{};  ///< That part, if it is not all.
  std::string warning{};             ///< What could not be used and why, and what is left.
};

/// Loads views of which some may be damaged or differ from most in size or depth. These count as
/// missing, and the largest part without them is kept (`without_views`). Throws IoError about the
/// first of them if there is no such part. Throws Cancelled.
[[nodiscard]] UsableViews load_usable_views(const ViewFiles& views, const OnCenterView& on_center,
                                            const Progress& progress);

/// Converts one view to 8-bit RGB, for the first look at a scene.
template <class T>
[[nodiscard]] Image<std::uint8_t> preview_rgb(ImageView<const T> view) {
  Image<std::uint8_t> rgb(view.height, view.width, 3);
  const auto to_byte = [](T value) {
    if constexpr (std::is_same_v<T, std::uint8_t>) return value;
    const double unit =
        static_cast<double>(value) /
        (std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0);
    return static_cast<std::uint8_t>(255 * std::clamp(unit, 0.0, 1.0) + 0.5);
  };
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (int c = 0; c < 3; ++c) rgb.at(y, x, c) = to_byte(view.at(y, x, c % view.channels));
    }
  }
  return rgb;
}

/// Throws IoError for `path` if views fit neither into memory nor, unpacked, into the scratch
/// folder. The system would accept them at first and end the program later.
void require_view_memory(const std::filesystem::path& path, double bytes);

/// Orientation of the camera as stated in JPEG, PNG and WebP files (Exif 2.3, tag 0x0112): 1 =
/// upright, 3 = upside down, 6 and 8 = turned by a quarter, others mirrored. 1 for other files
/// (TIFF is decoded upright) and where nothing is stated. Reads headers only. Throws nothing.
[[nodiscard]] int exif_orientation(const std::filesystem::path& path);

/// Turns the image upright.
[[nodiscard]] AnyImage upright(AnyImage stored, int orientation);
/// Whether this orientation exchanges rows and columns of pixels.
[[nodiscard]] constexpr bool is_quarter_turn(int orientation) {
  return orientation > 4;
}

/// How the stored rows of pixels lie, for reports: "turned by half".
[[nodiscard]] std::string_view orientation_text(int orientation);

/// Orientation in which to show views: the one that all files state, or 1 if they differ. `note` is
/// a sentence for the report if samples are not stored so.
struct CommonOrientation {
  int value = 1;
  std::string note;
};
[[nodiscard]] CommonOrientation common_orientation(const std::vector<std::filesystem::path>& files);

}  // namespace episcope::io
