// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/stacked_channels.h"

#include "engine/io/arrays/array_parallax.h"
#include "engine/io/arrays/choose_layout.h"

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::size_t kChannels = 3;
constexpr std::size_t kFewestViews = 4;

/// 3N×H×W as N×3×H×W.
ArrayShape grouped(const ArrayShape& list) {
  return {list[0] / kChannels, kChannels, list[1], list[2]};
}

class GroupedInput : public ArrayInput {
 public:
  explicit GroupedInput(std::unique_ptr<ArrayInput> list)
      : ArrayInput(list->path(), grouped(list->shape()), list->type()), list_(std::move(list)) {}
  [[nodiscard]] bool is_sequential() const override { return list_->is_sequential(); }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const ArrayShape part{count[1], count[2], count[3]};
    const std::size_t bytes = element_count(part) * byte_size(type());
    for (std::size_t i = 0; i < count[0]; ++i, out += bytes) {
      list_->read_raw({(start[0] + i) * kChannels + start[1], start[2], start[3]}, part, out);
    }
  }

  std::unique_ptr<ArrayInput> list_;
};

class GroupedFile : public ArrayFile {
 public:
  GroupedFile(const ArrayFile& file, const std::string& list)
      : ArrayFile(file.path(), file.form()), file_(file), list_(list) {
    for (ArrayEntry entry : file.entries()) {
      entry.parts.clear();  // the file itself puts them together
      if (entry.name == list) entry.shape = grouped(entry.shape);
      add(std::move(entry));
    }
  }

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override {
    const auto& all = file_.entries();
    auto array = file_.open(*std::ranges::find(all, entry.name, &ArrayEntry::name));
    if (entry.name != list_) return array;
    return std::make_unique<GroupedInput>(std::move(array));
  }

  const ArrayFile& file_;
  std::string list_;
};

bool may_be_stacked(const ArrayEntry& entry) {
  constexpr std::size_t kAxes = 3;
  return entry.shape.size() == kAxes && entry.order == IndexOrder::C && entry.stated_axes.empty() &&
         entry.parts.empty() && entry.shape[0] % kChannels == 0 &&
         entry.shape[0] / kChannels >= kFewestViews;
}

}  // namespace

std::unique_ptr<ArrayFile> with_stacked_channels(const ArrayFile& file,
                                                 const OpenOptions& options) {
  if (!options.axes.empty() || !options.dataset.empty()) return nullptr;
  const std::vector<const ArrayEntry*> fields = light_fields_of(file, {});
  if (fields.size() != 1 || !may_be_stacked(*fields.front())) return nullptr;
  const ArrayEntry& list = *fields.front();
  const std::vector<ArrayLayout> layouts = possible_layouts(list.shape, list.order);
  if (layouts.size() != 1 || layouts.front().axes != "nyx") return nullptr;
  const ArrayLayout as_grid{grouped(list.shape), "vuyx"};
  const auto [along_u, along_v] = measure_parallax(GroupedInput(file.open(list)), as_grid);
  if (!are_rather_channels(along_u, along_v)) return nullptr;
  return std::make_unique<GroupedFile>(file, list.name);
}

}  // namespace episcope::io
