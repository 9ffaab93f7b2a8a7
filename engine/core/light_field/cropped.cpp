// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/cropped.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace episcope {
namespace {

template <class T>
ViewStack<T> cropped(const ViewStack<T>& stack, const PixelRect& part, const Progress& progress) {
  ViewStack<T> kept(stack.grid(), part.y1 - part.y0, part.x1 - part.x0, stack.channels());
  const std::size_t row_size = static_cast<std::size_t>(kept.width()) * kept.channels();
  parallel_for(kept.grid().count(), progress, [&](int i) {
    const auto from = stack.view(stack.view_at(i));
    const auto to = kept.view(kept.view_at(i));
    for (int y = 0; y < kept.height(); ++y) {
      const T* row = from.row(part.y0 + y) + static_cast<std::size_t>(part.x0) * kept.channels();
      std::copy_n(row, row_size, to.row(y));
    }
  });
  return kept;
}

}  // namespace

LightField cropped(const LightField& lf, const PixelRect& part, const Progress& progress) {
  assert(!part.empty() && part.y0 >= 0 && part.x0 >= 0 && part.y1 <= lf.height() &&
         part.x1 <= lf.width());
  LightFieldInfo info = lf.info();
  if (info.camera.pinhole) {
    info.camera.pinhole->center_y -= part.y0;
    info.camera.pinhole->center_x -= part.x0;
  }
  auto samples = std::visit(
      [&](const auto& stack) -> LightField::Samples {
        return cropped(stack, part, progress.part(0, 0.9));
      },
      lf.samples());
  ViewStack<std::uint8_t> valid;
  if (!lf.valid().empty()) valid = cropped(lf.valid(), part, progress.part(0.9, 1));
  return {std::move(samples), std::move(info), std::move(valid)};
}

}  // namespace episcope
