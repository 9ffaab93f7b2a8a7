// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// Labels at most; rows of them are padded to a multiple of kMessageLanes.
inline constexpr int kMostMessageLabels = 512;
inline constexpr int kMessageLanes = 16;

/// The message of one edge, and what its ends pay for differing labels.
struct MessageEdge {
  float* message = nullptr;  ///< Of the other end on entry; of this pixel when it was passed on.
  float weight = 0;
};

/// A pixel with what is known around it. Messages are null beyond the border.
struct MessagePixel {
  const float* costs = nullptr;   ///< Of its labels.
  const float* received[4] = {};  ///< All messages to it.
  MessageEdge passed[2] = {};     ///< Edges to where it passes messages; two of `received`.
  int labels = 0;                 ///< Padded.
  float slope = 0;                ///< Cost of one label of difference at weight 1.
  float most = 0;                 ///< Of any difference.
  float share = 0.5F;             ///< Of its costs that goes along each chain through it.
};

struct MessageKernel {
  /// Passes both messages on. Returns what the bound of the energy gains.
  float (*pass)(const MessagePixel&);
  /// The best label given the labels of up to two neighbors (−1 = none) behind edges of `weights`,
  /// and the messages that `received` holds.
  int (*choose)(const MessagePixel&, const int neighbours[2], const float weights[2]);
};

EPISCOPE_DECLARE_KERNEL(extern const MessageKernel kMessageKernel);

}  // namespace episcope
