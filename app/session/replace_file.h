// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace episcope {

/// A hidden folder beside a path, which others cannot read and which goes with this object.
class HiddenFolder {
 public:
  /// Throws IoError that names `beside`.
  explicit HiddenFolder(const std::filesystem::path& beside);
  ~HiddenFolder();
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Whether a file that is there may be replaced.
enum class Overwrite { No, Yes };

/// How a user asks for it: the end of a sentence.
inline constexpr const char* kByOption = "replace it with --overwrite";

[[nodiscard]] bool holds_something(const std::filesystem::path& path);
/// Whether a file is a result, or labels that `label` wrote; false also for a damaged one.
[[nodiscard]] bool is_sound_result(const std::filesystem::path& path);
[[nodiscard]] bool is_sound_labeling(const std::filesystem::path& path);

/// What a result or labels are to be made by.
struct IntendedRun {
  std::string method;       ///< Id of an estimator; empty for labels.
  ParameterSet parameters;  ///< Those that are not listed have their default.
  std::string input;        ///< As typed.
  ParameterSet reading;     ///< Reading options that are set (io::given_options).
  /// Of labels (LabelSources); none while it is not known. A file that has none is of others.
  std::optional<std::uint64_t> sources_hash = {};
  bool is_of_one_view = false;  ///< Of a result, which must not replace one of several views.
};

/// Refuses to replace anything but a result file, or labels that `label` wrote, and one of another
/// method, other parameters, another light field, another reading of it or more views unless that
/// is asked for. Parameters that the file does not know count as their default. Throws IoError,
/// which says `how` to ask for it.
void check_made_output(const std::filesystem::path& path, const IntendedRun& run,
                       Overwrite overwrite, const std::string& how = kByOption);

/// Refuses to write over what a light field is read from: a view, its ground truth, or itself.
/// Throws IoError.
void protect_light_field(const std::filesystem::path& path);

/// Writes a file by `write`, to which it passes the path. Unless `overwrite` says otherwise, a file
/// that is there stays: one of the same bytes as it is, one of others makes this throw IoError,
/// which says `how` to ask for it. For forms that do not tell what they were made by. Throws as
/// `protect_light_field`.
void write_output(const std::filesystem::path& path, Overwrite overwrite,
                  const std::function<void(const std::filesystem::path&)>& write,
                  const std::string& how = kByOption);

}  // namespace episcope
