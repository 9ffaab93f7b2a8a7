// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/engine/io/models/sidecar_maps/layered_folder.h"

#include <string>
#include <utility>
#include <vector>

namespace episcope::test {

/// A folder of 5×5 views as the Blender add-on writes it, of the camera that LayeredScene has.
class RenderedFolder : public LayeredFolder {
 public:
  static constexpr GridShape kGrid{5, 5};
  static constexpr double kZeroPlane = LayeredScene::kA / LayeredScene::kB;

  RenderedFolder();

  /// All views.
  [[nodiscard]] static std::vector<ViewIndex> whole();
  /// Names of a part: `form` with row and column from 0 on, as the add-on counts.
  [[nodiscard]] static Name part(const std::string& form);

  /// `changed`: a part of the text, and what it is replaced by; with ' for ".
  void write_manifest(const std::vector<ViewIndex>& complete,
                      std::pair<std::string, std::string> changed = {}) const;
};

}  // namespace episcope::test
