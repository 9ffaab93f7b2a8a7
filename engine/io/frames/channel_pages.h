// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <optional>

namespace episcope::io {

/// How pages follow each other if the channels of a view are pages, one after the other or a part
/// of the list each.
struct PageOrder {
  int channels = 1;
  /// Views that follow each other before the next channel: 1 if the channels of a view do.
  int views_in_turn = 1;

  /// From 0.
  [[nodiscard]] int page(int view, int channel) const {
    return view % views_in_turn + views_in_turn * (channel + channels * (view / views_in_turn));
  }
};

/// The order of 3N grey pictures, 1×3N, of which each three are the channels of one, as ImageJ
/// stores colours of more than 8 bits, or each third of them is a channel: then views move, and
/// channels do not. Nothing if they do.
[[nodiscard]] std::optional<PageOrder> find_channel_pages(const LightField::Samples& samples);

/// Puts pictures, grey and 1×N, together to coloured ones: two channels become red and green, of
/// more than three the first three are kept.
void join_channel_pages(LightField::Samples& samples, const PageOrder& order);

}  // namespace episcope::io
