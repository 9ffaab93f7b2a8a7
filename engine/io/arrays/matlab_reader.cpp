// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/matlab_reader.h"

#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_scene.h"
#include "engine/io/arrays/folder_file.h"
#include "engine/io/arrays/hdf5_arrays.h"
#include "engine/io/arrays/mat5_file.h"
#include "engine/io/arrays/matlab_file.h"

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMatlabReader = "matlab";

bool has_mat_name(const fs::path& path) {
  return suffix_of(path) == ".mat";
}

fs::path find_matlab(const fs::path& path, const OpenOptions&) {
  if (fs::is_directory(path)) return only_file_in(path, has_mat_name);
  if (has_mat_name(path) || is_mat5_file(path)) return path;
  return has_hdf5_signature(path) && is_matlab_hdf5(Hdf5Input(path)) ? path : fs::path();
}

Scene read_matlab(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  return read_array_scene(*open_matlab_file(path), kMatlabReader, options, progress);
}

SceneProbe probe_matlab(const fs::path& path, const OpenOptions& options) {
  return probe_arrays(*open_matlab_file(path), options);
}

}  // namespace

Reader matlab_reader() {
  return {.id = kMatlabReader,
          .name = "a MATLAB file",
          .options = array_options(),
          .find = find_matlab,
          .read = read_matlab,
          .probe = probe_matlab};
}

}  // namespace episcope::io
