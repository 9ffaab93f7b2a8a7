// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <array>
#include <vector>

namespace episcope::cuda {

/// A convolution of `net`; see NetLayerForm.
struct NetConvolution {
  int inputs = 0;
  int outputs = 0;
  int kernel = 0;      ///< Taps along rows and columns; 0 = none.
  int depth_taps = 1;  ///< Taps along labels; with 3 of them the stride applies there too.
  int stride = 1;
  int dilation = 1;
  bool is_leaky = false;
  std::vector<float> weights;  ///< `[output][input](z)[y][x]`
  std::vector<float> bias;     ///< `[output]`; empty = zeros.
};

/// A tensor of a part of the network: a source, if it has no input; a convolution of another; or
/// another made twice as large. Tensors have the numbers of their steps; −1 = none.
struct NetStep {
  NetConvolution convolution;
  int input = -1;
  int before = -1;  ///< Added before a leaky ReLU, a map at every label;
  int after = -1;   ///< added at the end.
};
/// Steps of a part; the last is its result.
using NetPart = std::vector<NetStep>;

/// The two convolutions of one tap that reduce evidence.
struct NetReduction {
  NetConvolution first, second;
};

/// The network: NetStream's steps.
struct NetParts {
  NetPart volume;  ///< Of evidence and the guide, in this order.
  NetPart selection;
  std::array<NetPart, kNetRefinements> refinements;
  NetReduction selection_reduction;
  std::array<NetReduction, kNetRefinements> refinement_reductions;
};

/// A view, and where its camera stands as seen from that of the reference, in steps of the grid.
struct NetNeighbor {
  ViewIndex view;
  ViewPlace way;
};

/// What is wanted of one view.
struct NetTask {
  const LightField& light_field;
  ViewIndex view;
  std::array<std::vector<NetNeighbor>, kNetSectors> sectors;  ///< What is compared with it.
  /// Labels of the volume, equidistant from `first` to `last`.
  int labels = 0;
  float first = 0, last = 0;
  int rounds = 1;
  bool takes_mean = false;  ///< Of both surfaces of a pixel; see Silhouettes.
  /// A map to improve in one round, in place of a volume.
  const Image<float>* start = nullptr;
};

}  // namespace episcope::cuda
