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

/// The libraries of this room of the engine, by name: versions of those that are loaded, not of
/// those that were compiled against; of libraries that are headers only, these.
[[nodiscard]] std::vector<LibraryVersion> library_versions();

}  // namespace io
}  // namespace episcope
