// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/core/error.h"
#include "engine/core/light_field/light_field.h"
#include "engine/io/open/open_options.h"

#include <optional>
#include <string>

namespace episcope::io {

/// A file is sound, but holds labels, maps or other things and no light field.
class NoLightField : public IoError {
 public:
  using IoError::IoError;
};

/// What the headers of a light field tell of it, before anything is decoded. Values that they do
/// not tell are 0 or empty.
struct SceneProbe {
  GridShape grid{};
  int height = 0;
  int width = 0;
  int channels = 0;
  std::optional<SampleType> sample_type{};
  std::string truth{};   ///< "disparity of all views"; empty = none.
  std::string labels{};  ///< "labels of all views, scribbles"; empty = none.
  int list = 0;          ///< Views of a list whose rows and columns only its images tell.
  int frames = 0;        ///< Of a sequence of light fields; 0 = a single one.
};

}  // namespace episcope::io
