// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_drivers.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// The only access to HDF5 (with the write driver beneath it). Every call holds one lock for the
/// whole process, since the library as packaged is not thread-safe; the library's own error output
/// is disabled.

using Hdf5Shape = ArrayShape;

enum class Hdf5Type { UInt8, UInt16, Integer, Float, Other };

struct Hdf5Dataset {
  std::string name;  ///< Path inside the file, without a leading slash.
  Hdf5Shape shape;
  Hdf5Type type = Hdf5Type::Other;  ///< `Integer`: any other width or sign.
  Hdf5Shape chunk{};  ///< Of the blocks that are stored one by one; empty if there are none.
};

/// A block of a dataset: `count[i]` elements from `start[i]` on along each axis.
struct Hdf5Block {
  Hdf5Shape start;
  Hdf5Shape count;
};

/// Part of one view in a dataset whose first axes are v and u.
[[nodiscard]] inline Hdf5Block view_block(const Hdf5Shape& shape, ViewIndex view) {
  Hdf5Block block{Hdf5Shape(shape.size(), 0), shape};
  block.start[0] = static_cast<std::size_t>(view.v);
  block.start[1] = static_cast<std::size_t>(view.u);
  block.count[0] = block.count[1] = 1;
  return block;
}

/// Version of the loaded library: "1.10.8".
[[nodiscard]] std::string hdf5_version();

/// Whether the name of a file ends in .h5 or .hdf5.
[[nodiscard]] bool has_hdf5_name(const std::filesystem::path& path);
/// Whether the file begins with the signature of HDF5; false also if it cannot be read.
[[nodiscard]] bool has_hdf5_signature(const std::filesystem::path& path);

/// An axis that datasets share: its places are `first`, `first` + 1, ….
struct Hdf5Axis {
  std::string name;  ///< "v".
  std::string units;
  std::string meaning;  ///< In words.
  int first = 0;
  int count = 0;
};

class ChunkLengths;
class Hdf5OpenFile;

/// An HDF5 file open for reading, without file locks. All inputs of one file share one opening and
/// one list of its datasets. Objects are named by their path in the file; "/" is the root. HDF5
/// converts element types (clipped, rounded towards zero). Links to other files and samples stored
/// there are refused: `has` and `read` throw IoError.
class Hdf5Input {
 public:
  /// Throws IoError that tells a missing file, another kind of file and a damaged one apart.
  explicit Hdf5Input(const std::filesystem::path& path);
  /// Opens a file with a group in place of the root, for datasets and attributes. `referenced`
  /// still returns names from the root of the file. Throws IoError if there is no such group.
  Hdf5Input(const std::filesystem::path& path, const std::string& group);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Name of the group that stands for the root; empty = the root itself.
  [[nodiscard]] const std::string& group() const { return group_; }
  [[nodiscard]] bool has(const std::string& name) const;
  /// Why a dataset that is there is of no use: a link that leads nowhere or to another file,
  /// without elements, without numbers. Empty if it is not there, or of use.
  [[nodiscard]] std::string fault_of(const std::string& name) const;
  /// As `has`, but false for a dataset with a fault.
  [[nodiscard]] bool has_numbers(const std::string& name) const;
  /// Datasets of the root group and of the groups in it, at most three deep, by name.
  [[nodiscard]] std::vector<Hdf5Dataset> datasets() const;
  /// Throws IoError, naming what the file holds and what to do, if there is no such dataset; also
  /// for a group.
  [[nodiscard]] Hdf5Dataset dataset(const std::string& name,
                                    const std::string& advice = "choose another file") const;

  /// Names of the objects that a dataset of references points at, element by element. Empty if it
  /// holds something else; an element is empty if it points nowhere.
  [[nodiscard]] std::vector<std::string> referenced(const std::string& name) const;

  /// Reads a block as uint8, uint16, int32, float or double. Throws IoError.
  template <class T>
  void read(const std::string& name, const Hdf5Block& block, T* out) const;

  /// Offset in the file of samples that are stored as an array of T in memory: contiguous,
  /// uncompressed, complete, with the type and byte order of this machine. Empty if they are stored
  /// otherwise. T: uint8, int32, uint16 or float. Throws IoError as `dataset`.
  template <class T>
  [[nodiscard]] std::optional<std::uintmax_t> place_in_file(const std::string& name) const;

  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// Reads an attribute of any numeric type, scalar or of length 1, or a text that spells a number.
  /// Empty if there is none.
  [[nodiscard]] std::optional<double> number(const std::string& object,
                                             const std::string& name) const;
  /// All elements of a numeric attribute; empty if there is none.
  [[nodiscard]] std::vector<double> numbers(const std::string& object,
                                            const std::string& name) const;
  [[nodiscard]] std::optional<std::string> text(const std::string& object,
                                                const std::string& name) const;
  /// All elements of an attribute of texts of variable length; empty if there is none.
  [[nodiscard]] std::vector<std::string> texts(const std::string& object,
                                               const std::string& name) const;
  /// Last names of the dimension scales that are attached to the axes of a dataset, one an axis,
  /// empty for an axis without. Empty if there are none.
  [[nodiscard]] std::vector<std::string> scale_names(const std::string& dataset) const;

 private:
  friend class Hdf5Output;  // Copies from here.

  struct Opened {
    std::int64_t id = -1;
    std::shared_ptr<ChunkLengths> chunks;
  };

  [[nodiscard]] const Opened& open_dataset(const std::string& name) const;
  /// Negative if there is none.
  [[nodiscard]] std::int64_t open_attribute(const std::string& object,
                                            const std::string& name) const;

  std::filesystem::path path_;
  std::string group_;
  std::shared_ptr<Hdf5OpenFile> shared_;
  std::int64_t file_ = -1;
  std::int64_t root_ = -1;  ///< The file or a group, by which names are looked up.
  mutable std::map<std::string, Opened> datasets_;  ///< With their chunk caches.
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
  /// How datasets that are added from now on are stored; those of less than two axes are plain.
  void set_storage(Hdf5Storage storage) { storage_ = storage; }
  /// Adds a dataset with its attributes `axes` ("v,u,y,x") and `units`. T as in `Hdf5Input::read`.
  template <class T>
  void add_dataset(const std::string& name, const Hdf5Shape& shape, const std::string& axes,
                   const std::string& units);
  /// Adds a dataset and allocates its place in the file, for others to fill
  /// (Hdf5Input::place_in_file).
  template <class T>
  void reserve_dataset(const std::string& name, const Hdf5Shape& shape, const std::string& axes,
                       const std::string& units);
  template <class T>
  void write(const std::string& name, const Hdf5Block& block, const T* in);
  /// Whether it added a dataset of this name.
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
  template <class T>
  void create_dataset(const std::string& name, const Hdf5Shape& shape, bool is_reserved);
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
