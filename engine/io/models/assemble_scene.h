// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/order/view_axes.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Data that a reader has gathered, in the order of views as stored.
struct SceneParts {
  LightField::Samples samples;
  GroundTruth truth;
  LightFieldInfo info;
  ExpectedOrder expected;
  /// 0 = a pixel without content, in the order of views as stored; empty = all are valid.
  ViewStack<std::uint8_t> valid{};
  std::vector<FileUse> files{};       ///< What became of the files of the folder (FileUsage).
  std::optional<AxesFinding> axes{};  ///< Set if the reader has compared rows and columns.
};

/// Shows EPIs (OpenOptions::on_center_epis) as stored. For readers that read more before they
/// assemble.
void show_epis(const LightField::Samples& samples, const OpenOptions& options);

/// Finishes reading: brings the parts into canonical order, sets samples that are not finite to 0,
/// and stores light field and, if needed, truth in `scene`. Shows EPIs
/// (OpenOptions::on_center_epis) as stored, and again once the order is known. Continues the report
/// of `scene`. Stores the given options in the light field's `reading`. Throws Cancelled.
void assemble(SceneParts parts, const OpenOptions& options, Scene& scene, const Progress& progress);

/// Whether the options state which axis of views is rows and which is columns.
[[nodiscard]] bool are_axes_stated(const OpenOptions& options);

/// Records what happens to every file of a folder: readers note the files that they use, the others
/// are counted by kind. Ignores hidden files and the content of subfolders that were not added.
class FileUsage {
 public:
  /// Lists the files of `folder`. Throws filesystem_error.
  explicit FileUsage(const std::filesystem::path& folder);

  /// Adds the files of another folder or of a subfolder. Does nothing if there is no such folder.
  void add_folder(const std::filesystem::path& folder);

  /// Notes that a file was read as `kind`, a plural ("views", "labels"). The file may lie
  /// elsewhere. A second use of a file adds to the count of that kind.
  void use(const std::filesystem::path& file, const std::string& kind);
  void use(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Notes files that were examined but not used, with the reason in `kind`: "depth maps, as no
  /// camera is known". Files that were used stay used.
  void leave_out(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Lists kinds in the order of their first use, then the kinds left out, then the other files.
  /// Names that differ in numbers only form one kind ("depth_#.npy"). If that makes more than 20
  /// kinds, files are grouped by suffix ("*.npy"), or all together.
  [[nodiscard]] std::vector<FileUse> uses() const;

 private:
  std::vector<FileUse> used_;
  std::vector<FileUse> left_out_;
  std::map<std::filesystem::path, bool> files_;  ///< And whether they were noted.
};

}  // namespace episcope::io
