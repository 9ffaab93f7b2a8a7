// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/write.h"

#include <functional>
#include <string>
#include <vector>

namespace episcope::test {

/// A scene to send through files.
struct RoundTripScene {
  const char* name;
  std::function<Scene()> make;
};

/// Scenes of every sample type, of square grids, others and lines, each with some kinds of truth,
/// labels, masks and camera.
[[nodiscard]] std::vector<RoundTripScene> round_trip_scenes();

/// What of a scene comes back from a file: all that each of these forms holds.
[[nodiscard]] io::FormContents common_contents(const io::FormContents& a,
                                               const io::FormContents& b);

/// How what was read differs from what of a scene the form holds; empty if it does not. Samples,
/// labels, masks and disparity are compared bit by bit, disparity that was held as depth within
/// 1e-6 px. What the form does not hold must be absent.
[[nodiscard]] std::string difference(const Scene& scene, const io::FormContents& holds,
                                     const Scene& read);

}  // namespace episcope::test
