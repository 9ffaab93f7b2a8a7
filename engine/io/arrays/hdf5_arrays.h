// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// Whether an HDF5 file was written by MATLAB (version 7.3), or as MATLAB writes: a block of 512
/// bytes that says so precedes it, or its datasets have the attribute MATLAB_class. Then the axes
/// are those of MATLAB reversed.
[[nodiscard]] bool is_matlab_hdf5(const Hdf5Input& file);

/// The datasets of an HDF5 file and of the groups in it (structs of MATLAB): "LF", "s/LF". The
/// attribute `axes` of a dataset is taken for what it states. Datasets that are parts of one, by
/// their names, are one array (`join_arrays`).
class Hdf5Arrays : public ArrayFile {
 public:
  static constexpr const char* kPlainForm = "HDF5 file";
  /// Throws IoError.
  explicit Hdf5Arrays(std::shared_ptr<const Hdf5Input> file);

  [[nodiscard]] bool is_matlab() const { return form() != kPlainForm; }

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override;

  /// A cell array of MATLAB whose cells are views.
  [[nodiscard]] bool add_cells(const Hdf5Dataset& dataset,
                               const std::vector<Hdf5Dataset>& datasets);

  std::shared_ptr<const Hdf5Input> file_;
};

}  // namespace episcope::io
