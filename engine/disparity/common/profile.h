// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"
#include "engine/core/parameter/schema.h"

namespace episcope {

/// Whether a method runs with the settings that are best here, or as published.
enum class Profile { Tuned, Paper };
[[nodiscard]] Names<Profile> names_of(Profile);

/// The key of the parameter, and its value for the method as published.
inline constexpr const char* kProfileKey = "profile";
inline constexpr const char* kPaperProfile = "paper";

/// Chooses defaults of other parameters (Schema::preset): each method says which are those of the
/// paper. What is given beside the profile wins.
struct ProfileChoice {
  Profile profile = Profile::Tuned;
};
[[nodiscard]] Schema<ProfileChoice> profile_schema();

}  // namespace episcope
