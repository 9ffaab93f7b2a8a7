// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/invalid_pixels.h"

#include <algorithm>

namespace episcope {
namespace {

// Maps of whole views or of rows from `first_row` on.
template <class T>
void clear(const LightField& light_field, ViewStack<T>& maps, int first_row = 0) {
  if (light_field.valid().empty() || maps.empty()) return;
  for (int i = 0; i < maps.grid().count(); ++i) {
    const ViewIndex view = maps.grid().view_at(i, maps.first());
    const std::uint8_t* const valid = light_field.valid().view(view).row(first_row);
    T* const map = maps.view(view).data;
    for (std::size_t n = 0; n < maps.view_size(); ++n) {
      if (valid[n] == 0) map[n] = 0;
    }
  }
}

void mark(const LightField& light_field, DisparityField& field, int first_row = 0) {
  if (light_field.valid().empty() || field.empty()) return;
  const ViewStack<float>& maps = field.disparity;
  if (field.valid.empty()) {
    field.valid =
        ViewStack<std::uint8_t>(maps.grid(), maps.height(), maps.width(), 1, maps.first());
    std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{1});
  }
  clear(light_field, field.valid, first_row);
}

}  // namespace

void clear_invalid(const LightField& light_field, ViewStack<float>& maps, int first_row) {
  clear(light_field, maps, first_row);
}

void clear_invalid(const LightField& light_field, ViewStack<std::uint8_t>& maps, int first_row) {
  clear(light_field, maps, first_row);
}

void mark_invalid(const LightField& light_field, Estimate& estimate) {
  mark(light_field, estimate.field);
  mark(light_field, estimate.layered.foreground);
  mark(light_field, estimate.layered.background);
  clear(light_field, estimate.layered.layers);
  clear(light_field, estimate.confidence);
}

void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block) {
  mark(light_field, block.field, first_row);
  mark(light_field, block.layered.foreground, first_row);
  mark(light_field, block.layered.background, first_row);
  clear(light_field, block.layered.layers, first_row);
  clear(light_field, block.confidence, first_row);
}

std::size_t count_valid(const LightField& light_field, ViewIndex view) {
  const auto pixels = static_cast<std::size_t>(light_field.height()) * light_field.width();
  if (light_field.valid().empty()) return pixels;
  const std::uint8_t* const valid = light_field.valid().view(view).data;
  return pixels - std::count(valid, valid + pixels, 0);
}

}  // namespace episcope
