// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope {

/// A library that a program runs with.
struct LibraryVersion {
  std::string name;     ///< As its authors write it: "OpenCV".
  std::string version;  ///< "4.6.0".
};

namespace io {

/// Libraries that engine/io uses, by name, with the versions loaded. Of libraries that consist of
/// headers, the versions compiled.
[[nodiscard]] std::vector<LibraryVersion> library_versions();

}  // namespace io
}  // namespace episcope
