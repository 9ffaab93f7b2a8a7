// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/array_file.h"
#include "engine/io/models/open_options.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Whether an array can hold light fields along its first axis (of those stored), N×V×U×H×W×C or
/// grey ones N×V×U×H×W, and is none itself.
[[nodiscard]] bool can_be_stack(const ArrayEntry& entry);

/// Light fields of equal right in one file: arrays of one shape that are called alike, in several
/// groups ("a/LF", "b/LF") or with numbers, or one array that is a stack of them; also where its
/// three or four slices could be channels but show different scenes. The option
/// `frame` says which is meant, or `dataset`.
class MultiFieldFile {
 public:
  /// Nothing if the file holds a single light field or none, or several of different shapes, or if
  /// the option `dataset` names something else. Throws InvalidInput for a `dataset` that is not
  /// there.
  [[nodiscard]] static std::optional<MultiFieldFile> find(const ArrayFile& file,
                                                          const OpenOptions& options);

  [[nodiscard]] int count() const { return count_; }
  /// Whether the option `dataset` names one of them, and none is to be chosen by its number.
  [[nodiscard]] bool is_named(const OpenOptions& options) const;
  /// The one that the options mean. Throws InvalidInput if there are not so many.
  [[nodiscard]] int index(const ArrayFile& file, const OpenOptions& options) const;
  /// A file of that light field alone and its maps: of a stack those that are stacks as long, else
  /// all that are not named like another light field. `file` must outlive it.
  [[nodiscard]] std::unique_ptr<ArrayFile> one(const ArrayFile& file, int index) const;
  /// A sentence about which is opened and which others there are.
  [[nodiscard]] std::string text(int index) const;

 private:
  std::vector<std::string> names_;  ///< Of arrays; of a stack its own.
  int count_ = 0;
  bool are_unrelated_channels_ = false;
};

}  // namespace episcope::io
