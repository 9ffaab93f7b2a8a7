// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::capture {

using ByteView = std::span<const std::uint8_t>;

/// One part of a container.
struct LfpSection {
  bool is_table = false;  ///< JSON that names the other sections, not data.
  std::string reference;  ///< "sha1-" and 40 digits: the hash of the data, and its name.
  std::vector<std::uint8_t> data;

  [[nodiscard]] std::string text() const { return {data.begin(), data.end()}; }
};

/// The container of Lytro cameras (.lfp, .lfr): a signature of 16 bytes, then sections of a header
/// (signature, length as big endian u32, hash as text, 35 zero bytes) and data padded to 16 bytes.
struct LfpContainer {
  std::vector<LfpSection> sections;

  /// The section of this reference; null if there is none.
  [[nodiscard]] const LfpSection* find(const std::string& reference) const;
};

/// Whether the file begins as such a container.
[[nodiscard]] bool is_lfp_container(const std::filesystem::path& path);

/// Reads a whole container. Throws IoError with one sentence for a truncated file, a length beyond
/// its end, data that do not match their hash, and for no such container.
[[nodiscard]] LfpContainer read_lfp(const std::filesystem::path& path);

/// Name of data in a container: "sha1-" and the hash.
[[nodiscard]] std::string lfp_reference(ByteView data);

/// Writes a container of these sections, whose references are computed. Atomic. Throws IoError.
void write_lfp(const std::filesystem::path& path, const LfpContainer& container);

}  // namespace episcope::capture
