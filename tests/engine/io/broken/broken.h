// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace episcope::test {

/// An input that cannot be read.
struct Broken {
  const char* name;
  /// Creates it in an empty folder and returns what to open.
  std::function<std::filesystem::path(const std::filesystem::path& folder)> make;
  const char* expected;  ///< Words of the sentence by which it is refused.
};

/// Files of the archive form and other HDF5,
[[nodiscard]] std::vector<Broken> broken_archives();
/// folders of images,
[[nodiscard]] std::vector<Broken> broken_folders();
/// arrays of NumPy and MATLAB,
[[nodiscard]] std::vector<Broken> broken_arrays();
/// and places that are no files or folders of any form.
[[nodiscard]] std::vector<Broken> broken_places();

}  // namespace episcope::test
