// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/collection.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/fuzz/harness.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  io::CollectionCache cache(folder / "cache.json");
  io::FolderRecord record;
  record.entries.push_back({.path = "a/lf.h5", .name = "a", .reader = "archive"});
  record.results.push_back({"a/result.h5", "epi_s", "lf.h5"});
  cache.keep("/a", 1, std::move(record));
  cache.save();
}

/// What was found in folders before.
void read(const std::filesystem::path& file) {
  const io::CollectionCache cache(file);
  (void)cache.find("/a", 1);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("cache.json"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
