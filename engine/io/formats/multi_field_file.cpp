// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/multi_field_file.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/models/choose_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace episcope::io {
namespace {

constexpr std::size_t kGreyAxes = 5;         ///< Of a stack of grey light fields in C order.
constexpr std::size_t kMostNamedFields = 8;  ///< Light fields that a sentence names.
constexpr int kLargestAspect = 8;            ///< Of sides of grey views in a stack.

/// One of the arrays along the first axis of a stack.
class SliceInput : public ArrayInput {
 public:
  SliceInput(std::unique_ptr<ArrayInput> stack, std::size_t index)
      : ArrayInput(stack->path(), without_first(stack->shape()), stack->type()),
        stack_(std::move(stack)),
        index_(index) {}
  [[nodiscard]] bool is_sequential() const override { return stack_->is_sequential(); }
  [[nodiscard]] ArrayShape unit() const override { return without_first(stack_->unit()); }

 private:
  static ArrayShape without_first(ArrayShape shape) {
    shape.erase(shape.begin());
    return shape;
  }
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const auto in_stack = [](std::size_t first, ArrayShape lengths) {
      lengths.insert(lengths.begin(), first);
      return lengths;
    };
    stack_->read_raw(in_stack(index_, start), in_stack(1, count), out);
  }

  std::unique_ptr<ArrayInput> stack_;
  std::size_t index_;
};

/// Some of the arrays of a file, and of stacks a slice.
class PartOfFile : public ArrayFile {
 public:
  explicit PartOfFile(const ArrayFile& file) : ArrayFile(file.path(), file.form()), file_(file) {}

  void add_whole(ArrayEntry entry) {
    entry.parts.clear();  // the file itself puts them together
    add(std::move(entry));
  }
  void add_slice(ArrayEntry entry, std::size_t slice);

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override {
    const auto& all = file_.entries();
    auto array = file_.open(*std::ranges::find(all, entry.name, &ArrayEntry::name));
    if (array->shape().size() == entry.shape.size()) return array;
    return std::make_unique<SliceInput>(std::move(array), slices_.at(entry.name));
  }

  const ArrayFile& file_;
  std::map<std::string, std::size_t> slices_;  ///< By the names of stacks.
};

ArrayEntry slice_of(ArrayEntry stack) {
  stack.shape.erase(stack.shape.begin());
  std::erase_if(stack.stated_axes, [](char c) { return c == ',' || c == ' '; });
  if (stack.stated_axes.size() > stack.shape.size()) {
    const bool is_reversed = stack.order == IndexOrder::Fortran;
    stack.stated_axes.erase(is_reversed ? stack.stated_axes.end() - 1 : stack.stated_axes.begin());
  }
  return stack;
}

void PartOfFile::add_slice(ArrayEntry entry, std::size_t slice) {
  entry.parts.clear();
  entry.leading.clear();
  slices_[entry.name] = slice;
  add(slice_of(std::move(entry)));
}

/// What the slices of an array of five axes in C order can be, if they are grids of grey views.
std::vector<ArrayLayout> grey_layouts(const ArrayEntry& entry) {
  const bool is_plain = entry.shape.size() == kGreyAxes && entry.order == IndexOrder::C &&
                        entry.stated_axes.empty() && entry.parts.empty();
  if (!is_plain) return {};
  std::vector<ArrayLayout> layouts = possible_layouts(slice_of(entry).shape, entry.order);
  std::erase_if(layouts, [](const ArrayLayout& layout) {
    const auto [less, more] = std::minmax({layout.height(), layout.width()});
    return layout.axes != "vuyx" || more > kLargestAspect * less;
  });
  return layouts;
}

/// What ends a word: anything but letters and digits, or a number as well.
enum class Words { Whole, Numbers };

/// Whether a word may end, or begin, between two neighboring characters.
bool parts_words(char a, char b, Words words) {
  const auto is_part = [](char c) { return is_letter(c) || is_digit(c); };
  return !is_part(a) || !is_part(b) || (words == Words::Numbers && is_digit(a) != is_digit(b));
}

/// Whether the name holds the word with nothing beside it that belongs to the same word.
bool holds_word(const std::string& name, const std::string& word, Words words) {
  if (word.empty()) return false;
  for (auto at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || parts_words(name[at - 1], name[at], words);
    const bool ends = end == name.size() || parts_words(name[end - 1], name[end], words);
    if (begins && ends) return true;
  }
  return false;
}

/// What each of the names has alone: "a" and "b" of "a/LF" and "b/LF", in whole words; of LF1 and
/// LF2 also "1" and "2".
std::vector<std::string> own_words(const std::vector<std::string>& names, Words words) {
  const std::string& first = names.front();
  std::size_t begin = first.size();
  std::size_t end = first.size();
  for (const std::string& name : names) {
    begin = std::min<std::size_t>(begin, std::ranges::mismatch(first, name).in1 - first.begin());
    const auto same = std::mismatch(first.rbegin(), first.rend(), name.rbegin(), name.rend());
    end = std::min<std::size_t>(end, same.first - first.rbegin());
  }
  // Where one name ends, another goes on.
  const auto is_inside = [&](std::size_t at) {
    const char before = at > 0 ? first[at - 1] : first[at];
    const char after = at < first.size() ? first[at] : first[at - 1];
    return !parts_words(before, after, words);
  };
  while (begin > 0 && is_inside(begin)) --begin;
  while (end > 0 && is_inside(first.size() - end)) --end;
  std::vector<std::string> own;
  for (const std::string& name : names) {
    own.push_back(name.size() > begin + end ? name.substr(begin, name.size() - begin - end)
                                            : std::string());
  }
  return own;
}

/// The words by which maps tell their light field: whole ones, or numbers where no map has those.
struct TellingWords {
  Words words = Words::Whole;
  std::vector<std::string> own;

  TellingWords(const std::vector<std::string>& fields, const ArrayFile& file)
      : own(own_words(fields, words)) {
    const bool are_told = std::ranges::any_of(file.entries(), [&](const ArrayEntry& entry) {
      return std::ranges::count(fields, entry.name) == 0 && owner_of(entry.name);
    });
    if (are_told) return;
    words = Words::Numbers;
    own = own_words(fields, words);
  }

  /// The light field whose word the name holds; nothing if it holds none, or several.
  [[nodiscard]] std::optional<std::size_t> owner_of(const std::string& name) const {
    std::optional<std::size_t> owner;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (!holds_word(name, own[i], words)) continue;
      if (owner) return std::nullopt;
      owner = i;
    }
    return owner;
  }
};

/// Whether the names call the same thing: in several groups, or numbered.
bool are_alike(const std::vector<const ArrayEntry*>& entries) {
  const auto form_of = [](const ArrayEntry* entry) {
    std::string form = last_name(entry->name);
    std::erase_if(form, is_digit);
    return form;
  };
  return std::ranges::all_of(
      entries, [&](const ArrayEntry* entry) { return form_of(entry) == form_of(entries.front()); });
}

bool have_one_shape(const std::vector<const ArrayEntry*>& entries) {
  return std::ranges::all_of(entries, [&](const ArrayEntry* entry) {
    return entry->shape == entries.front()->shape && entry->type == entries.front()->type &&
           entry->order == entries.front()->order;
  });
}

}  // namespace

bool can_be_stack(const ArrayEntry& entry) {
  if (!entry.other_kind.empty() || entry.is_of_views() || entry.shape.size() < kGreyAxes) {
    return false;
  }
  if (entry.shape.front() < 2 || can_be_light_field(entry)) return false;
  if (entry.shape.size() > kGreyAxes) return can_be_light_field(slice_of(entry));
  return entry.leading.empty() && !grey_layouts(entry).empty();
}

std::optional<MultiFieldFile> MultiFieldFile::find(const ArrayFile& file,
                                                   const OpenOptions& options) {
  std::vector<const ArrayEntry*> fields = light_fields_of(file, options.axes);
  MultiFieldFile several;
  const bool are_several = fields.size() > 1 && have_one_shape(fields) && are_alike(fields);
  if (are_several) {
    for (const ArrayEntry* entry : fields) several.names_.push_back(entry->name);
    several.count_ = static_cast<int>(fields.size());
    const bool is_meant =
        options.dataset.empty() ||
        std::ranges::find(several.names_, options.dataset) != several.names_.end();
    return is_meant ? std::optional(several) : std::nullopt;
  }
  const auto letters = static_cast<std::size_t>(std::ranges::count_if(options.axes, is_letter));
  const auto is_stack = [&](const ArrayEntry& entry) {
    const bool is_named =
        options.dataset.empty() ? !has_other_name(entry) : entry.name == options.dataset;
    const bool is_stated = entry.other_kind.empty() && entry.shape.size() == letters + 1 &&
                           !grey_layouts(entry).empty();
    return is_named && (can_be_stack(entry) || is_stated);
  };
  const bool is_one =
      std::ranges::any_of(fields, [](const ArrayEntry* entry) { return !has_other_name(*entry); });
  const auto& all = file.entries();
  if ((is_one && options.dataset.empty()) || std::ranges::count_if(all, is_stack) != 1) return {};
  const ArrayEntry& stack = *std::ranges::find_if(all, is_stack);
  several.names_ = {stack.name};
  several.count_ = static_cast<int>(std::min<std::size_t>(stack.shape.front(), 1'000'000));
  return several;
}

bool MultiFieldFile::is_named(const OpenOptions& options) const {
  return names_.size() > 1 && !options.dataset.empty();
}

int MultiFieldFile::index(const ArrayFile& file, const OpenOptions& options) const {
  if (is_named(options)) {
    return static_cast<int>(std::ranges::find(names_, options.dataset) - names_.begin());
  }
  if (options.frame >= 0 && options.frame < count_) return options.frame;
  throw InvalidInput(
      fmt::format("{} holds {} light fields, but number {} was asked for; name one from 0 to {} "
                  "with --frame",
                  file.path().string(), count_, options.frame, count_ - 1));
}

std::unique_ptr<ArrayFile> MultiFieldFile::one(const ArrayFile& file, int index) const {
  const auto number = static_cast<std::size_t>(index);
  auto part = std::make_unique<PartOfFile>(file);
  if (names_.size() == 1) {
    for (const ArrayEntry& entry : file.entries()) {
      const bool is_stack = entry.other_kind.empty() && !entry.is_of_views() &&
                            entry.shape.size() > 1 &&
                            entry.shape.front() == static_cast<std::size_t>(count_);
      is_stack ? part->add_slice(entry, number) : part->add_whole(entry);
    }
    return part;
  }
  const TellingWords telling(names_, file);
  for (const ArrayEntry& entry : file.entries()) {
    const auto field = std::ranges::find(names_, entry.name);
    if (field != names_.end()) {
      if (field - names_.begin() == index) part->add_whole(entry);
      continue;
    }
    // Maps of three light fields or more were joined to a list.
    const auto own_part = std::ranges::find_if(
        entry.parts, [&](const std::string& name) { return telling.owner_of(name) == number; });
    if (entry.leading == "n" && own_part != entry.parts.end()) {
      part->add_slice(entry, static_cast<std::size_t>(own_part - entry.parts.begin()));
    } else if (telling.owner_of(entry.name).value_or(number) == number) {
      part->add_whole(entry);
    }
  }
  return part;
}

std::string MultiFieldFile::text(int index) const {
  if (names_.size() == 1) {
    return fmt::format(
        "{} holds {} light fields: number {} is opened, --frame 0 to {} opens another.",
        names_.front().empty() ? "The array" : names_.front(), count_, index, count_ - 1);
  }
  std::vector<std::string> some = names_;
  some.resize(std::min(some.size(), kMostNamedFields));
  return fmt::format(
      "The file holds {} light fields ({}{}): {} is opened, --frame 0 to {} or "
      "--dataset opens another.",
      count_, joined(some, ", "), some.size() < names_.size() ? ", …" : "",
      names_[static_cast<std::size_t>(index)], count_ - 1);
}

}  // namespace episcope::io
