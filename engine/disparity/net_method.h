// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/schema.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/net.h"
#include "engine/disparity/stereo_costs.h"

#include <string>

namespace episcope {

[[nodiscard]] Names<Silhouettes> names_of(Silhouettes);

/// Parameters of the method `net`.
struct NetMethodParameters {
  Silhouettes silhouettes = Silhouettes::Mode;
  int rounds = 2;           ///< Of the selection.
  bool has_corners = true;  ///< For all views: the corners are estimated, too.
  std::string weights{};    ///< A file; empty = those that come with the program.
  Positions positions = Positions::Use;
  IntervalOrAuto range{};
  ViewOrAuto view{};
};

/// The file of the released weights (installed_weights).
inline constexpr const char* kNetWeights = "net.npz";

/// How probable a second disparity is at least.
inline constexpr float kLeastSecond = 0.1F;

/// Disparity by the network `net` (net.h) on views of one brightness. For all views, the first and,
/// with `has_corners`, the corners of the grid are estimated, and carried to the others
/// (run_carried): the first by the whole network, each corner by selection and refinement of what
/// the maps before show there (polish_by_net). The confidence is the probability that a disparity
/// is right to 0.07 px; of carried views, the mean of those that agree. Of one view,
/// Estimate::second holds other disparities that are at least kLeastSecond probable. Weights are
/// read once and kept while their file stays as it is. A range of less than 0.2 px is widened to
/// that. Views are taken where files state their cameras, if they match better there
/// (prepare_stereo). Throws Unavailable without weights, IoError for a file that holds none,
/// InvalidInput for those of another network and as estimate_net, DeviceFailure, Cancelled.
[[nodiscard]] Estimate estimate_by_net(const LightField& light_field,
                                       const NetMethodParameters& parameters, ViewSelection views,
                                       const Progress& progress, Device device = Device::Cpu);

[[nodiscard]] Estimator net_estimator();

}  // namespace episcope
