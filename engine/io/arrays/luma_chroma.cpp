// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/luma_chroma.h"

#include "engine/core/text/suffix.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <variant>

namespace episcope::io {
namespace {

constexpr double kVideoBlack = 16.0 / 255;
constexpr double kVideoWhite = 235.0 / 255;
constexpr double kVideoChroma = 224.0 / 255;
constexpr double kTolerance = 0.5 / 255;

template <class T>
constexpr double kFull = std::is_floating_point_v<T> ? 1.0 : double(std::numeric_limits<T>::max());

template <class T>
bool has_video_range(const ViewStack<T>& stack) {
  for (std::size_t i = 0; i < stack.size(); i += 3) {
    const double luma = static_cast<double>(stack.data()[i]) / kFull<T>;
    if (luma < kVideoBlack - kTolerance || luma > kVideoWhite + kTolerance) return false;
  }
  return true;
}

template <class T>
void decode(ViewStack<T>& stack, bool is_video) {
  constexpr double kMiddle = 128.0 / 255;
  const auto stored = [](double value) {
    const double whole = kFull<T> * std::clamp(value, 0.0, 1.0);
    return static_cast<T>(std::is_floating_point_v<T> ? whole : whole + 0.5);
  };
  for (std::size_t i = 0; i < stack.size(); i += 3) {
    T* pixel = stack.data() + i;
    double luma = static_cast<double>(pixel[0]) / kFull<T>;
    double blue = static_cast<double>(pixel[1]) / kFull<T> - kMiddle;
    double red = static_cast<double>(pixel[2]) / kFull<T> - kMiddle;
    if (is_video) {
      luma = (luma - kVideoBlack) / (kVideoWhite - kVideoBlack);
      blue /= kVideoChroma;
      red /= kVideoChroma;
    }
    pixel[0] = stored(luma + 1.402 * red);
    pixel[1] = stored(luma - 0.344136 * blue - 0.714136 * red);
    pixel[2] = stored(luma + 1.772 * blue);
  }
}

}  // namespace

void decode_luma_chroma(const std::string& name, LightField::Samples& samples,
                        ConventionReport& report) {
  if (lower_case(name).find("ycbcr") == std::string::npos) return;
  std::visit(
      [&](auto& stack) {
        if (stack.channels() != 3 || stack.kind() == LargeKind::File) return;
        const bool is_video = has_video_range(stack);
        decode(stack, is_video);
        report.warnings.push_back(
            "By its name " + name + " holds Y, Cb and Cr: they were taken as those of " +
            (is_video ? "video (16 … 235)" : "the full range") + " and turned into colours.");
      },
      samples);
}

}  // namespace episcope::io
