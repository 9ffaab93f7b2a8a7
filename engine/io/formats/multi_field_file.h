// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/array_file.h"
#include "engine/io/models/open_options.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Whether an array can hold light fields along its first stored axis, N×V×U×H×W×C or gray ones
/// N×V×U×H×W, and is none itself.
[[nodiscard]] bool can_be_stack(const ArrayEntry& entry);

/// Several light fields of equal rank in one file: arrays of one shape with similar names, in
/// several groups ("a/LF", "b/LF") or with numbers, or one array that is a stack of them. Up to
/// four gray slices of a stack count as channels unless the option `axes` states the axes of a
/// slice. The option `frame` or `dataset` selects one.
class MultiFieldFile {
 public:
  /// Empty if the file holds at most one light field, or several of different shapes, or if the
  /// option `dataset` names something else. Throws InvalidInput for a `dataset` that does not
  /// exist.
  [[nodiscard]] static std::optional<MultiFieldFile> find(const ArrayFile& file,
                                                          const OpenOptions& options);

  [[nodiscard]] int count() const { return count_; }
  /// Whether the option `dataset` names one of them, so that no number is needed.
  [[nodiscard]] bool is_named(const OpenOptions& options) const;
  /// Index of the one that the options select. Throws InvalidInput if there are fewer.
  [[nodiscard]] int index(const ArrayFile& file, const OpenOptions& options) const;
  /// A file with only that light field and its maps. Maps of a stack are stacks of the same length;
  /// otherwise all arrays not named like another light field: by words, or by the number that tells
  /// LF1 from LF2. `file` must outlive it.
  [[nodiscard]] std::unique_ptr<ArrayFile> one(const ArrayFile& file, int index) const;
  /// A sentence about which light field is opened and which others exist.
  [[nodiscard]] std::string text(int index) const;

 private:
  std::vector<std::string> names_;  ///< Of arrays; of a stack its own.
  int count_ = 0;
};

}  // namespace episcope::io
