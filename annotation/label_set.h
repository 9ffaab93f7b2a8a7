// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// The labels that a user paints with: ids 1 … 255, which never change. Removing a label does not
/// renumber the others, and its id is reused only after all others have been used.
class LabelSet {
 public:
  static constexpr int kMaxId = 255;
  /// Bytes of a name: names of all labels together must fit an attribute of an HDF5 file.
  static constexpr std::size_t kMaxNameBytes = 200;

  /// By id.
  [[nodiscard]] const std::vector<LabelInfo>& labels() const { return labels_; }
  [[nodiscard]] bool contains(int id) const { return find(id) != nullptr; }
  /// Null if there is no such label.
  [[nodiscard]] const LabelInfo* find(int id) const;
  /// The highest id that was ever given.
  [[nodiscard]] int last_id() const { return last_id_; }

  /// Adds a label under the next id and returns the id. An empty name becomes "label <id>"; without
  /// a color it gets the first palette color, starting from its id, that no other label has.
  /// Throws InvalidInput for a bad name or if all ids are taken.
  int add(const std::string& name = {}, std::optional<Rgb> color = std::nullopt);
  /// Adds a label of a known id, as read from a file. Throws InvalidInput for an id out of range or
  /// taken, or a bad name.
  void insert(LabelInfo label);
  /// The next three throw InvalidInput for an unknown id or a bad name.
  void rename(int id, const std::string& name);
  void recolor(int id, Rgb color);
  void remove(int id);
  /// Marks ids up to `id` as used.
  void reserve_ids(int id);

  friend bool operator==(const LabelSet&, const LabelSet&) = default;

 private:
  [[nodiscard]] LabelInfo& known(int id);

  std::vector<LabelInfo> labels_;
  int last_id_ = 0;
};

}  // namespace episcope
