// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

#include <string>

namespace episcope::io {

/// Turns samples of an array whose name says that they are Y, Cb, Cr (ITU-R BT.601, as data sets
/// for super-resolution store them) into red, green and blue, and says so in a warning. With Y in
/// 16 … 235 of 255 throughout the range is that of video, as MATLAB's rgb2ycbcr writes it, else the
/// full one, as in JPEG. Linear in the samples.
void decode_luma_chroma(const std::string& name, LightField::Samples& samples,
                        ConventionReport& report);

}  // namespace episcope::io
