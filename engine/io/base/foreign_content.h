// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// What a file is that no reader reads, by its first bytes, and what to do: a pointer of Git LFS, a
/// web page, an archive of files, a raw picture of a Lytro camera, a HEIC, AVIF or JPEG XL picture,
/// an object of Python, a document. The end of a sentence; empty for other files.
/// A zip archive named .npz is none of these.
[[nodiscard]] std::string foreign_content(const std::filesystem::path& path);

}  // namespace episcope::io
