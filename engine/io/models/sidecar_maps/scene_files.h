// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Tells by names which maps belong to a light field, where others share its folder.
class SceneFiles {
 public:
  /// `scenes`: what the light field is called; `others`: what others of the folder may be called.
  /// `is_only`: maps that name no light field belong to this one. `self`: the name of the file that
  /// holds the light field, which is no map of it. Upper and lower case count alike.
  SceneFiles(std::vector<std::string> scenes, std::vector<std::string> others, bool is_only,
             std::string self = {});

  /// What the light field is called, in lower case.
  [[nodiscard]] const std::vector<std::string>& scenes() const { return scenes_; }

  /// Whether a file or folder is called after the light field ("cotton_disparity.npy",
  /// "labels_cotton"), and not after another with a longer name there ("cotton_2_disparity.npy").
  [[nodiscard]] bool is_named_after(const std::filesystem::path& file) const;

  /// Also whether it names no light field at all ("gt_disparity.npy"), if this is the only one.
  [[nodiscard]] bool contains(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> scenes_;
  std::vector<std::string> others_;
  bool is_only_;
  std::string self_;
};

/// Stems of the files in the folder of `file` that may be other light fields, and names of the
/// folders there that hold pictures or arrays and are none of maps.
[[nodiscard]] std::vector<std::string> light_fields_beside(const std::filesystem::path& file);

}  // namespace episcope::io
