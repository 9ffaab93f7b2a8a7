// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate/find_charuco.h"
#include "engine/core/error.h"

namespace episcope::capture {
namespace {

constexpr const char* kAdvice =
    "ChArUco boards need OpenCV's ArUco module, which this build lacks; install "
    "libopencv-contrib-dev and build again, or use a chessboard";

}  // namespace

FoundPattern find_charuco(ImageView<const std::uint8_t>, const Pattern&) {
  throw Unavailable(kAdvice);
}

Image<std::uint8_t> draw_charuco(const Pattern&, int) {
  throw Unavailable(kAdvice);
}

}  // namespace episcope::capture
