// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"

#include <random>

namespace episcope::test {

/// Edits of all kinds, reproducible by seed.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed, bool saves = true) : random_(seed), saves_(saves) {}

  /// A stroke, fill or change of labels; it may turn out to change nothing.
  void make_one(AnnotationDocument& document) {
    const auto& labels = document.labels().labels();
    const int dice = below(20);
    if (labels.empty() || dice == 0) {
      document.add_label();
      return;
    }
    const int id = labels[static_cast<std::size_t>(below(static_cast<int>(labels.size())))].id;
    if (dice == 1) return document.rename_label(id, "name " + std::to_string(below(1000)));
    if (dice == 2) return document.recolor_label(id, label_color(below(500)));
    if (dice == 3 && labels.size() > 2) return document.remove_label(id);
    if (dice == 18) return document.set_boundary_smoothing(0.25 * below(12));
    const PaintStyle style{dice < 8 ? PaintTool::Eraser : PaintTool::Brush, id, 1.0 + below(30),
                           below(2) == 0};
    if (dice == 19) {
      fill_region(document, view(document), {{1, 2, 9}, {2, 2, 9}}, style,
                  below(2) == 0 ? EditKind::Fill : kLastEditKind);
    } else {
      paint(document, style);
    }
  }

  /// An edit, or now and then an undo, a redo or a save.
  void step(AnnotationDocument& document) {
    const int dice = below(10);
    if (dice < 2) {
      document.undo();
    } else if (dice == 2) {
      document.redo();
    } else if (dice == 3 && saves_ && below(4) == 0) {
      document.mark_saved();
    } else {
      make_one(document);
    }
  }

 private:
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

  ViewIndex view(const AnnotationDocument& document) {
    const GridShape grid = document.scribbles().grid();
    const int v = below(grid.v);
    return {v, below(grid.u)};
  }

  void paint(AnnotationDocument& document, const PaintStyle& style) {
    std::uniform_real_distribution<double> place(-0.1, 1.1);
    Stroke stroke(document, view(document), style);
    for (int points = 1 + below(4); points > 0; --points) {
      const double y = place(random_) * document.scribbles().height();
      stroke.extend({y, place(random_) * document.scribbles().width()});
    }
    if (below(8) > 0) stroke.commit();
  }

  std::mt19937 random_;
  bool saves_;
};

}  // namespace episcope::test
