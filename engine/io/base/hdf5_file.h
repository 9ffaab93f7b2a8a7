// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/io/base/array_input.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Reading HDF5. Every call holds one lock for the whole process, since the library as packaged is
/// not thread-safe; the library's own error output is disabled.

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

class ChunkLengths;
class DeflatedChunks;
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
    std::shared_ptr<DeflatedChunks> deflated;
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

}  // namespace episcope::io
