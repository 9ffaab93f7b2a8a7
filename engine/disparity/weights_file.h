// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace episcope {

/// An array of a file that holds several, by its name; the last axis is contiguous.
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<float> values;
};

/// Weights of a network as a file holds them, and the text (JSON) that describes them.
struct NamedArrays {
  std::vector<NamedArray> arrays;
  std::string record;
  std::uint64_t hash = 0;  ///< Fnv1a of the bytes of the file.
};

/// Most numbers that are read, all arrays together.
inline constexpr std::size_t kMostWeights = std::size_t{1} << 25;

/// Reads weights of a network as `numpy.savez` writes them: an `.npz` archive of arrays of bytes
/// with a sign, half or single floats in C order, not compressed, and one, `record`, of the bytes
/// of a JSON object. That form needs no library, so that a build of the estimators alone reads it;
/// io reads all others. Sources: PKWARE APPNOTE 6.3.10, numpy.lib.format. Throws IoError if there
/// is no such file; if it is damaged, truncated or compressed; if it holds arrays of other numbers,
/// two of one name, numbers that are not finite, or more of them than `kMostWeights`; and without a
/// record.
[[nodiscard]] NamedArrays read_named_arrays(const std::filesystem::path& path);

/// The file of this name in share/episcope/weights of the nearest folder above the program or
/// library that this code is part of, else in episcope/weights of the system's folders of data
/// (XDG_DATA_DIRS). Throws Unavailable if none has it.
[[nodiscard]] std::filesystem::path installed_weights(std::string_view name);

}  // namespace episcope
