// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/beside/beside_views.h"

#include <vector>

namespace episcope::io {

/// Truth that lies beside views, in their stored order.
struct FoundBeside {
  GroundTruth truth;
  std::vector<LabelInfo> label_infos;  ///< Names and colours of its labels, as far as known.
  CameraGrid camera;                   ///< As given, or what disparity and depth say together.
  bool is_sign_assumed = false;        ///< Nothing tells near from far in the disparity.
};

/// Finds (`find_maps`) and reads disparity, depth, labels and masks beside views. Every file that
/// was looked at goes to the account, used or left out, with the reason; units and how they were
/// checked go to the report. What is damaged or does not fit is left out with a warning: views
/// open without it. Throws Cancelled.
[[nodiscard]] FoundBeside read_beside(const BesideViews& views, const BesideNotes& notes,
                                      const Progress& progress);

}  // namespace episcope::io
