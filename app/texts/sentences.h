// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace episcope {

/// What sources below `folder` say literally of the step of a job (`progress.step("denoising")`)
/// and of why there is no GPU (`device.why_not = "…"`); sentences composed of data are left out. As
/// in the source: escapes stay as they are. Throws IoError if a source cannot be read.
[[nodiscard]] std::set<std::string> literal_sentences(const std::filesystem::path& folder);

}  // namespace episcope
