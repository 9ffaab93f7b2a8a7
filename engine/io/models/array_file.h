// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/base/hdf5_file.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

struct ArrayEntry {
  std::string name;
  ArrayShape shape;  ///< As stored; empty if it is no array of numbers.
  NumberType type = NumberType::UInt8;
  IndexOrder order = IndexOrder::C;
  std::string stated_axes{};  ///< As its file says ("v,u,y,x,c"), in the order of indices.
  std::string other_kind{};   ///< "struct", "text": what it is if it is no array of numbers.
  /// Names of the arrays of which this one consists (see ArrayFile), and
  std::vector<std::string> parts{};
  std::string leading{};  ///< what their places mean, "c", "n", "vu", as letters of axes.
  std::string told{};     ///< What its name tells where that is not its last part; else empty.
  std::string warning{};  ///< What is missing among them, and left out; empty for all.

  /// Whether its parts are views, or maps of views, even if some are missing.
  [[nodiscard]] bool is_of_views() const { return !leading.empty() && leading != "c"; }
};

/// Strips structures and groups from a name: "LF" of "s/LF".
[[nodiscard]] std::string last_name(const std::string& name);
/// "9×9×512×512×3", in the order of indices, or what it is if it is no array of numbers.
[[nodiscard]] std::string content_text(const ArrayEntry& entry);

/// The words that tell what the array holds: its last name, or the last names of its parts.
[[nodiscard]] std::string telling_name(const ArrayEntry& entry);

/// A file of one or several arrays with names. Arrays of equal shape whose names are parts of one
/// array are joined, and only the whole is an entry:
/// - r, g and b (also R, red, LF_r, lfr, of one group) as channels;
/// - at least three views ([y][x], with channels last or first), numbered by row and column or in a
///   row: view_00_00, 3/4, cam012. Numbers that are equal in all names do not count.
///
/// The whole is called like its parts, with # for the numbers. Of an incomplete grid it is the
/// largest part without a gap (`part_to_open`), with a warning; without such a part it is an entry
/// of another kind that says what is missing.
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
  /// How a map of this name was estimated, if the file says that it is no truth.
  [[nodiscard]] virtual std::optional<Provenance> estimated(const std::string& /*map*/) const {
    return std::nullopt;
  }

 protected:
  ArrayFile(std::filesystem::path path, std::string form)
      : path_(std::move(path)), form_(std::move(form)) {}
  void add(ArrayEntry entry) { entries_.push_back(std::move(entry)); }
  /// Joins parts; to be called after the last `add`.
  void join_parts();
  /// One that has no parts.
  [[nodiscard]] virtual std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const = 0;

 private:
  std::filesystem::path path_;
  std::string form_;
  std::vector<ArrayEntry> entries_;
};

/// Throws IoError if a file of `bytes` cannot hold samples of this shape, however well compressed.
void require_plausible_size(const std::filesystem::path& path, const ArrayShape& shape,
                            NumberType type, std::uint64_t bytes);

/// Joins the cells of a MATLAB cell array if all are views, or maps, of one size; else nothing.
/// `grid`: its lengths as stored, {columns, rows}.
[[nodiscard]] std::optional<ArrayEntry> joined_cells(const std::string& name,
                                                     const std::vector<ArrayEntry>& cells,
                                                     const ArrayShape& grid);

/// Stacks the opened parts of `entry`, at least one, along its first axes.
[[nodiscard]] std::unique_ptr<ArrayInput> stacked(const std::filesystem::path& path,
                                                  const ArrayEntry& entry,
                                                  std::vector<std::unique_ptr<ArrayInput>> parts);

/// The axes of an array of views that are parts, in the order of `entry.shape`.
[[nodiscard]] std::string joined_axes(const ArrayEntry& entry);

/// Whether an HDF5 file was written by MATLAB 7.3 or in its manner: it begins with MATLAB's block
/// of 512 bytes, or its datasets have the attribute MATLAB_class. Its axes are reversed against
/// MATLAB's.
[[nodiscard]] bool is_matlab_hdf5(const Hdf5Input& file);

/// The datasets of an HDF5 file and of the groups in it (structs of MATLAB): "LF", "s/LF". The
/// attribute `axes` of a dataset states its axes. Datasets that are parts of one are joined.
class Hdf5Arrays : public ArrayFile {
 public:
  static constexpr const char* kPlainForm = "HDF5 file";
  /// Throws IoError.
  explicit Hdf5Arrays(std::shared_ptr<const Hdf5Input> file);

  [[nodiscard]] bool is_matlab() const { return form() != kPlainForm; }
  [[nodiscard]] std::optional<Provenance> estimated(const std::string& map) const override;

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override;

  /// A cell array of MATLAB whose cells are views.
  [[nodiscard]] bool add_cells(const Hdf5Dataset& dataset,
                               const std::vector<Hdf5Dataset>& datasets);

  std::shared_ptr<const Hdf5Input> file_;
};

}  // namespace episcope::io
