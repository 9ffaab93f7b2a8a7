// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Which files of a folder belong to a picture of all views: those named after its scene
/// ("flower_depth.png" to "flower_eslf.png", and not to "flower_2_eslf.png"); if no other picture
/// of the folder is a light field (`is_only_mosaic`), all that are not named after one of the
/// same size.
class OwnFiles {
 public:
  explicit OwnFiles(const std::filesystem::path& picture);

  [[nodiscard]] bool contains(const std::filesystem::path& file) const;

 private:
  std::string scene_;
  std::vector<std::string> others_;  ///< Scenes of other pictures of all views.
  bool is_only_ = false;
};

}  // namespace episcope::io
