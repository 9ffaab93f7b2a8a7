// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/models/array_file.h"

#include <string>
#include <vector>

namespace episcope::io {

/// What lies beside the light field in a file of arrays.
struct ArrayMaps {
  GroundTruth truth;              ///< In the order of views as stored.
  ViewStack<std::uint8_t> valid;  ///< Likewise; empty = none.
  std::vector<FileUse> uses;      ///< Every array of the file but the light field: used as what.
  std::string disparity_name;     ///< Of the array that holds the disparity.
  bool is_depth = false;          ///< Or, where there is none, depth of unknown unit.
  bool is_sign_assumed = false;   ///< Nothing tells near from far in it.
  bool is_named_labels = false;   ///< That name is one of labels, but it holds fractions.

  /// For the report: the name, and why it is not taken for labels.
  [[nodiscard]] std::string disparity_text() const;
};

/// The axes of the light field, whose letters are those of the stored shape.
struct FieldAxes {
  ArrayLayout layout;
  IndexOrder order = IndexOrder::C;
};

/// How reports call a disparity that is named like labels.
inline constexpr const char* kNamedLabels = "named like labels, but with fractions";

/// Whether any value that is finite is not whole.
[[nodiscard]] bool has_fractions(const ViewStack<float>& values);

/// Reads disparity, labels and masks (by their names: `map_kind`, or "gt") of the centre view or of
/// all views, whose axes are those of the light field without channels, among `others` of the file.
/// What has another name or shape is noted as not used. A mask of one view is that of the disparity
/// of one view. Floats with fractions that are named like labels are disparity, as EPINET names it,
/// where there is no other. Throws IoError, Cancelled.
[[nodiscard]] ArrayMaps read_array_maps(const ArrayFile& file,
                                        const std::vector<const ArrayEntry*>& others,
                                        const FieldAxes& light_field, bool wants_labels,
                                        const Progress& progress);

/// Brings disparity as stored into px per view step, positive = nearer, as the views speak for
/// (`settle_values`, `find_near_side`), and tells the report. Depth becomes disparity, and gives
/// the camera if that is not known, where the views tell its unit (`settle_unknown_values`); else
/// it is not used. Whether the sign is assumed is noted in `maps`, of whose truth `field` is,
/// wherever it is by now.
void settle_disparity(const LightField::Samples& samples, ArrayMaps& maps, DisparityField& field,
                      CameraGrid& camera, ConventionReport& report);

}  // namespace episcope::io
