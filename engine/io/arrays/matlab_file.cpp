// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/matlab_file.h"

#include "engine/core/error.h"
#include "engine/io/arrays/hdf5_arrays.h"
#include "engine/io/arrays/mat5_file.h"

namespace episcope::io {

std::unique_ptr<const ArrayFile> open_matlab_file(const std::filesystem::path& path) {
  if (is_mat5_file(path)) return std::make_unique<const Mat5File>(path);
  if (!has_hdf5_signature(path)) {
    throw IoError(path,
                  "this is not a MATLAB file of version 5 or later, despite its name; choose "
                  "another file");
  }
  return std::make_unique<const Hdf5Arrays>(std::make_shared<const Hdf5Input>(path));
}

}  // namespace episcope::io
