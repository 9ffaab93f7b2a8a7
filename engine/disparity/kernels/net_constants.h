// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Constants of the network `net` that its forms for the CPU and the device share: kernels and
/// device code include this, and it includes nothing. What they mean: resources/training/README.md.

/// Evidence at a pixel: of each of 8 sectors of views how unlike their colors are, then how unlike
/// their differences of grey: kNetScale (ln(mean + kNetFloor) + kNetAdd), or kNetNoViews.
inline constexpr int kNetSectors = 8;
inline constexpr int kNetEvidence = 2 * kNetSectors;
inline constexpr float kNetFloor = 0.003F, kNetAdd = 4.2F, kNetScale = 0.8F, kNetNoViews = 1.5F;

/// Channels of the guide: colors less kNetGrey, differences times kNetContrast.
inline constexpr int kNetGuide = 5;
inline constexpr float kNetGrey = 0.4F, kNetContrast = 4;

/// The leaky ReLU's slope below 0.
inline constexpr float kNetLeak = 0.1F;

/// Labels on either side that a mode is made of, and how far the second mode is at least.
inline constexpr int kNetPeak = 2;
inline constexpr int kNetModesApart = 3;

/// Selection: hypotheses so near count as one; a second one is so far at least. Shares of no
/// hypothesis near the best count as kNetLeastShare.
inline constexpr int kNetHypotheses = 8;
inline constexpr float kNetSame = 0.1F, kNetOther = 0.3F;
inline constexpr float kNetLeastShare = 1e-9F;

/// Numbers that evidence of one disparity is reduced to, and inputs beside it: log-probabilities
/// from kNetLeastLog on, divided by kNetLogScale; distances (squash) in kNetSquashUnit px.
inline constexpr int kNetReduced = 8;
inline constexpr float kNetLeastLog = -12, kNetLogScale = 4;
inline constexpr float kNetSquash = 0.4F, kNetSquashUnit = 0.05F;
inline constexpr int kNetSelectionInputs = kNetHypotheses * (kNetReduced + 2) + kNetGuide;

/// Refinements: their steps in px; offsets of evidence in steps, the first 0, from which the others
/// are subtracted and multiplied by kNetOffsetGain; how many steps they move at most.
inline constexpr int kNetRefinements = 2;
inline constexpr float kNetSteps[kNetRefinements] = {0.25F, 0.06F};
inline constexpr int kNetOffsets = 5;
inline constexpr float kNetOffset[kNetOffsets] = {0, -1, -0.5F, 0.5F, 1};
inline constexpr float kNetOffsetGain = 4;
inline constexpr float kNetReach = 1.5F;
/// Maximum, minimum and median around a pixel, of kNetWindow² px.
inline constexpr int kNetWindows = 3;
inline constexpr int kNetWindow = 5;
inline constexpr int kNetRefinementInputs = kNetOffsets * kNetReduced + kNetWindows + 1 + kNetGuide;

/// Hypotheses: maxima and minima around the median are of kNetWideWindow² px; the last median is of
/// pixels kNetMedianApart px apart.
inline constexpr int kNetWideWindow = 9;
inline constexpr int kNetMedianApart = 3;

}  // namespace episcope
