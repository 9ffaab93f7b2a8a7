// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/array_file.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

struct matvar_t;

namespace episcope::io {

/// Whether a file begins as a MATLAB file of version 5 to 7, which is no HDF5 file.
[[nodiscard]] bool is_mat5_file(const std::filesystem::path& path);

/// A MATLAB file of version 5 to 7; fields of structures are named "s/LF". Compressed variables
/// stay in memory once read.
class Mat5File : public ArrayFile {
 public:
  /// Throws IoError for a damaged file.
  explicit Mat5File(const std::filesystem::path& path);
  ~Mat5File() override;

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override;

  class Content;
  /// A variable, a field of a struct, or a cell array or field of many structs that holds views.
  void add_variable(const std::string& name, matvar_t& variable, int depth);
  /// `cell` gives the elements of `variable`, a cell array or an array of structs.
  [[nodiscard]] bool add_cells(const std::string& name, const matvar_t& variable,
                               const std::function<matvar_t*(int)>& cell);

  std::unique_ptr<Content> content_;
};

/// Opens a MATLAB file of version 5 to 7.3. Throws IoError for a file of another kind, or a damaged
/// one.
[[nodiscard]] std::unique_ptr<const ArrayFile> open_matlab_file(const std::filesystem::path& path);

}  // namespace episcope::io
