// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/net.h"
#include "engine/disparity/net_evidence.h"
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

/// What `net` reports where a pixel holds two surfaces: the more probable one, or the mean of both
/// by their shares, which has the smaller squared error.
enum class Silhouettes { Mode, Mean };

struct NetParameters {
  Interval range;  ///< Disparities that are looked for, px per view step.
  Silhouettes silhouettes = Silhouettes::Mode;
  int rounds = 2;              ///< Of the selection.
  NetPlaces places = nullptr;  ///< Where the cameras stand.
};

/// What `net` finds for one view, `[y][x]`.
struct NetMaps {
  Image<float> disparity;
  Image<float> confidence;  ///< Probability that the disparity is right to 0.07 px.
  Image<float> second;      ///< Another disparity that the pixel may have; else nearly the first,
  Image<float> second_probability;  ///< and how probable it is.
};

/// Labels that the volume has for a range: a multiple of 8 from 32 to 64 of steps of up to 0.1 px.
[[nodiscard]] int net_label_count(Interval range);

/// Disparity of one view by the network `net`: a volume of evidence at equidistant disparities that
/// convolutions filter, a network that chooses among eight hypotheses at each pixel, and two that
/// refine the choice. Views should be of one brightness (EvenViews). Tensors are swept row by
/// row, so memory grows with the width; log-probabilities take 4 bytes a pixel and label. Throws
/// InvalidInput for a view outside the grid, a single view, an empty range or no round; Cancelled.
/// With its weights on a device (net_parts) it is computed there, which may throw DeviceFailure.
///
/// Source: resources/training/README.md, which states every layer; its authors are this project's.
[[nodiscard]] NetMaps estimate_net(const LightField& light_field, ViewIndex view,
                                   const NetWeights& weights, const NetParameters& parameters,
                                   const Progress& progress,
                                   const cuda::DeviceNet* device = nullptr);

/// Improves a map from elsewhere by selection and refinement alone: one round, no volume, nothing
/// of `parameters.range`.
[[nodiscard]] NetMaps polish_by_net(const LightField& light_field, ViewIndex view,
                                    const Image<float>& disparity, const NetWeights& weights,
                                    const NetParameters& parameters, const Progress& progress,
                                    const cuda::DeviceNet* device = nullptr);

/// Logits of the labels of the whole volume are computed this many rows at a time.
inline constexpr int kNetBand = 16;

}  // namespace episcope
