// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/read_result.h"

#include "engine/core/error.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/maps/result_file.h"

namespace episcope {

namespace fs = std::filesystem;

bool holds_light_field(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored) || !io::has_hdf5_signature(path)) return false;
  const io::Hdf5Input file(path);
  return file.has("LF") || file.has("GT_DEPTH") || file.has("GT_DEPTH_FOREGROUND") ||
         file.has("GT_DEPTH_BACKGROUND");
}

Estimate read_result_of(const LightField& light_field, const fs::path& path) {
  if (holds_light_field(path) && !io::is_result_file(path)) {
    throw IoError(path,
                  "holds a light field or true depth and no estimated disparity; name a result");
  }
  return io::read_result(path, light_field.grid(), light_field.info().name);
}

bool is_of_other_samples(const Estimate& estimate, const LightField& light_field) {
  return estimate.source_hash != 0 && estimate.source_hash != light_field.sample_hash();
}

}  // namespace episcope
