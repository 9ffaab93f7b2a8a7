// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace episcope::io {

/// Samples of views, and their mask of valid pixels.
struct ArraySamples {
  LightField::Samples samples;
  /// From a fourth channel, a weight or alpha: 0 = nothing was seen. Empty if there is none, or no
  /// zero in it.
  ViewStack<std::uint8_t> valid;
  /// Of a fourth channel that is no weight, such as depth, and left out: why it is none.
  std::string left_out{};
};

/// Turns floats that are integers into the narrowest of uint8 and uint16 that holds them all;
/// negative ones, and those above 65535, stay floats.
void narrow(LightField::Samples& samples);

/// Reads a whole light field once, in blocks of at most 64 MB in the order of the file (whole
/// chunks of a compressed one), and brings each into the order of views, `[v][u][y][x][c]`. Types:
/// bytes stay uint8, booleans become 0 and 255, other integers the narrowest of uint8, uint16 and
/// float that holds them all, floats float as stored. Views of a list lie in one row. Throws
/// IoError, also if the views exceed the memory of this machine; Cancelled.
[[nodiscard]] ArraySamples read_samples(const ArrayInput& array, const ArrayLayout& layout,
                                        const Progress& progress);

/// Reads maps `[v][u][y][x]` that have the layout of a light field but no channels.
template <class T>
[[nodiscard]] ViewStack<T> read_map_stack(const ArrayInput& array, const ArrayLayout& layout,
                                          const Progress& progress);

/// A value for each of the axes v, u, y, x, c.
using FiveAxes = std::array<std::size_t, 5>;

/// Samples in memory of any order of axes.
template <class T>
struct PlacedSamples {
  T* data = nullptr;
  FiveAxes stride{};  ///< In samples.
};

template <class T>
[[nodiscard]] FiveAxes strides_of(const ViewStack<T>& stack) {
  const auto channels = static_cast<std::size_t>(stack.channels());
  const std::size_t view = stack.view_size();
  return {view * static_cast<std::size_t>(stack.grid().u), view,
          channels * static_cast<std::size_t>(stack.width()), channels, 1};
}

/// Moves a few samples in the order of views.
template <class From, class To, class Convert>
void move_tile(PlacedSamples<const From> from, PlacedSamples<To> to, const FiveAxes& count,
               const Convert& convert) {
  for (std::size_t v = 0; v < count[0]; ++v) {
    for (std::size_t u = 0; u < count[1]; ++u) {
      for (std::size_t y = 0; y < count[2]; ++y) {
        const From* in = from.data + v * from.stride[0] + u * from.stride[1] + y * from.stride[2];
        To* out = to.data + v * to.stride[0] + u * to.stride[1] + y * to.stride[2];
        for (std::size_t x = 0; x < count[3]; ++x, in += from.stride[3], out += to.stride[3]) {
          for (std::size_t c = 0; c < count[4]; ++c) {
            out[c * to.stride[4]] = convert(in[c * from.stride[4]]);
          }
        }
      }
    }
  }
}

/// Moves samples from one order of axes to another, each by `convert`, in tiles that the cache
/// holds and with all threads. `views_are_together`: whether all views of a pixel lie together on
/// one of the two sides; then a tile has all of them.
template <class From, class To, class Convert>
void move_block(PlacedSamples<const From> from, PlacedSamples<To> to, const FiveAxes& count,
                bool views_are_together, const Convert& convert) {
  constexpr std::size_t kTileRows = 4;
  constexpr std::size_t kTileColumns = 32;
  FiveAxes tile = count;
  tile[2] = std::min(kTileRows, count[2]);
  tile[3] = std::min(kTileColumns, count[3]);
  if (!views_are_together) tile[0] = tile[1] = 1;
  const auto rows = static_cast<int>((count[2] + tile[2] - 1) / tile[2]);
  parallel_for(rows, Progress(), [&](int row) {
    const std::size_t y = static_cast<std::size_t>(row) * tile[2];
    for (std::size_t v = 0; v < count[0]; v += tile[0]) {
      for (std::size_t u = 0; u < count[1]; u += tile[1]) {
        for (std::size_t x = 0; x < count[3]; x += tile[3]) {
          const FiveAxes at{v, u, y, x, 0};
          FiveAxes part = tile;
          PlacedSamples<const From> in = from;
          PlacedSamples<To> out = to;
          for (std::size_t axis = 0; axis < 4; ++axis) {
            part[axis] = std::min(tile[axis], count[axis] - at[axis]);
            in.data += at[axis] * from.stride[axis];
            out.data += at[axis] * to.stride[axis];
          }
          move_tile(in, out, part, convert);
        }
      }
    }
  });
}

}  // namespace episcope::io
