// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/review/label_pieces.h"

#include "engine/labeling/review/label_mask.h"

#include <algorithm>
#include <map>
#include <utility>

namespace episcope {
namespace {

bool reaches_border(const Blob& blob, ImageView<const std::int32_t> labels) {
  return blob.bounds.y0 == 0 || blob.bounds.x0 == 0 || blob.bounds.y1 == labels.height ||
         blob.bounds.x1 == labels.width;
}

std::int32_t most_frequent(const Blob& blob, ImageView<const std::int32_t> labels) {
  std::map<std::int32_t, int> counts;
  for (int y = 0; y < blob.mask.height(); ++y) {
    for (int x = 0; x < blob.mask.width(); ++x) {
      if (blob.mask.at(y, x) != 0) ++counts[labels.at(blob.bounds.y0 + y, blob.bounds.x0 + x)];
    }
  }
  return std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; })->first;
}

}  // namespace

std::vector<LabelPiece> pieces_of(ImageView<const std::int32_t> labels, std::int32_t label) {
  std::vector<LabelPiece> pieces;
  for (Blob& blob : blobs_of(label_mask(labels, label), Neighbours::Sides)) {
    pieces.push_back({PieceKind::Island, label, std::move(blob)});
  }
  if (pieces.empty()) return pieces;
  for (Blob& blob : blobs_of(label_mask(labels, label, {0, 255}), Neighbours::Corners)) {
    if (reaches_border(blob, labels)) continue;
    const std::int32_t inside = most_frequent(blob, labels);
    pieces.push_back({PieceKind::Hole, inside, std::move(blob)});
  }
  const auto is_larger = [](const LabelPiece& a, const LabelPiece& b) {
    return a.blob.pixels > b.blob.pixels;
  };
  std::ranges::stable_sort(pieces, is_larger);
  const auto main = std::ranges::find(pieces, PieceKind::Island, &LabelPiece::kind);
  main->kind = PieceKind::Main;
  std::rotate(pieces.begin(), main, std::next(main));
  return pieces;
}

}  // namespace episcope
