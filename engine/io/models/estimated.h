// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/io/base/hdf5_output.h"

#include <optional>
#include <string>

namespace episcope::io {

/// Attributes of a map of a light field that is no truth but a result: the method, its parameters
/// (a JSON object), the light field it was estimated from, and the version of Episcope.
inline constexpr const char* kEstimatedBy = "estimated_by";
inline constexpr const char* kEstimateParameters = "parameters";
inline constexpr const char* kEstimateSource = "source";
inline constexpr const char* kEstimateVersion = "version";
/// A file in `.npz` archives with these as a JSON object.
inline constexpr const char* kEstimatedFile = "estimated.json";

/// Says that a map is a result.
void write_estimated(Hdf5Output& file, const std::string& map, const Provenance& estimated);
/// How a map was estimated; nothing of one that does not say so.
[[nodiscard]] std::optional<Provenance> estimated_in(const Hdf5Input& file, const std::string& map);
[[nodiscard]] std::string estimated_json(const Provenance& estimated);
[[nodiscard]] std::optional<Provenance> estimated_from_json(const std::string& text);

}  // namespace episcope::io
