// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/named_arrays.h"

#include <filesystem>

namespace episcope::io {

/// Reads weights of a network: an `.npz` archive of arrays of half or single floats and one,
/// `record`, of the bytes of a JSON object. Throws IoError if the archive is damaged or truncated,
/// holds arrays of other numbers, two of one name, numbers that are not finite or more of them than
/// `kMostWeights`, or if the record is missing or no JSON object.
[[nodiscard]] NamedArrays read_named_arrays(const std::filesystem::path& path);

/// Most numbers that are read, all arrays together.
inline constexpr std::size_t kMostWeights = std::size_t{1} << 25;

}  // namespace episcope::io
