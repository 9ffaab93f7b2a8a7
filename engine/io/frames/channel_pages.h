// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

namespace episcope::io {

/// Puts 3N grey pictures, 1×3N, together to N coloured ones if each three of them are the channels
/// of one, one after the other, as ImageJ stores colours of more than 8 bits, or each third of the
/// pages is a channel: then views move, and channels do not.
/// Returns whether it did.
bool join_channel_pages(LightField::Samples& samples);

}  // namespace episcope::io
