// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/edit_encoding.h"

#include "annotation/document.h"
#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
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
