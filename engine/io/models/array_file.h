// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/base/hdf5_file.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Something in a file of arrays.
struct ArrayEntry {
  std::string name;
  ArrayShape shape;  ///< As stored; empty if it is no array of numbers.
  NumberType type = NumberType::UInt8;
  IndexOrder order = IndexOrder::C;
  std::string stated_axes{};  ///< As its file says ("v,u,y,x,c"), in the order of indices.
  std::string other_kind{};   ///< "struct", "text": what it is if it is no array of numbers.
  /// Names of arrays of the file that are this one's parts (`join_arrays`), and
  std::vector<std::string> parts{};
  std::string leading{};  ///< what their places mean, "c", "n", "vu", as letters of axes.
  std::string warning{};  ///< What is missing among them, and left out; empty for all.

  /// Whether its parts are views, or maps of views, even if some are missing.
  [[nodiscard]] bool is_of_views() const { return !leading.empty() && leading != "c"; }
};

/// A name without the structures or groups that the array lies in: "LF" of "s/LF".
[[nodiscard]] std::string last_name(const std::string& name);
/// "9×9×512×512×3", in the order of indices, or what it is if it is no array of numbers.
[[nodiscard]] std::string content_text(const ArrayEntry& entry);

/// The words that tell what the array holds: its last name, or all of those of its parts.
[[nodiscard]] std::string telling_name(const ArrayEntry& entry);

/// A file of one or several arrays with names.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// "NumPy array", "MATLAB 7.3 file".
  [[nodiscard]] const std::string& form() const { return form_; }
  [[nodiscard]] const std::vector<ArrayEntry>& entries() const { return entries_; }
  /// Throws IoError for an array that is damaged, or of another type than numbers.
  [[nodiscard]] std::unique_ptr<ArrayInput> open(const ArrayEntry& entry) const;

 protected:
  ArrayFile(std::filesystem::path path, std::string form)
      : path_(std::move(path)), form_(std::move(form)) {}
  void add(ArrayEntry entry) { entries_.push_back(std::move(entry)); }
  /// To be called when all were added.
  void join_parts();
  /// One that has no parts.
  [[nodiscard]] virtual std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const = 0;

 private:
  std::filesystem::path path_;
  std::string form_;
  std::vector<ArrayEntry> entries_;
};

/// Throws IoError if samples of this shape cannot be in a file of `bytes`, even compressed as
/// densely as can be.
void require_plausible_size(const std::filesystem::path& path, const ArrayShape& shape,
                            NumberType type, std::uint64_t bytes);

/// Puts arrays of equal shape together that are parts of one by their names, and leaves only the
/// whole in `entries`:
/// - r, g and b (also R, red, LF_r, of one group) as channels;
/// - a view each ([y][x], with channels last or first), numbered by row and column, or in a row:
///   view_00_00, 3/4, cam012. Three at least; numbers that are the same in all names say nothing.
///
/// The whole is called like its parts, with # for the numbers. Of a grid that is not full it is the
/// largest part without a gap (`part_to_open`), with a warning; without such a part it is an entry
/// of another kind that says what is missing.
void join_arrays(std::vector<ArrayEntry>& entries);

/// The cells of a cell array of MATLAB as one array, if all are views of one size, or maps; nothing
/// if they are not. `grid`: its lengths as stored, {columns, rows}.
[[nodiscard]] std::optional<ArrayEntry> joined_cells(const std::string& name,
                                                     const std::vector<ArrayEntry>& cells,
                                                     const ArrayShape& grid);

/// The parts of `entry`, opened, as one array along its first axes. They must not be empty.
[[nodiscard]] std::unique_ptr<ArrayInput> stacked(const std::filesystem::path& path,
                                                  const ArrayEntry& entry,
                                                  std::vector<std::unique_ptr<ArrayInput>> parts);

/// The axes of an array of views that are parts, in the order of `entry.shape`.
[[nodiscard]] std::string joined_axes(const ArrayEntry& entry);

/// Whether an HDF5 file was written by MATLAB (version 7.3), or as MATLAB writes: a block of 512
/// bytes that says so precedes it, or its datasets have the attribute MATLAB_class. Then the axes
/// are those of MATLAB reversed.
[[nodiscard]] bool is_matlab_hdf5(const Hdf5Input& file);

/// The datasets of an HDF5 file and of the groups in it (structs of MATLAB): "LF", "s/LF". The
/// attribute `axes` of a dataset is taken for what it states. Datasets that are parts of one, by
/// their names, are one array (`join_arrays`).
class Hdf5Arrays : public ArrayFile {
 public:
  static constexpr const char* kPlainForm = "HDF5 file";
  /// Throws IoError.
  explicit Hdf5Arrays(std::shared_ptr<const Hdf5Input> file);

  [[nodiscard]] bool is_matlab() const { return form() != kPlainForm; }

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override;

  /// A cell array of MATLAB whose cells are views.
  [[nodiscard]] bool add_cells(const Hdf5Dataset& dataset,
                               const std::vector<Hdf5Dataset>& datasets);

  std::shared_ptr<const Hdf5Input> file_;
};

}  // namespace episcope::io
