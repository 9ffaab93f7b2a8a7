// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/scene.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// An image of label ids for every view, `[v][u][y][x]`, 0 = none. Memory for a view is allocated
/// once it is painted. Copies share the memory of a view until one of them writes to it, so that a
/// copy costs nothing, and may be read in another thread while this one is painted on.
class ScribbleLayer {
 public:
  /// Maximum height and width of views, so that coordinates fit 16 bits.
  static constexpr int kMaxExtent = 65535;

  ScribbleLayer() = default;
  /// Throws InvalidInput for an empty grid, or views that are empty or larger than kMaxExtent.
  ScribbleLayer(GridShape grid, int height, int width);

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }

  /// Label ids of a view; empty if it was never painted. Throws InvalidInput outside the grid, as
  /// the next two.
  [[nodiscard]] ImageView<const std::uint8_t> view(ViewIndex view) const;
  /// For writing, until the layer is copied; allocates the view, or copies it if it is shared.
  [[nodiscard]] ImageView<std::uint8_t> writable_view(ViewIndex view);
  /// The label at a pixel; 0 also outside the view.
  [[nodiscard]] int label_at(ViewIndex view, PixelIndex pixel) const;
  /// Views with at least one label, in the order of the grid.
  [[nodiscard]] std::vector<ViewIndex> painted_views() const;
  /// Memory used by the views, in bytes.
  [[nodiscard]] std::size_t byte_size() const;

  /// Whether the same pixels have the same labels. Views that are shared are not read.
  friend bool operator==(const ScribbleLayer& a, const ScribbleLayer& b);

 private:
  [[nodiscard]] std::size_t place(ViewIndex view) const;

  GridShape grid_;
  int height_ = 0;
  int width_ = 0;
  std::vector<std::shared_ptr<Image<std::uint8_t>>> views_;  // null = never painted
};

/// The pixels [x0, x1) of row y.
struct PixelSpan {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
  [[nodiscard]] PixelRect rect() const { return {y, x0, y + 1, x1}; }
  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

using PixelRegion = std::vector<PixelSpan>;

/// The pixels (y, x) of a view for which `is_in(y, x)` is true, row by row.
template <class IsIn>
[[nodiscard]] PixelRegion region_where(int height, int width, const IsIn& is_in) {
  PixelRegion region;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_in(y, x)) continue;
      const int begin = x;
      while (x < width && is_in(y, x)) ++x;
      region.push_back({y, begin, x});
    }
  }
  return region;
}

/// The labels that a user paints with, in the order of their list: ids 1 … 255. Removing a label
/// does not renumber the others, and its id is reused only after all others have been used.
class LabelSet {
 public:
  static constexpr int kMaxId = 255;
  /// Bytes of a name: names of all labels together must fit an attribute of an HDF5 file.
  static constexpr std::size_t kMaxNameBytes = 200;

  [[nodiscard]] const std::vector<LabelInfo>& labels() const { return labels_; }
  [[nodiscard]] bool contains(int id) const { return find(id) != nullptr; }
  /// Null if there is no such label.
  [[nodiscard]] const LabelInfo* find(int id) const;
  /// The highest id that was ever given.
  [[nodiscard]] int last_id() const { return last_id_; }

  /// The id that `add` gives; above kMaxId if all are taken.
  [[nodiscard]] int next_id() const;
  /// Adds a label under the next id and returns the id. An empty name becomes "label <id>"; without
  /// a color it gets the first palette color, starting from its id, that no other label has.
  /// Throws InvalidInput for a bad name or if all ids are taken.
  int add(const std::string& name = {}, std::optional<Rgb> color = std::nullopt);
  /// Adds a label of a known id, as read from a file. Throws InvalidInput for an id out of range or
  /// taken, or a bad name.
  void insert(LabelInfo label);
  /// Those below throw InvalidInput for an unknown id or a bad name.
  void rename(int id, const std::string& name);
  void recolor(int id, Rgb color) { known(id).color = color; }
  void remove(int id) { labels_.erase(labels_.begin() + (&known(id) - labels_.data())); }
  /// Also throws InvalidInput for a new id that is out of range or taken.
  void renumber(int id, int to);
  /// Moves a label to a place of the list, from 0; beyond the ends, to the first or last place.
  void move(int id, int place);
  /// Marks ids up to `id` as used.
  void reserve_ids(int id) { last_id_ = std::max(last_id_, std::min(id, kMaxId)); }

  friend bool operator==(const LabelSet&, const LabelSet&) = default;

 private:
  [[nodiscard]] LabelInfo& known(int id);
  void require_free(int id) const;

  std::vector<LabelInfo> labels_;
  int last_id_ = 0;
};

}  // namespace episcope
