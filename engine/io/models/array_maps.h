// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/models/array_file.h"

#include <cstddef>
#include <string>
#include <vector>

namespace episcope::io {

/// Maps beside the light field in a file of arrays.
struct ArrayMaps {
  GroundTruth truth;               ///< In the order of views as stored.
  ViewStack<std::uint8_t> valid;   ///< Likewise; empty = none.
  std::vector<FileUse> uses;       ///< Every array of the file but the light field: used as what.
  std::vector<std::string> notes;  ///< On what was turned.
  std::string disparity_name;      ///< Of the array that holds the disparity.
  bool is_sign_assumed = false;    ///< Nothing tells near from far in it.
  bool is_named_labels = false;    ///< That name is one of labels, but it holds fractions.

  /// The name for the report, with the reason why it is not taken for labels.
  [[nodiscard]] std::string disparity_text() const;
};

/// The axes of the light field, with the letters of the stored shape.
struct FieldAxes {
  ArrayLayout layout;
  IndexOrder order = IndexOrder::C;
};

/// How reports call a disparity that is named like labels.
inline constexpr const char* kNamedLabels = "named like labels, but with fractions";

/// Whether any value that is finite is not whole.
[[nodiscard]] bool has_fractions(const ViewStack<float>& values);

/// A warning that a mask leaves out more than 5 % of the known pixels; else empty.
[[nodiscard]] std::string masked_text(const std::string& mask, std::size_t lost, std::size_t known);

/// Reads disparity, labels and masks of the center view or of all views among `others`. Names tell
/// the kind (`map_kind`, `is_bare_truth_name`), and which of several is true (`map_claim`); axes
/// must match the light field without channels, if need be with y and x exchanged, which is noted.
/// A list of as many maps as views is taken row by row. Other arrays are noted as not used. A mask
/// of one view belongs to the disparity of one view. Fractional floats named like labels are
/// disparity, as EPINET names it, if there is no other. Throws IoError, Cancelled.
[[nodiscard]] ArrayMaps read_array_maps(const ArrayFile& file,
                                        const std::vector<const ArrayEntry*>& others,
                                        const FieldAxes& light_field, bool wants_labels,
                                        const Progress& progress);

/// What arrays hold beside the light field, by their names, axes and types alone: "disparity of all
/// views", "labels of one view"; empty = none. Floats named like labels count as disparity.
struct ListedMaps {
  std::string disparity;
  std::string labels;
};
[[nodiscard]] ListedMaps list_array_maps(const std::vector<const ArrayEntry*>& others,
                                         const FieldAxes& light_field);

/// Converts stored disparity to px per view step, positive = nearer, by the evidence of the views
/// (`infer_units`, `find_occlusion_order`), and tells the report. `field` is the truth of `maps`,
/// which may have been moved; `maps` notes whether the sign is assumed.
void settle_disparity(const LightField::Samples& samples, ArrayMaps& maps, DisparityField& field,
                      ConventionReport& report);

}  // namespace episcope::io
