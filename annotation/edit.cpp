// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/edit.h"

#include <algorithm>
#include <cstring>

namespace episcope {
namespace {

std::size_t bytes_of(const LabelSet& labels) {
  std::size_t bytes = sizeof(LabelSet);
  for (const LabelInfo& label : labels.labels()) bytes += sizeof(LabelInfo) + label.name.size();
  return bytes;
}

/// The first column from `x` on where the labels differ; `end` if there is none. Most of a view is
/// unpainted: whole words are compared at once.
int first_change(const std::uint8_t* before, const std::uint8_t* after, int x, int end) {
  using Word = std::uint64_t;
  constexpr int kWord = sizeof(Word);
  for (; x + kWord <= end; x += kWord) {
    Word old_labels = 0;
    Word labels = 0;
    if (before) std::memcpy(&old_labels, before + x, kWord);
    std::memcpy(&labels, after + x, kWord);
    if (labels != old_labels) break;
  }
  while (x < end && after[x] == (before ? before[x] : 0)) ++x;
  return x;
}

void add_row(const std::uint8_t* before, const std::uint8_t* after, PixelSpan row,
             std::vector<LabelRun>& runs) {
  const auto old_label = [before](int x) { return before ? before[x] : std::uint8_t{0}; };
  for (int x = row.x0; (x = first_change(before, after, x, row.x1)) < row.x1;) {
    int end = x + 1;
    while (end < row.x1 && old_label(end) == old_label(x) && after[end] == after[x]) ++end;
    runs.push_back({static_cast<std::uint16_t>(row.y), static_cast<std::uint16_t>(x),
                    static_cast<std::uint16_t>(end - x), old_label(x), after[x]});
    x = end;
  }
}

}  // namespace

std::size_t Edit::byte_size() const {
  std::size_t bytes = sizeof(Edit);
  for (const ViewEdit& edit : views)
    bytes += sizeof(ViewEdit) + edit.runs.size() * sizeof(LabelRun);
  if (labels) bytes += bytes_of(labels->before) + bytes_of(labels->after);
  return bytes;
}

ViewEdit difference(ViewIndex view, ImageView<const std::uint8_t> before,
                    ImageView<const std::uint8_t> after, const PixelRect& rect) {
  ViewEdit edit{view, {}, {}};
  for (int y = rect.y0; y < rect.y1; ++y) {
    add_row(before.empty() ? nullptr : before.row(y), after.row(y), {y, rect.x0, rect.x1},
            edit.runs);
  }
  edit.runs.shrink_to_fit();
  for (const LabelRun& run : edit.runs) {
    edit.rect.include(PixelRect{run.y, run.x, run.y + 1, run.x + run.length});
  }
  return edit;
}

void put_labels(const ViewEdit& edit, EditSide side, ScribbleLayer& layer) {
  const ImageView<std::uint8_t> image = layer.writable_view(edit.view);
  for (const LabelRun& run : edit.runs) {
    std::fill_n(image.row(run.y) + run.x, run.length,
                side == EditSide::After ? run.after : run.before);
  }
}

}  // namespace episcope
