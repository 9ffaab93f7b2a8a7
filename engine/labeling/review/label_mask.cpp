// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/review/label_mask.h"

#include <algorithm>

namespace episcope {

Image<std::uint8_t> label_mask(ImageView<const std::int32_t> labels, std::int32_t label,
                               MaskValues values) {
  Image<std::uint8_t> mask(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    const std::int32_t* row = labels.row(y);
    std::transform(row, row + labels.width, mask.row(y), [=](std::int32_t each) {
      return each == label ? values.of_label : values.of_others;
    });
  }
  return mask;
}

}  // namespace episcope
