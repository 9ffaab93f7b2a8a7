// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/array_file.h"

#include "engine/core/error.h"
#include "engine/io/arrays/joined_arrays.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

/// What deflate reaches at most.
constexpr std::size_t kDensest = 1032;
/// Light fields and maps are far from it, but for small or empty ones.
constexpr std::size_t kDense = 200;
constexpr std::size_t kSmall = std::size_t{64} << 20;

}  // namespace

std::string last_name(const std::string& name) {
  return name.substr(name.rfind('/') + 1);
}

std::string telling_name(const ArrayEntry& entry) {
  return entry.is_of_views() ? entry.name : last_name(entry.name);
}

std::string content_text(const ArrayEntry& entry) {
  if (!entry.other_kind.empty()) return entry.other_kind;
  return array_shape_text(in_index_order(entry.shape, entry.order));
}

void ArrayFile::join_parts() {
  join_arrays(entries_);
}

std::unique_ptr<ArrayInput> ArrayFile::open(const ArrayEntry& entry) const {
  if (entry.parts.empty()) return open_stored(entry);
  ArrayEntry part = entry;
  part.parts.clear();
  part.shape.erase(part.shape.begin(),
                   part.shape.begin() + static_cast<std::ptrdiff_t>(entry.leading.size()));
  std::vector<std::unique_ptr<ArrayInput>> parts;
  for (const std::string& name : entry.parts) {
    part.name = name;
    parts.push_back(open_stored(part));
  }
  return stacked(path_, entry, std::move(parts));
}

void require_plausible_size(const std::filesystem::path& path, const ArrayShape& shape,
                            NumberType type, std::uint64_t bytes) {
  const std::size_t count = element_count(shape);
  const std::size_t width = byte_size(type);
  const std::size_t allowed = bytes * (count / kSmall * width > 0 ? kDense : kDensest) / width;
  if (count <= allowed) return;
  throw IoError(path, fmt::format("an array of {} {} samples is claimed by {} bytes, which cannot "
                                  "hold it; the file is damaged or made to harm: choose another",
                                  array_shape_text(shape), number_name(type), bytes));
}

}  // namespace episcope::io
