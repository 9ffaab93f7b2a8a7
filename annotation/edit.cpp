// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/edit.h"

#include "annotation/document.h"
#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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

namespace {

constexpr auto kMaxPlace = std::uint64_t{ScribbleLayer::kMaxExtent};
constexpr std::uint8_t kHasLabels = 1;
constexpr std::uint8_t kHasSmoothing = 2;
constexpr auto kMaxView = std::uint64_t{std::numeric_limits<int>::max()};

void write_labels(const LabelSet& labels, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(labels.last_id()));
  out.number(labels.labels().size());
  for (const LabelInfo& label : labels.labels()) {
    out.number(static_cast<std::uint64_t>(label.id));
    out.text(label.name);
    for (const std::uint8_t channel : label.color) out.byte(channel);
  }
}

LabelSet read_labels(ByteReader& in) {
  LabelSet labels;
  labels.reserve_ids(static_cast<int>(in.number(LabelSet::kMaxId)));
  for (auto left = in.number(LabelSet::kMaxId); left > 0; --left) {
    LabelInfo label;
    label.id = static_cast<int>(in.number(LabelSet::kMaxId));
    label.name = in.text();
    for (std::uint8_t& channel : label.color) channel = in.byte();
    labels.insert(std::move(label));
  }
  return labels;
}

void write_view(const ViewEdit& edit, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(edit.view.v));
  out.number(static_cast<std::uint64_t>(edit.view.u));
  out.number(edit.runs.size());
  int y = 0;
  for (const LabelRun& run : edit.runs) {
    out.number(static_cast<std::uint64_t>(run.y - y));
    out.number(run.x);
    out.number(run.length);
    out.byte(run.before);
    out.byte(run.after);
    y = run.y;
  }
}

ViewEdit read_view(ByteReader& in) {
  ViewEdit edit;
  edit.view.v = static_cast<int>(in.number(kMaxView));
  edit.view.u = static_cast<int>(in.number(kMaxView));
  std::uint64_t y = 0;
  for (auto left = in.number(in.rest()); left > 0; --left) {
    y += in.number(kMaxPlace - y);
    LabelRun run;
    run.y = static_cast<std::uint16_t>(y);
    run.x = static_cast<std::uint16_t>(in.number(kMaxPlace));
    run.length = static_cast<std::uint16_t>(in.number(kMaxPlace));
    run.before = in.byte();
    run.after = in.byte();
    edit.rect.include(PixelRect{run.y, run.x, run.y + 1, run.x + run.length});
    edit.runs.push_back(run);
  }
  return edit;
}

// In hundredths of a pixel.
void write_smoothing(double smoothing_px, ByteWriter& out) {
  out.number(static_cast<std::uint64_t>(std::lround(smoothing_px * 100)));
}

double read_smoothing(ByteReader& in) {
  constexpr auto kMost = static_cast<std::uint64_t>(AnnotationDocument::kMaxSmoothing_px * 100);
  return static_cast<double>(in.number(kMost)) / 100;
}

}  // namespace

void write_edit(const Edit& edit, ByteWriter& out) {
  out.byte(static_cast<std::uint8_t>(edit.kind));
  out.number(edit.views.size());
  for (const ViewEdit& view : edit.views) write_view(view, out);
  out.byte(static_cast<std::uint8_t>((edit.labels ? kHasLabels : 0) |
                                     (edit.smoothing ? kHasSmoothing : 0)));
  if (edit.labels) {
    write_labels(edit.labels->before, out);
    write_labels(edit.labels->after, out);
  }
  if (edit.smoothing) {
    write_smoothing(edit.smoothing->before, out);
    write_smoothing(edit.smoothing->after, out);
  }
}

Edit read_edit(ByteReader& in) {
  Edit edit;
  const std::uint8_t kind = in.byte();
  if (kind > static_cast<std::uint8_t>(kLastEditKind)) {
    throw InvalidInput(fmt::format("there is no edit of kind {}", kind));
  }
  edit.kind = static_cast<EditKind>(kind);
  for (auto left = in.number(in.rest()); left > 0; --left) edit.views.push_back(read_view(in));
  const std::uint8_t parts = in.byte();
  if ((parts & kHasLabels) != 0) {
    LabelSet before = read_labels(in);
    edit.labels = LabelSetEdit{std::move(before), read_labels(in)};
  }
  if ((parts & kHasSmoothing) != 0) {
    const double before = read_smoothing(in);
    edit.smoothing = SmoothingEdit{before, read_smoothing(in)};
  }
  return edit;
}

namespace {

constexpr std::uint8_t kMore = 0x80;
constexpr int kGroup = 7;

[[noreturn]] void refuse() {
  throw InvalidInput("the recorded edits are truncated or damaged");
}

}  // namespace

void ByteWriter::number(std::uint64_t value) {
  for (; value >= kMore; value >>= kGroup) byte(static_cast<std::uint8_t>(value | kMore));
  byte(static_cast<std::uint8_t>(value));
}

void ByteWriter::text(const std::string& value) {
  number(value.size());
  bytes_.insert(bytes_.end(), value.begin(), value.end());
}

std::uint8_t ByteReader::byte() {
  if (rest_.empty()) refuse();
  const std::uint8_t value = rest_.front();
  rest_ = rest_.subspan(1);
  return value;
}

std::uint64_t ByteReader::number(std::uint64_t max) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += kGroup) {
    const std::uint8_t part = byte();
    value |= static_cast<std::uint64_t>(part & (kMore - 1)) << shift;
    if (part >= kMore) continue;
    if (value > max) refuse();
    return value;
  }
  refuse();
}

std::string ByteReader::text() {
  const auto size = static_cast<std::size_t>(number(rest_.size()));
  if (size > rest_.size()) refuse();
  std::string value(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
  rest_ = rest_.subspan(size);
  return value;
}

}  // namespace episcope
