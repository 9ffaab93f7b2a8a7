// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Constants that the CPU and the device form of a method share: kernels and device code include
/// this, and it includes nothing. How values were found: tests/accuracy/tuning.md.

/// How a pixel is packed into one word (PackedViews).
inline constexpr int kPackedBits = 10;                      ///< Of one channel.
inline constexpr int kPackedMost = (1 << kPackedBits) - 1;  ///< Its largest value; also its mask.
inline constexpr int kPackedInvalidBit = 3 * kPackedBits;   ///< Set in pixels that are not valid.

/// Views on one side of another that its lines are compared with (LineResiduals).
inline constexpr int kMaxArmViews = 4;
/// A difference of samples that rounding and resampling explain.
inline constexpr float kMinDifference = 1.0F / 255;

/// Confidence by texture (reduce_confidence).
inline constexpr int kTextureRadius = 2;
inline constexpr float kTextureGain = 4;

/// The side of a jump that a ray belongs to (choose_sides).
inline constexpr int kSideNeighbors = 12;
inline constexpr int kSideReach = 6;  ///< px
struct SideOffsets {
  int at[kSideNeighbors][2];  ///< y, x
};
inline constexpr SideOffsets kSideOffsets = {{{-3, -3},
                                              {-3, 0},
                                              {-3, 3},
                                              {0, -3},
                                              {0, 3},
                                              {3, -3},
                                              {3, 0},
                                              {3, 3},
                                              {-kSideReach, 0},
                                              {0, -kSideReach},
                                              {0, kSideReach},
                                              {kSideReach, 0}}};
inline constexpr int kVoteRadius = 2;  ///< Pixels to each side, in x and y, that vote with a pixel.
inline constexpr float kSideCap = 3;   ///< Of residuals, in variances of the noise.
inline constexpr float kSideColorScale = 8.0F / 255;
inline constexpr float kLeastSideStep = 0.2F;
inline constexpr float kFarAdvantage = 0.95F, kNearAdvantage = 0.8F;
inline constexpr float kFarTrust = 0.2F;
inline constexpr float kDoubtfulStep = 0.5F, kDoubtfulShare = 0.25F, kRelief = 1.5F;
inline constexpr float kNoPixel = 100;  ///< As a color: similar to none.

/// Rays that other views see through (replace_occluded).
inline constexpr int kOccludedReach = 4;  ///< Views to each side.
inline constexpr int kOccludedMinViews = 2;
inline constexpr int kOccludedMinShare = 4;  ///< One of so many.
inline constexpr float kOccludedFarther = 0.1F;
inline constexpr float kOccludedTolerance = 0.3F;  ///< Of residuals, in variances of the noise.

/// The structure tensor: taps of its longest filter; neighbors whose disparity differs by so much,
/// squared, count half, since they see another surface; directions that agree within so many px are
/// averaged, also those of two layers.
inline constexpr int kMaxTaps = 13;
inline constexpr float kTensorDisagreement = 0.09F;
inline constexpr float kDirectionAgreement = 0.3F;

/// Two orientations: minors below this mean that the tensor, of trace 1, has rank 1 as far as
/// float32 can tell.
inline constexpr float kMinorsFloor = 1e-5F;

/// One layer or two (LayerScore): how well lines of one disparity fit (raise_by_line_fit),
inline constexpr int kLineFitRadius = 2;
inline constexpr float kLeastFitVariance = 1.0F / (255 * 255);  ///< Below it nothing is seen.
inline constexpr float kMostFitResidual = 3;  ///< No fit on any side: any three colors.
/// how far layers are surfaces (layer_steadiness): s₀ in px, and the mean of 1/(1 + s²/s₀²) over
/// (2·kSteadyRadius + 1)² px from which on they are, and below which they are not,
inline constexpr int kLayerVarianceRadius = 2;
inline constexpr float kLayerSpread = 0.2F;
inline constexpr float kLeastLayerConfidence = 1e-6F;
inline constexpr int kSteadyRadius = 4;
inline constexpr float kSteadyMean = 0.5F, kUnsteadyMean = 0.3F;
/// and the misfits of one and two (single_misfit_share); coherence and confidence that noise alone
/// reaches (measured), and the weight of one layer where nothing else is seen.
inline constexpr int kCoherenceReach = 2;
inline constexpr float kLeastMisfit = 0.03F;
inline constexpr float kNoiseFit = 0.3F;
inline constexpr float kOneLayerWeight = 0.02F;

/// Noise around a pixel (local_noise_variance): variance of a − 2b + c per variance of a sample.
inline constexpr int kNoiseRadius = 2;
inline constexpr float kSecondDifference = 6;
/// What is steady counts up to so much more in `denoise`, fully from this weight on.
inline constexpr float kMostSteadyGain = 10;
inline constexpr float kTrustedWeight = 0.06F;

/// Disparity where no surface is known (surfaces_in_views), and the share of a pixel beyond which
/// a point covers it.
inline constexpr float kNothingNear = -1e9F;
inline constexpr float kSurfaceOverlap = 0.25F;

/// Stereo: mean costs this small are meaningless, a twentieth of the step of 8-bit samples; and the
/// largest window of the guided filter.
inline constexpr float kFlatCost = 2e-4F;
inline constexpr int kMaxGuidedRadius = 8;

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
