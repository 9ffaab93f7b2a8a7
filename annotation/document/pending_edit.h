// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/document.h"

#include <bitset>
#include <cstdint>
#include <map>
#include <optional>

namespace episcope {

/// A set of ids of labels; 0 stands for unpainted pixels.
using LabelIds = std::bitset<LabelSet::kMaxId + 1>;

/// All ids but one.
[[nodiscard]] inline LabelIds all_labels_but(std::uint8_t id) {
  return LabelIds().set().reset(id);
}

/// The label to paint, and which pixels it may change.
struct Ink {
  std::uint8_t label = 0;  ///< 0 erases.
  LabelIds kept{};         ///< Pixels that have one of these stay as they are.
};

/// An edit in progress: what it paints appears in the document at once, and is reverted if the edit
/// is destroyed before `commit`. At most one per document, which must outlive it.
class PendingEdit {
 public:
  /// Throws InvalidInput if another edit is in progress.
  PendingEdit(AnnotationDocument& document, EditKind kind);
  ~PendingEdit();
  PendingEdit(const PendingEdit&) = delete;
  PendingEdit& operator=(const PendingEdit&) = delete;

  /// Paints a region that lies within the view, with a label of the set. Returns the rectangle that
  /// may have changed. Throws InvalidInput for a view outside the grid or an unknown label.
  PixelRect paint(ViewIndex view, const PixelRegion& region, const Ink& ink);
  void set_labels(LabelSet labels);

  /// Ends the edit and adds it to the history as one step, unless it changed nothing. Returns
  /// whether there was a change.
  bool commit();

 private:
  struct Touched {
    Image<std::uint8_t> before;
    PixelRect rect;
  };
  [[nodiscard]] Touched& touch(ViewIndex view);
  void revert();

  AnnotationDocument* document_;  ///< Null once ended.
  EditKind kind_;
  std::map<std::pair<int, int>, Touched> touched_;  ///< By (v, u).
  std::optional<LabelSet> labels_before_;
};

}  // namespace episcope
