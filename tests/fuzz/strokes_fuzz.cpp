// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
#include "annotation/document.h"
#include "app/session/annotation_journal.h"
#include "tests/fuzz/harness.h"

#include <fstream>
#include <iterator>

namespace episcope::fuzz {
namespace {

constexpr std::size_t kMostRecords = 50;

AnnotationDocument painted() {
  AnnotationDocument document({3, 3}, 6, 8, 1 << 20);
  document.rename_label(document.add_label("sky"), "air");
  document.set_boundary_smoothing(2);
  PendingEdit edit(document, EditKind::Paint);
  edit.paint({1, 1}, covered_pixels({{2, 3}, {3, 5}, 2}, 6, 8), {.label = 1});
  edit.commit();
  document.undo();
  return document;
}

/// A record is its length, two bytes, and so many bytes.
void write_seeds(const std::filesystem::path& folder) {
  std::string bytes;
  for (const io::LogRecord& record : journal_records({}, painted())) {
    bytes += static_cast<char>(record.size() & 255);
    bytes += static_cast<char>(record.size() >> 8);
    bytes.append(record.begin(), record.end());
  }
  write_bytes(folder / "strokes", bytes);
}

/// The records of a file of strokes; its checksums are left out, which no fuzzer gets past.
void read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  std::vector<io::LogRecord> records;
  for (std::size_t at = 0; at + 2 <= bytes.size() && records.size() < kMostRecords;) {
    const std::size_t length = bytes[at] | std::size_t{bytes[at + 1]} << 8;
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at + 2);
    const std::size_t held = std::min(length, bytes.size() - at - 2);
    records.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(held));
    at += 2 + held;
  }
  (void)replay(records);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("strokes"); }, read, write_seeds};

}  // namespace episcope::fuzz
