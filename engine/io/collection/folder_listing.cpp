// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/collection/folder_listing.h"

#include "engine/core/hash/fnv1a.h"

#include <algorithm>
#include <chrono>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::int64_t nanoseconds(fs::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

void add(Fnv1a& hash, const fs::path& path, std::uintmax_t bytes, std::int64_t time) {
  hash.add(path.filename().string());
  hash.add_word(bytes);
  hash.add_word(static_cast<std::uint64_t>(time));
}

/// Sorts, and takes the fingerprint.
void finish(FolderListing& listing) {
  std::ranges::sort(listing.files, {}, &ListedFile::path);
  std::ranges::sort(listing.folders);
  Fnv1a hash;
  for (const ListedFile& file : listing.files) add(hash, file.path, file.bytes, file.modified_ns);
  for (const fs::path& folder : listing.folders) {
    std::error_code error;
    const auto time = fs::last_write_time(folder, error);
    add(hash, folder, 0, error ? 0 : nanoseconds(time));
  }
  listing.fingerprint = hash.value();
}

void add_file(FolderListing& listing, const fs::directory_entry& entry) {
  std::error_code error;
  const std::uintmax_t bytes = entry.file_size(error);
  if (error) return;  // gone meanwhile
  const auto time = entry.last_write_time(error);
  if (!error) listing.files.push_back({entry.path(), bytes, nanoseconds(time)});
}

}  // namespace

FolderListing list_folder(const fs::path& folder) {
  FolderListing listing{.folder = folder, .files = {}, .folders = {}};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with('.')) continue;
    std::error_code error;
    if (entry.is_directory(error)) {
      listing.folders.push_back(entry.path());
    } else if (entry.is_regular_file(error)) {
      add_file(listing, entry);
    }
  }
  finish(listing);
  return listing;
}

FolderListing list_file(const fs::path& file) {
  FolderListing listing{.folder = file.parent_path(), .files = {}, .folders = {}};
  add_file(listing, fs::directory_entry(file));
  finish(listing);
  return listing;
}

}  // namespace episcope::io
