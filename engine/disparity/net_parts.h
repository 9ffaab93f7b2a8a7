// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/net.h"
#include "engine/disparity/net_layers.h"
#include "engine/disparity/net_weights.h"

#include <string>

namespace episcope {

/// How the layers of `net` follow each other: resources/training/README.md.

/// The volume: logits of labels from their evidence and the guide.
[[nodiscard]] int add_net_volume(NetStream& stream, const NetWeights& weights, int evidence,
                                 int guide);
/// The selection: logits of hypotheses.
[[nodiscard]] int add_net_selection(NetStream& stream, const NetWeights& weights, int input);
/// A refinement: how far disparities move, and whether they are right.
[[nodiscard]] int add_net_refinement(NetStream& stream, const NetWeights& weights, int input,
                                     int number);

/// Names of the layers that reduce evidence begin with this.
inline constexpr const char* kNetSelection = "selection.";
[[nodiscard]] std::string net_refinement(int number);

/// The same network as the device takes it.
[[nodiscard]] cuda::NetParts net_parts(const NetWeights& weights);

}  // namespace episcope
