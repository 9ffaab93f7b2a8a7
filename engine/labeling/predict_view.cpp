// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_view.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

/// Rows of probabilities `[x][label]` into bytes `[label][x]`.
void store_row(const float* row, int pitch, VolumeView<std::uint8_t> map, int y) {
  for (int l = 0; l < map.layers; ++l) {
    std::uint8_t* out = map.row(y, l);
    for (int x = 0; x < map.width; ++x) {
      const float scaled = row[static_cast<std::ptrdiff_t>(x) * pitch + l] * 255.0F + 0.5F;
      out[x] = static_cast<std::uint8_t>(std::min(scaled, 255.0F));
    }
  }
}

/// Certainty on the painted pixels of a row.
void keep_strokes(const std::int32_t* strokes, int width, int pitch, float* row) {
  for (int x = 0; x < width; ++x) {
    if (strokes[x] == 0) continue;
    float* p = row + static_cast<std::ptrdiff_t>(x) * pitch;
    std::fill_n(p, pitch, 0.F);
    p[strokes[x] - 1] = 1;
  }
}

}  // namespace

ProbabilityMap predict_view(const PixelVotes& votes, const StrokeEvidence& evidence,
                            const Progress& progress) {
  ProbabilityMap map(votes.height(), votes.label_count(), votes.width());
  const int pitch = votes.pitch();
  constexpr int kRows = 8;
  parallel_for_workers((votes.height() + kRows - 1) / kRows, progress, [&] {
    return [&, row = std::vector<float>(static_cast<std::size_t>(votes.row_size()))](
               int item) mutable {
      const int end = std::min(votes.height(), (item + 1) * kRows);
      for (int y = item * kRows; y < end; ++y) {
        std::copy_n(votes.row(y), row.size(), row.data());
        if (evidence.surfaces != nullptr) evidence.surfaces->weigh_row(y, row.data());
        evidence.distances.weigh_row(y, evidence.nearness, row.data());
        if (!evidence.painted.empty()) {
          keep_strokes(evidence.painted.row(y), votes.width(), pitch, row.data());
        }
        store_row(row.data(), pitch, map.view(), y);
      }
    };
  });
  return map;
}

}  // namespace episcope
