// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/replace_file.h"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace episcope::cli {

/// Standard input as a file, for what reads files.
class InputStream {
 public:
  /// If `name` is "-", reads standard input to its end, and `name` becomes the path of a file of
  /// the same bytes, "stdin" with the suffix that their beginning tells: .npy, .npz, .pfm, .h5,
  /// .mat, .tiff, else .csv. Throws IoError; Cancelled once `stop` is requested.
  InputStream(std::string& name, const std::stop_token& stop);
  /// The same for the one of several names. Throws UsageError, too, if more than one is "-".
  InputStream(std::vector<std::string>& names, const std::stop_token& stop);

  [[nodiscard]] bool is(const std::string& path) const { return !file_.empty() && path == file_; }
  /// "-" for that file, another path as it is.
  [[nodiscard]] std::string shown(const std::string& path) const { return is(path) ? "-" : path; }
  /// Throws IoError, naming the forms that can be piped, if what was read can be a map only.
  void require_light_field() const;

 private:
  void read(std::string& name, const std::stop_token& stop);

  std::optional<HiddenFolder> folder_;
  std::string file_;
};

/// Throws IoError if `output` exists, since it does not tell whether it is of what is piped, unless
/// it may be replaced.
void require_no_other_source(const std::filesystem::path& output, Overwrite overwrite);

/// A file that goes to standard output, for what writes files.
class OutputStream {
 public:
  /// If `name` is "-" or, with a form, "pfm:-", it becomes the path of a file that does not exist:
  /// "stdout" with that form, else `suffix`, as suffix. Throws IoError.
  OutputStream(std::string& name, const std::string& suffix);

  [[nodiscard]] bool is_meant() const { return !file_.empty(); }
  /// Writes the file to standard output. Throws IoError.
  void send() const;
  /// Throws UsageError if an answer in JSON is wanted there, too.
  void require_alone(bool is_json) const;

 private:
  std::optional<HiddenFolder> folder_;
  std::string file_;
};

}  // namespace episcope::cli
