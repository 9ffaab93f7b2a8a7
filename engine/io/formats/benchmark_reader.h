// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/reader.h"

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Scenes of the 4D Light Field Benchmark of 2016 [HJKG16]: a folder of images with parameters.cfg,
/// PFM truth, object ids and region masks.
[[nodiscard]] Reader benchmark_reader();

/// A `parameters.cfg` (INI) of the 2016 benchmark: values by key. Keys are unique over the
/// sections, so sections are not told apart; `#` and `;` begin comments, behind a value after a
/// space. Numbers may have a decimal comma.
class ConfigFile {
 public:
  /// Throws IoError.
  explicit ConfigFile(const std::filesystem::path& path);

  [[nodiscard]] std::optional<std::string> text(const std::string& key) const;
  /// None as well where the value is no finite number.
  [[nodiscard]] std::optional<double> number(const std::string& key) const;
  /// Of these keys those whose value is there but is no finite number: "disp_min is 'none'".
  [[nodiscard]] std::vector<std::string> values_without_number(
      std::initializer_list<const char*> keys) const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace episcope::io
