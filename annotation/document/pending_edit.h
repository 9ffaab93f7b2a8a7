// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/document.h"

#include <cstdint>
#include <map>
#include <optional>

namespace episcope {

/// What is put on pixels, and on which.
struct Ink {
  std::uint8_t label = 0;  ///< 0 erases.
  /// Only pixels that bear this label are changed; none = all.
  std::optional<std::uint8_t> only_over;
};

/// An edit under way: what it paints is in the document at once, and is taken back if the edit is
/// destroyed before `commit`. At most one for each document, which must outlive it.
class PendingEdit {
 public:
  /// Throws InvalidInput if another edit is under way.
  PendingEdit(AnnotationDocument& document, EditKind kind);
  ~PendingEdit();
  PendingEdit(const PendingEdit&) = delete;
  PendingEdit& operator=(const PendingEdit&) = delete;

  /// Paints a region that lies within the view, with a label of the set. Returns the rectangle that
  /// may have changed. Throws InvalidInput for a view outside the grid or an unknown label.
  PixelRect paint(ViewIndex view, const PixelRegion& region, const Ink& ink);
  void set_labels(LabelSet labels);

  /// Ends the edit and keeps it in the history as one step. One that changed nothing vanishes.
  /// Returns whether there was a change.
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
