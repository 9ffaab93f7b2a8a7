// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_drivers.h"
#include "engine/io/base/hdf5_file.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace episcope::io {

/// An axis that datasets share: its places are `first`, `first` + 1, ….
struct Hdf5Axis {
  std::string name;  ///< "v".
  std::string units;
  std::string meaning;  ///< In words.
  int first = 0;
  int count = 0;
};

/// How samples are stored: as one array, or view by view, each shuffled and deflated.
enum class Hdf5Storage { Plain, Deflated };

/// A new HDF5 file at the temporary place of `file`: `close` it, then commit that. Datasets are
/// contiguous and uncompressed unless told otherwise, since speed matters more than size. All
/// members throw IoError that names the target of `file`.
class Hdf5Output {
 public:
  /// `user_bytes`: room for other contents in front: 0, 512 or a power of two above.
  explicit Hdf5Output(const AtomicFile& file, std::size_t user_bytes = 0);
  /// Adds to a complete file that an Hdf5Output made; failures name `target`. If the program ends
  /// before `close` returns, the file is damaged.
  Hdf5Output(const std::filesystem::path& file, const std::filesystem::path& target);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  /// Copies every object and attribute of the root group as stored, except those in `without`.
  void copy_all(const Hdf5Input& from, const std::vector<std::string>& without);
  void add_group(const std::string& name);
  /// Sets how datasets added later are stored; datasets of less than two axes are plain.
  void set_storage(Hdf5Storage storage) { storage_ = storage; }
  /// Adds a dataset with its attributes `axes` ("v,u,y,x") and `units`. If `is_reserved`, allocates
  /// its place in the file, for others to fill (Hdf5Input::place_in_file). T as in
  /// `Hdf5Input::read`.
  template <class T>
  void add_dataset(const std::string& name, const Hdf5Shape& shape, const std::string& axes,
                   const std::string& units, bool is_reserved = false);
  template <class T>
  void write(const std::string& name, const Hdf5Block& block, const T* in);
  [[nodiscard]] bool has(const std::string& dataset) const { return datasets_.contains(dataset); }
  /// Names the axes of all datasets added so far, which have these axes and lie in `group`: a
  /// dataset of the places of each axis, attached as dimension scale, as netCDF has it.
  void add_axes(const std::string& group, const std::vector<Hdf5Axis>& axes);

  void set_number(const std::string& object, const std::string& name, double value);
  void set_integers(const std::string& object, const std::string& name,
                    const std::vector<int>& values);
  void set_numbers(const std::string& object, const std::string& name,
                   const std::vector<double>& values);
  /// UTF-8 of variable length, which other programs take for a text and not for bytes.
  void set_text(const std::string& object, const std::string& name, const std::string& value);
  /// Writes text as MATLAB does: ASCII of fixed length, without a terminator.
  void set_ascii(const std::string& object, const std::string& name, const std::string& value);

  /// Flushes and closes. Throws IoError if anything could not be written.
  void close();

 private:
  void set_attribute(const std::string& object, const std::string& name, std::int64_t type,
                     const Hdf5Shape& shape, const void* value);

  /// Throws if a call of the library failed or a write did not reach the disk.
  void require(bool is_done) const;

  std::filesystem::path path_;
  std::int64_t file_ = -1;
  std::map<std::string, std::int64_t> datasets_;
  Hdf5Storage storage_ = Hdf5Storage::Plain;
  Hdf5WriteLog log_;
};

}  // namespace episcope::io
