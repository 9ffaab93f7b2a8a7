// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/picture.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace episcope {
namespace {

// In place, since QImage would copy samples that are not its own.
void premultiply(Image<std::uint8_t>& rgba) {
  std::uint8_t* const end = rgba.row(rgba.height() - 1) + 4 * rgba.width();
  for (std::uint8_t* pixel = rgba.data(); pixel != end; pixel += 4) {
    const QRgb color = qRgba(pixel[0], pixel[1], pixel[2], pixel[3]);
    const QRgb drawn = pixel[3] == 255 ? color : qPremultiply(color);
    std::memcpy(pixel, &drawn, sizeof drawn);
  }
}

}  // namespace

QImage to_qimage(Image<std::uint8_t>&& rgba) {
  if (rgba.empty()) return {};
  assert(rgba.channels() == 4);
  // Freed by the cleanup function when the last QImage over the samples goes.
  auto* owner = new Image<std::uint8_t>(std::move(rgba));
  const auto release = [](void* image) { delete static_cast<Image<std::uint8_t>*>(image); };
  premultiply(*owner);
  return {owner->data(),
          owner->width(),
          owner->height(),
          owner->width() * 4,
          QImage::Format_ARGB32_Premultiplied,
          release,
          owner};
}

Image<std::uint8_t> to_picture(const QImage& picture) {
  if (picture.isNull()) return {};
  const QImage rgba = picture.convertToFormat(QImage::Format_RGBA8888);
  Image<std::uint8_t> copy(rgba.height(), rgba.width(), 4);
  for (int y = 0; y < copy.height(); ++y) {
    std::copy_n(rgba.constScanLine(y), static_cast<std::size_t>(4) * copy.width(), copy.row(y));
  }
  return copy;
}

}  // namespace episcope
