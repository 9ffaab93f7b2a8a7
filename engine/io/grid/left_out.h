// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Warns where several images that were left out look like views: their names hold no word for
/// something else (label, depth, …), and those looked at, a few, have size, channels and sample
/// type of the views.
void warn_of_left_out(const std::vector<std::filesystem::path>& left_out,
                      const LightField::Samples& samples, ConventionReport& report);

/// Without those whose names differ from that of a view in numbers only: a pattern that states one
/// of them leaves the others out on purpose.
[[nodiscard]] std::vector<std::filesystem::path> without_other_numbers(
    std::vector<std::filesystem::path> left_out, const std::filesystem::path& view);

}  // namespace episcope::io
