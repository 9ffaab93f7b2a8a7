// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/scene.h"

namespace episcope {

const char* companion_name(CompanionKind kind) {
  switch (kind) {
    case CompanionKind::EdgeProbabilities:
      return "edge weights";
    case CompanionKind::ImageProbabilities:
      return "probabilities (image)";
    case CompanionKind::DepthProbabilities:
      return "probabilities (depth)";
    case CompanionKind::TrueDepthProbabilities:
      return "probabilities (true depth)";
  }
  return "";
}

}  // namespace episcope
