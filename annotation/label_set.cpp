// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/label_set.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
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
  const auto place = std::ranges::lower_bound(labels_, id, {}, &LabelInfo::id);
  return place != labels_.end() && place->id == id ? &*place : nullptr;
}

LabelInfo& LabelSet::known(int id) {
  const LabelInfo* label = find(id);
  if (!label) {
    throw InvalidInput(fmt::format("there is no label {} among the {} labels", id, labels_.size()));
  }
  return labels_[static_cast<std::size_t>(label - labels_.data())];
}

int LabelSet::add(const std::string& name, std::optional<Rgb> color) {
  int id = last_id_ + 1;
  if (id > kMaxId) {
    for (id = 1; contains(id);) ++id;
  }
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

void LabelSet::insert(LabelInfo label) {
  require_name(label.name);
  if (label.id < 1 || label.id > kMaxId) {
    throw InvalidInput(
        fmt::format("the label id {} is out of range; ids range from 1 to 255", label.id));
  }
  if (contains(label.id)) {
    throw InvalidInput(fmt::format("the label id {} is already in use", label.id));
  }
  reserve_ids(label.id);
  labels_.insert(std::ranges::lower_bound(labels_, label.id, {}, &LabelInfo::id), std::move(label));
}

void LabelSet::rename(int id, const std::string& name) {
  require_name(name);
  known(id).name = name;
}

void LabelSet::recolor(int id, Rgb color) {
  known(id).color = color;
}

void LabelSet::remove(int id) {
  labels_.erase(labels_.begin() + (&known(id) - labels_.data()));
}

void LabelSet::reserve_ids(int id) {
  last_id_ = std::max(last_id_, std::min(id, kMaxId));
}

}  // namespace episcope
