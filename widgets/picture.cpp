// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/picture.h"

#include <cassert>
#include <utility>

namespace episcope {

QImage to_qimage(Image<std::uint8_t>&& rgba) {
  if (rgba.empty()) return {};
  assert(rgba.channels() == 4);
  // Freed by the cleanup function when the last QImage over the samples goes.
  auto* owner = new Image<std::uint8_t>(std::move(rgba));
  const auto release = [](void* image) { delete static_cast<Image<std::uint8_t>*>(image); };
  return {
      owner->data(), owner->width(), owner->height(), owner->width() * 4, QImage::Format_RGBA8888,
      release,       owner};
}

}  // namespace episcope
