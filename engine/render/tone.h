// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <array>
#include <cstdint>
#include <memory>

namespace episcope::render {

/// How samples are brightened for display: what is darker than the black point is black, the rest
/// is stretched to [0, 1], multiplied by 2^`exposure` and raised to 1/`gamma`.
struct Tone {
  double black = 0;     ///< Sample in [0, 1) that is shown as black.
  double exposure = 0;  ///< Photographic stops: 1 doubles the brightness.
  double gamma = 1;     ///< Positive; larger ones lift the shadows.
  friend bool operator==(const Tone&, const Tone&) = default;
  /// Whether samples are shown as they are.
  [[nodiscard]] bool is_plain() const { return *this == Tone(); }
};

inline constexpr Interval kExposureRange{-4, 8};
inline constexpr Interval kGammaRange{0.25, 4};
inline constexpr Interval kBlackRange{0, 0.5};

/// The tone that shows a view well: black and white at its 0.5 % and 99.5 % quantiles, and the
/// middle of what is dark lifted. Samples that show nothing (LightField::valid) do not count. Plain
/// for a view of one brightness. Linear in the pixels of the view.
[[nodiscard]] Tone automatic_tone(const LightField& light_field, ViewIndex view);

/// Whether a view is so dark that little can be seen: most of its samples are below 12 % of white.
[[nodiscard]] bool is_dark(const LightField& light_field, ViewIndex view);

/// A tone as a table from samples to bytes.
class ToneTable {
 public:
  explicit ToneTable(const Tone& tone);

  [[nodiscard]] std::uint8_t operator()(std::uint8_t sample) const { return table_[sample * 257U]; }
  [[nodiscard]] std::uint8_t operator()(std::uint16_t sample) const { return table_[sample]; }
  /// NaN becomes black.
  [[nodiscard]] std::uint8_t operator()(float sample) const {
    const float bounded = sample > 0 ? (sample < 1 ? sample : 1.0F) : 0.0F;
    return table_[static_cast<std::size_t>(bounded * 65535 + 0.5F)];
  }

 private:
  std::array<std::uint8_t, 65536> table_;
};

/// The table of a tone; null if it is plain: samples as they are.
[[nodiscard]] std::shared_ptr<const ToneTable> table_of(const Tone& tone);

}  // namespace episcope::render
