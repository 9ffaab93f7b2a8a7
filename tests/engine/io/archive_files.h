// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/order/view_axes.h"

#include <functional>

namespace episcope::test {

/// What a hand-made archive file is to look like.
struct RawArchive {
  io::ViewFlip flip{};         ///< Stored order relative to the canonical one.
  double attribute_scale = 1;  ///< Factor on dH and shift.
  bool has_depth = true;
  bool is_center_only = false;  ///< GT_DEPTH as [y][x].
  bool has_attributes = true;
  /// Changes depth before it is written: (view as stored, y, x, depth) → depth.
  std::function<float(ViewIndex, int, int, float)> depth{};
  std::function<void(io::Hdf5Output&)> more{};  ///< Adds datasets or attributes.
};

/// Writes a scene as a raw file of the 2013 archive, without an attribute that states the order.
void write_raw_archive(const std::filesystem::path& path, const Scene& scene,
                       const RawArchive& form);

/// Adds a dataset of constant bytes, for masks and the like.
void add_bytes(io::Hdf5Output& file, const std::string& name, const io::Hdf5Shape& shape,
               const std::vector<std::uint8_t>& values);

}  // namespace episcope::test
