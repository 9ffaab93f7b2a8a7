// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/hdf5_file.h"

#include <hdf5.h>

#include <sys/stat.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// For the sources that speak to the HDF5 library only.
namespace episcope::io {

/// Holds the lock of the library for the whole process; it may be held several times by a thread.
class Hdf5Lock {
 public:
  Hdf5Lock() : lock_(mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

 private:
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex the_mutex;
    return the_mutex;
  }
  std::scoped_lock<std::recursive_mutex> lock_;
};

/// Closes an object of the library at the end of its scope.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }
  [[nodiscard]] bool ok() const { return id_ >= 0; }
  [[nodiscard]] hid_t release() { return std::exchange(id_, -1); }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// The type of the library for numbers of type T in memory.
template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return H5T_NATIVE_UINT16;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
}

/// Selects the block; false if the dataset has another rank or no such place.
inline bool select_block(hid_t space, const Hdf5Block& block) {
  const std::vector<hsize_t> start(block.start.begin(), block.start.end());
  const std::vector<hsize_t> count(block.count.begin(), block.count.end());
  if (static_cast<int>(start.size()) != H5Sget_simple_extent_ndims(space)) return false;
  return start.empty() || H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr,
                                              count.data(), nullptr) >= 0;
}

/// Of the rank of the block: HDF5 walks through selections of different ranks element by element.
inline hid_t memory_space(const Hdf5Block& block) {
  const std::vector<hsize_t> count(block.count.begin(), block.count.end());
  return count.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr);
}

/// One opening of an HDF5 file, shared by all inputs of the file while one of them exists, since
/// one reader after the other looks at it. Callers hold the lock of the library.
class Hdf5OpenFile {
 public:
  /// Returns the existing opening unless the file has changed since, else a new one. Throws IoError
  /// that tells a missing file, another kind of file and a damaged one apart.
  [[nodiscard]] static std::shared_ptr<Hdf5OpenFile> of(const std::filesystem::path& path);

  explicit Hdf5OpenFile(const std::filesystem::path& path);
  ~Hdf5OpenFile();
  Hdf5OpenFile(const Hdf5OpenFile&) = delete;
  Hdf5OpenFile& operator=(const Hdf5OpenFile&) = delete;

  [[nodiscard]] hid_t id() const { return id_; }
  /// As `list_datasets`; `root` is the group of that name, or the file. Listed once.
  [[nodiscard]] const std::vector<Hdf5Dataset>& datasets(const std::string& group, hid_t root);

 private:
  [[nodiscard]] bool is_still(const std::filesystem::path& path) const;

  struct stat stamp_ {};
  hid_t id_ = -1;
  std::map<std::string, std::vector<Hdf5Dataset>> listed_;  ///< By group.
};

/// What a file holds; callers hold the lock of the library.

/// Shape, type and blocks of an open dataset.
[[nodiscard]] Hdf5Dataset describe_dataset(hid_t dataset, const std::string& name);

/// Checks of what an HDF5 file claims, before memory is taken for it.

/// Throws IoError if a dataset claims far more samples than its file can hold, compressed or not,
/// or is compressed by a filter that is not at hand. A dataset that was never written counts as
/// samples that are not there, unless it is small.
void require_sound_dataset(const std::filesystem::path& path, const std::string& name,
                           hid_t dataset);

/// Whether a dataset whose samples are in its header claims more than are there: HDF5 1.10 reads
/// beyond them.
[[nodiscard]] bool is_short_in_header(hid_t dataset);

/// Whether numbers of a dataset have no more bytes than any machine's: what the library does with
/// larger ones, which only damage makes, reads beyond its memory.
[[nodiscard]] bool has_sound_numbers(hid_t dataset);

/// Whether the samples of a dataset are in its file, perhaps as other datasets that it is made of:
/// not in raw files that it names, nor in datasets of other files. Such a file could name any file
/// of the user's.
[[nodiscard]] bool holds_own_samples(hid_t dataset);
/// Throws IoError if it does not.
void require_own_samples(const std::filesystem::path& path, const std::string& name, hid_t dataset);

/// Names of the files that a virtual dataset is made of, "." for its own; each once.
[[nodiscard]] std::vector<std::string> virtual_files(hid_t dataset);
/// Whether the datasets of its own file that a virtual one is made of can be read: as the checks
/// below and ChunkLengths. True for other datasets.
[[nodiscard]] bool are_sources_sound(hid_t dataset);

/// Whether `bytes` of an attribute or text are no more than the file holds.
[[nodiscard]] bool fits_file(const std::filesystem::path& path, double bytes);

/// Whether chunks are no larger than the dataset may become, and the first of them, if it is
/// deflated, holds as many samples as chunks do: the library would read beyond it. If they are
/// packed by LZF, their size must be stated with the filter, which makes room for it. Without
/// filters the chunks that are stored must be as long as they are together. True for datasets
/// without chunks. Walks through all chunks once.
[[nodiscard]] bool has_sound_chunks(hid_t dataset);

/// Moves `at`, where a chunk begins, to the next chunk that the block lies in; whether there is
/// one.
[[nodiscard]] bool next_chunk(const Hdf5Block& block, const std::vector<hsize_t>& sides,
                              std::vector<hsize_t>& at);

/// Adds the names in a group, and of the attributes of an object, in alphabetical order; false if a
/// damaged file ends the list. They are listed as stored: in order of names the library makes a
/// table first, which it releases unfilled there.
[[nodiscard]] bool list_links(hid_t group, std::vector<std::string>& names);
[[nodiscard]] bool list_attributes(hid_t object, std::vector<std::string>& names);

/// Finds chunks of a dataset with filters that are stored without them and shorter than chunks are:
/// HDF5 1.10 reads beyond these. Looks at each chunk once.
class ChunkLengths {
 public:
  /// `dataset` stays open as long as this.
  explicit ChunkLengths(hid_t dataset);

  /// Whether no chunk that the block lies in is too short. False also if HDF5 cannot tell.
  [[nodiscard]] bool are_whole(const Hdf5Block& block);

 private:
  [[nodiscard]] bool is_short(const std::vector<hsize_t>& at);

  hid_t dataset_;
  std::vector<hsize_t> sides_;   ///< Of a chunk; empty if there is nothing to look for.
  std::vector<hsize_t> counts_;  ///< Of chunks along each axis.
  hsize_t bytes_ = 0;            ///< Of a chunk.
  unsigned filters_ = 0;         ///< A bit each.
  std::vector<bool> seen_;
  std::vector<std::uint8_t> packed_;
};

}  // namespace episcope::io
