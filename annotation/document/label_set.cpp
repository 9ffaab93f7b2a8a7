// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document/label_set.h"

#include "engine/core/error.h"

#include <algorithm>

namespace episcope {
namespace {

void require_name(const std::string& name) {
  if (name.empty()) throw InvalidInput("a label needs a name; enter one");
  if (name.size() > LabelSet::kMaxNameBytes) {
    throw InvalidInput("the name of a label has " + std::to_string(name.size()) +
                       " bytes, but at most " + std::to_string(LabelSet::kMaxNameBytes) +
                       " are allowed; choose a shorter one");
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
    throw InvalidInput("there is no label " + std::to_string(id) + " among the " +
                       std::to_string(labels_.size()) + " labels");
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
  insert({id, name.empty() ? "label " + std::to_string(id) : name, *color});
  return id;
}

void LabelSet::insert(LabelInfo label) {
  require_name(label.name);
  if (label.id < 1 || label.id > kMaxId) {
    throw InvalidInput("the label id " + std::to_string(label.id) +
                       " is out of range; ids range from 1 to 255");
  }
  if (contains(label.id)) {
    throw InvalidInput("the label id " + std::to_string(label.id) + " is already in use");
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
