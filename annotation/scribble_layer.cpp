// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/scribble_layer.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

using ViewPointer = std::shared_ptr<Image<std::uint8_t>>;

bool is_blank(const ViewPointer& view) {
  return !view ||
         std::all_of(view->begin(), view->end(), [](std::uint8_t label) { return label == 0; });
}

bool same_labels(const ViewPointer& a, const ViewPointer& b) {
  if (a == b) return true;
  if (!a || !b) return is_blank(a) && is_blank(b);
  return std::equal(a->begin(), a->end(), b->begin());
}

}  // namespace

ScribbleLayer::ScribbleLayer(GridShape grid, int height, int width)
    : grid_(grid), height_(height), width_(width) {
  if (grid.v < 1 || grid.u < 1 || std::min(height, width) < 1 ||
      std::max(height, width) > kMaxExtent) {
    throw InvalidInput(
        fmt::format("scribbles cannot be painted on {}×{} views of {}×{} px; views may have 1 to "
                    "65535 rows and columns",
                    grid.v, grid.u, width, height));
  }
  views_.resize(static_cast<std::size_t>(grid.count()));
}

std::size_t ScribbleLayer::place(ViewIndex view) const {
  if (!grid_.contains(view)) {
    throw InvalidInput(fmt::format("the view ({}) lies outside the grid of {}×{} views",
                                   view_text(view), grid_.v, grid_.u));
  }
  return static_cast<std::size_t>(view.v) * grid_.u + view.u;
}

ImageView<const std::uint8_t> ScribbleLayer::view(ViewIndex view) const {
  const ViewPointer& image = views_[place(view)];
  return image ? std::as_const(*image).view() : ImageView<const std::uint8_t>{};
}

ImageView<std::uint8_t> ScribbleLayer::writable_view(ViewIndex view) {
  ViewPointer& image = views_[place(view)];
  // Held for a moment: giving it back waits for what others read of it before they did.
  const ViewPointer held = image;
  if (!held) {
    image = std::make_shared<Image<std::uint8_t>>(height_, width_);
  } else if (held.use_count() > 2) {
    image = std::make_shared<Image<std::uint8_t>>(*held);
  }
  return image->view();
}

int ScribbleLayer::label_at(ViewIndex view, PixelIndex pixel) const {
  const ViewPointer& image = views_[place(view)];
  const bool is_inside = pixel.y >= 0 && pixel.y < height_ && pixel.x >= 0 && pixel.x < width_;
  return image && is_inside ? image->at(pixel.y, pixel.x) : 0;
}

std::vector<ViewIndex> ScribbleLayer::painted_views() const {
  std::vector<ViewIndex> painted;
  for (int i = 0; i < grid_.count(); ++i) {
    if (!is_blank(views_[static_cast<std::size_t>(i)])) painted.push_back(grid_.view_at(i));
  }
  return painted;
}

std::size_t ScribbleLayer::byte_size() const {
  std::size_t bytes = 0;
  for (const ViewPointer& view : views_) bytes += view ? view->size() : 0;
  return bytes;
}

bool operator==(const ScribbleLayer& a, const ScribbleLayer& b) {
  return a.grid_ == b.grid_ && a.height_ == b.height_ && a.width_ == b.width_ &&
         std::equal(a.views_.begin(), a.views_.end(), b.views_.begin(), same_labels);
}

namespace {

void require_name(const std::string& name) {
  if (name.empty()) throw InvalidInput("a label needs a name; enter one");
  if (name.size() > LabelSet::kMaxNameBytes) {
    throw InvalidInput(fmt::format(
        "the name of a label has {} bytes, but at most {} are allowed; choose a shorter one",
        name.size(), LabelSet::kMaxNameBytes));
  }
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; })) {
    throw InvalidInput("the name of a label contains a line break or control character; remove it");
  }
}

}  // namespace

const LabelInfo* LabelSet::find(int id) const {
  const auto place = std::ranges::find(labels_, id, &LabelInfo::id);
  return place != labels_.end() ? &*place : nullptr;
}

LabelInfo& LabelSet::known(int id) {
  const LabelInfo* label = find(id);
  if (!label) {
    throw InvalidInput(fmt::format("there is no label {} among the {} labels", id, labels_.size()));
  }
  return labels_[static_cast<std::size_t>(label - labels_.data())];
}

int LabelSet::next_id() const {
  int id = last_id_ + 1;
  if (id > kMaxId) {
    for (id = 1; contains(id);) ++id;
  }
  return id;
}

int LabelSet::add(const std::string& name, std::optional<Rgb> color) {
  const int id = next_id();
  if (id > kMaxId) throw InvalidInput("all 255 labels are in use; remove one first");
  if (!color) {
    int place = id;
    const auto is_used = [&](const LabelInfo& label) { return label.color == label_color(place); };
    while (std::ranges::any_of(labels_, is_used)) ++place;
    color = label_color(place);
  }
  insert({id, name.empty() ? fmt::format("label {}", id) : name, *color});
  return id;
}

void LabelSet::require_free(int id) const {
  if (id < 1 || id > kMaxId) {
    throw InvalidInput(fmt::format("the label id {} is out of range; ids range from 1 to 255", id));
  }
  if (contains(id)) throw InvalidInput(fmt::format("the label id {} is already in use", id));
}

void LabelSet::insert(LabelInfo label) {
  require_name(label.name);
  require_free(label.id);
  reserve_ids(label.id);
  labels_.push_back(std::move(label));
}

void LabelSet::rename(int id, const std::string& name) {
  require_name(name);
  known(id).name = name;
}

void LabelSet::renumber(int id, int to) {
  LabelInfo& label = known(id);
  require_free(to);
  reserve_ids(to);
  label.id = to;
}

void LabelSet::move(int id, int place) {
  const auto from = labels_.begin() + (&known(id) - labels_.data());
  const auto to = labels_.begin() + std::clamp(place, 0, static_cast<int>(labels_.size()) - 1);
  from < to ? std::rotate(from, from + 1, to + 1) : std::rotate(to, from, from + 1);
}

}  // namespace episcope
