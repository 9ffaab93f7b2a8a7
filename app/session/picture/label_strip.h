// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/segmentation.h"
#include "app/session/picture/picture.h"
#include "engine/core/light_field/epi.h"

namespace episcope {

/// An EPI through an object, with its labels.
struct LabelEpi {
  int line = 0;       ///< The image row of a horizontal EPI, the column of a vertical one.
  RgbaImage picture;  ///< `[view][place][4]`: views along the direction, pixels of the line.
  Image<std::int32_t> labels;  ///< `[view][place]`.
};

/// EPIs through a label, one below the other: the boundaries of its labels are straight lines where
/// they agree along the rays.
struct LabelStrip {
  EpiDirection direction = EpiDirection::Horizontal;
  int first_place = 0;  ///< The pixel of the line at place 0 of all EPIs.
  std::vector<LabelEpi> epis;
};

/// Which strip: `count` EPIs at most, evenly over the lines on which `label` is seen in `view`, as
/// far as the label reaches in all views and `margin_px` beyond.
struct LabelStripChoice {
  std::int32_t label = 0;
  ViewIndex view;
  EpiDirection direction = EpiDirection::Horizontal;
  int count = 10;
  int margin_px = 12;
};

/// Makes it; without EPIs if the label is not seen in the view. Precondition: the labeling covers
/// all views of the light field. Throws Cancelled.
[[nodiscard]] LabelStrip label_strip(const LightField& light_field, const Labeling& labeling,
                                     const LabelFinish& finish, const LabelStripChoice& choice,
                                     const Progress& progress);

}  // namespace episcope
