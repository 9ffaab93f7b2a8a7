// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/profile.h"

namespace episcope {

Names<Profile> names_of(Profile) {
  return {{Profile::Tuned, "tuned"}, {Profile::Paper, kPaperProfile}};
}

Schema<ProfileChoice> profile_schema() {
  return Schema<ProfileChoice>().choice(
      kProfileKey, &ProfileChoice::profile,
      {"Profile",
       "Defaults of the other parameters: tuned, the best known; paper, the method as published. "
       "Parameters that are given keep their value"});
}

}  // namespace episcope
