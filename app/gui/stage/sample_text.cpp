// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/stage/sample_text.h"

#include <type_traits>
#include <variant>

namespace episcope {

QStringList sample_texts(const LightField& light_field, ViewIndex view, PixelIndex pixel) {
  QStringList texts;
  std::visit(
      [&](const auto& stack) {
        const auto image = stack.view(view);
        for (int c = 0; c < image.channels; ++c) {
          const auto value = image.at(pixel.y, pixel.x, c);
          const int decimals = std::is_floating_point_v<decltype(value + 0)> ? 3 : 0;
          texts << QString::number(static_cast<double>(value), 'f', decimals);
        }
      },
      light_field.samples());
  return texts;
}

}  // namespace episcope
