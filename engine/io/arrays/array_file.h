// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_input.h"
#include "engine/io/arrays/array_layout.h"

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

}  // namespace episcope::io
