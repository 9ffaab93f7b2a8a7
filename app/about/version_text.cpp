// SPDX-License-Identifier: BSD-3-Clause
#include "app/about/version_text.h"

#include "engine/core/version.h"
#include "engine/cuda/device.h"

#include <fmt/format.h>

namespace episcope {

std::string version_text(const std::string& program, const std::vector<LibraryVersion>& others) {
  std::string text = fmt::format("{} {}\ncommit {}\n", program, kVersion, kCommit);
  std::vector<LibraryVersion> libraries = io::library_versions();
  libraries.insert(libraries.end(), others.begin(), others.end());
  const std::string cuda = cuda_runtime_version();
  if (!cuda.empty()) libraries.push_back({"CUDA", cuda});
  for (const auto& [name, version] : libraries) text += fmt::format("{} {}\n", name, version);
  return text;
}

}  // namespace episcope
