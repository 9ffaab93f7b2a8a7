// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/stored_maps.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// Finds the only group that holds LF in the form of the archive with GT_DEPTH or its two layers
/// beside it, in a file without LF at its root. Empty if there is none, or several.
[[nodiscard]] std::string archive_group(const Hdf5Input& file);

/// Opens a file of the archive, with that group in place of the root. Throws IoError.
[[nodiscard]] std::shared_ptr<const Hdf5Input> open_archive_file(const std::filesystem::path& path);

/// The dataset of an archive file that holds the views.
inline constexpr const char* kArchiveLightField = "LF";

/// How it is stored: [v][h][y][x][c] or, grey, [v][h][y][x].
struct ArchiveLayout {
  FieldShape shape;
  int channels = 1;  ///< That are read, without an alpha channel.
  bool has_channel_axis = true;
  Hdf5Type type = Hdf5Type::UInt8;
};

/// Whether a file of labels that does not name its light field belongs to this one: of `labels.h5`,
/// only if no other file in the folder holds a light field, or to `lf.h5`.
[[nodiscard]] bool is_label_file_of(const std::filesystem::path& file,
                                    const std::filesystem::path& labels);

/// Reads the layout. Throws IoError if there is no such dataset, or if it holds no light field.
[[nodiscard]] ArchiveLayout archive_layout(const Hdf5Input& file);

/// Warns of attributes that state another size than the shape of LF.
void compare_sizes(const Hdf5Input& file, ConventionReport& report);

/// Order of views by the attributes: as stated, else the order of raw archive files.
[[nodiscard]] ExpectedOrder expected_order(const Hdf5Input& file);

/// Probes the headers of an archive file, and of labels.h5 beside it. Throws IoError.
[[nodiscard]] SceneProbe probe_archive(const std::filesystem::path& path,
                                       const OpenOptions& options);

/// Disparity from the depth of an archive file, in the stored order of views.
struct ArchiveTruth {
  DisparityField field;
  DisparityField foreground;
  DisparityField background;
  CameraGrid camera;  ///< With units settled; unknown if the file states so.
  /// Depth that no camera of the file turns into disparity; else empty,
  std::string unused_depth;
  std::string camera_fault;     ///< and why not.
  bool has_attributes = false;  ///< Of a camera, though they are of no use.
};

/// Reads GT_DEPTH and the datasets of transparent scenes with their masks, finds the units and
/// converts depth to disparity; `report` tells the decisions. Depth that is zero, negative or NaN
/// is invalid. Views without any valid depth are dropped. Without `options.needs_truth` only the
/// center view is read. Throws IoError, Cancelled.
[[nodiscard]] ArchiveTruth read_archive_depth(const Hdf5Input& file,
                                              const LightField::Samples& samples,
                                              const OpenOptions& options, ConventionReport& report,
                                              const Progress& progress);

/// Reads camera attributes as stored, on the root or on LF. The camera is unknown if one is missing
/// or not finite, or if the file states that it has none.
[[nodiscard]] CameraGrid read_camera(const Hdf5Input& file);

/// Depth as stored, with the mask beside it; views in the stored order.
struct DepthMaps {
  std::string name;
  ViewStack<float> depth;
  ViewStack<std::uint8_t> mask;  ///< Empty, or of the same or of a single view.

  [[nodiscard]] bool empty() const { return depth.empty(); }
  [[nodiscard]] bool is_valid(ViewIndex view, int y, int x) const {
    const float z = depth.view(view).at(y, x);
    const bool is_masked = mask.contains(view) && mask.view(view).at(y, x) == 0;
    return std::isfinite(z) && z > 0 && !is_masked;
  }
};

/// Decides the units of `stored` by the depth and by warping views; `report` tells the decision.
/// Linear in the size of five views.
[[nodiscard]] CameraGrid settle_units(const DepthMaps& maps, const LightField::Samples& samples,
                                      const CameraGrid& stored, Units units,
                                      ConventionReport& report);

/// Converts depth to disparity in place. If only one view has valid depth, only that view is kept;
/// if none has, the field is empty. Tells `report` of pixels without depth. Throws Cancelled.
[[nodiscard]] DisparityField disparity_from_depth(DepthMaps maps, const CameraGrid& camera,
                                                  ConventionReport& report,
                                                  const Progress& progress);

/// The parts of an archive file read so far, in the stored order of views.
struct ArchiveParts {
  const LightField::Samples& samples;
  GroundTruth& truth;
  ViewStack<std::uint8_t>& valid;
  ExpectedOrder& expected;
  ConventionReport& report;
};

/// Reads datasets beside LF whose names are not the archive's: disparity, labels and masks as
/// `read_array_maps` does. Existing `parts` stay. Returns the
/// use of these datasets. Throws IoError, Cancelled.
[[nodiscard]] std::vector<FileUse> read_other_maps(const std::shared_ptr<const Hdf5Input>& file,
                                                   const ArchiveLayout& layout, bool wants_labels,
                                                   ArchiveParts parts, const Progress& progress);

}  // namespace episcope::io
