// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/multi_field_file.h"

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/array_preview.h"
#include "engine/io/models/choose_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

/// Two neighboring views, in one of several planes of an array.
struct PlaneViews {
  Image<float> center;
  Image<float> neighbour;  ///< To the left or right of it, or above.
  bool is_above = false;
};

constexpr int kSquare_px = 8;        ///< Of pictures of half the size.
constexpr int kFurthest_px = 4;      ///< Motion of these squares that is looked for.
constexpr double kUnlike_px = 0.2;   ///< Difference of motion of different scenes is above.
constexpr double kUnlike = 0.5;      ///< Correlation of different scenes is below.
constexpr double kNoDetail = 1e-12;  ///< Variance, relative to the mean square.

/// Means of 2×2 pixels, which have half of the noise.
Image<float> halved(const Image<float>& picture) {
  Image<float> half(picture.height() / 2, picture.width() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const float* above = picture.row(2 * y);
    const float* below = picture.row(2 * y + 1);
    for (int x = 0; x < half.width(); ++x, above += 2, below += 2) {
      half.at(y, x) = (above[0] + above[1] + below[0] + below[1]) / 4;
    }
  }
  return half;
}

/// Size without sign; nothing where one of the two does not vary.
std::optional<double> part_correlation(const Image<float>& a, const Image<float>& b, int top,
                                       int left, int height, int width) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      const double p = a.at(y, x), q = b.at(y, x);
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  }
  const double count = static_cast<double>(height) * width;
  const double variance_a = aa - sum_a * sum_a / count, variance_b = bb - sum_b * sum_b / count;
  if (!(variance_a > kNoDetail * aa) || !(variance_b > kNoDetail * bb)) return std::nullopt;
  return std::abs(ab - sum_a * sum_b / count) / std::sqrt(variance_a * variance_b);
}

/// Calls `use(top, left)` for the squares of a picture that may move by `margin` within it.
template <class Use>
void for_squares(const Image<float>& picture, int margin, const Use& use) {
  for (int y = margin; y + kSquare_px + margin <= picture.height(); y += kSquare_px) {
    for (int x = margin; x + kSquare_px + margin <= picture.width(); x += kSquare_px) use(y, x);
  }
}

/// Of the squares in which both vary; 0 if there are none.
double median_correlation(const Image<float>& a, const Image<float>& b) {
  std::vector<float> all;
  for_squares(a, 0, [&](int y, int x) {
    if (const auto one = part_correlation(a, b, y, x, kSquare_px, kSquare_px)) {
      all.push_back(static_cast<float>(*one));
    }
  });
  return all.empty() ? 0 : quantile(all, 0.5);
}

/// How far each square has moved in the neighboring view, to a fraction of a pixel.
std::vector<float> motion_of(const PlaneViews& plane) {
  std::vector<float> all;
  for_squares(plane.center, kFurthest_px, [&](int top, int left) {
    std::array<double, 2 * kFurthest_px + 1> costs{};
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const int shift = static_cast<int>(i) - kFurthest_px;
      for (int y = top; y < top + kSquare_px; ++y) {
        for (int x = left; x < left + kSquare_px; ++x) {
          const double off =
              plane.center.at(y, x) - (plane.is_above ? plane.neighbour.at(y + shift, x)
                                                      : plane.neighbour.at(y, x + shift));
          costs[i] += off * off;
        }
      }
    }
    const auto best = std::ranges::min_element(costs) - costs.begin();
    double part = 0;
    if (best > 0 && best + 1 < std::ssize(costs)) {
      const auto at = static_cast<std::size_t>(best);
      const double bend = costs[at - 1] - 2 * costs[at] + costs[at + 1];
      if (bend > 0) part = (costs[at - 1] - costs[at + 1]) / (2 * bend);
    }
    all.push_back(static_cast<float>(static_cast<double>(best) + part));
  });
  return all;
}

bool move_differently(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.empty()) return false;
  std::vector<float> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(std::abs(a[i] - b[i]));
  constexpr double kHalved = 2;
  return kHalved * quantile(differences, 0.5) > kUnlike_px;
}

bool are_correlated(const Image<float>& a, const Image<float>& b) {
  const auto whole = part_correlation(a, b, 0, 0, a.height(), a.width());
  return !whole || *whole > kUnlike || median_correlation(a, b) > kUnlike;
}

/// Whether planes of one size show scenes of their own, and are not the channels of one. No two of
/// them may be correlated, neither as a whole nor in the median of squares of 16 px: channels of
/// color are at 0.9 as a rule, those of saturated colors without texture at 0.6 by one of the two
/// measures; pictures of different scenes are below 0.4 by both. And squares must move differently
/// from view to view, by more than 0.2 px in the median. False where a plane is of one value, as
/// weights are.
bool are_unrelated_channels(const std::vector<PlaneViews>& planes) {
  std::vector<PlaneViews> halves;
  std::vector<std::vector<float>> motions;
  for (const PlaneViews& plane : planes) {
    halves.push_back({halved(plane.center), halved(plane.neighbour), plane.is_above});
    motions.push_back(motion_of(halves.back()));
  }
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (are_correlated(halves[i].center, halves[k].center)) return false;
      if (!move_differently(motions[i], motions[k])) return false;
    }
  }
  return halves.size() > 1;
}

constexpr std::size_t kGreyAxes = 5;         ///< Of a stack of grey light fields in C order.
constexpr std::size_t kMostNamedFields = 8;  ///< Light fields that a sentence names.
constexpr int kLookedAt_px = 256;            ///< Side of what is compared of a view.
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
  PartOfFile(const ArrayFile& file, std::size_t slice)
      : ArrayFile(file.path(), file.form()), file_(file), slice_(slice) {}

  void add_whole(ArrayEntry entry) {
    entry.parts.clear();  // the file itself puts them together
    add(std::move(entry));
  }
  void add_slice(ArrayEntry entry);

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override {
    const auto& all = file_.entries();
    auto array = file_.open(*std::ranges::find(all, entry.name, &ArrayEntry::name));
    if (array->shape().size() == entry.shape.size()) return array;
    return std::make_unique<SliceInput>(std::move(array), slice_);
  }

  const ArrayFile& file_;
  std::size_t slice_;
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

void PartOfFile::add_slice(ArrayEntry entry) {
  entry.parts.clear();
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

/// Whether the three or four planes along the first axis, channels by their number, are different
/// light fields. Reads a view of each.
bool has_unlike_planes(const ArrayFile& file, const ArrayEntry& entry) {
  const std::vector<ArrayLayout> slices = grey_layouts(entry);
  if (slices.empty()) return false;
  const std::vector<ArrayLayout> whole = possible_layouts(entry.shape, entry.order);
  if (whole.size() != 1 || whole.front().axes != "cvuyx" || entry.shape.front() < 2) return false;
  const GridShape grid = slices.front().grid();
  const ViewIndex center = grid.center();
  const bool is_above = grid.u == 1;
  const ViewIndex beside =
      is_above ? ViewIndex{center.v - 1, center.u} : ViewIndex{center.v, center.u - 1};
  std::vector<PlaneViews> planes;
  for (std::size_t i = 0; i < entry.shape.front(); ++i) {
    const SliceInput slice(file.open(entry), i);
    auto views = array_windows(slice, slices.front(), {center, beside}, kLookedAt_px);
    planes.push_back({std::move(views[0]), std::move(views[1]), is_above});
  }
  return are_unrelated_channels(planes);
}

bool is_word_end(const std::string& text, std::size_t at) {
  return at >= text.size() || !(is_letter(text[at]) || is_digit(text[at]));
}

/// Whether the name holds the word, with no letter nor digit next to it.
bool holds_word(const std::string& name, const std::string& word) {
  if (word.empty()) return false;
  for (auto at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    if ((at == 0 || is_word_end(name, at - 1)) && is_word_end(name, at + word.size())) return true;
  }
  return false;
}

/// What each of the names has alone: "a" and "b" of "a/LF" and "b/LF", in whole words.
std::vector<std::string> own_words(const std::vector<std::string>& names) {
  const std::string& first = names.front();
  std::size_t begin = first.size();
  std::size_t end = first.size();
  for (const std::string& name : names) {
    begin = std::min<std::size_t>(begin, std::ranges::mismatch(first, name).in1 - first.begin());
    const auto same = std::mismatch(first.rbegin(), first.rend(), name.rbegin(), name.rend());
    end = std::min<std::size_t>(end, same.first - first.rbegin());
  }
  while (begin > 0 && !is_word_end(first, begin - 1)) --begin;
  while (end > 0 && !is_word_end(first, first.size() - end)) --end;
  std::vector<std::string> words;
  for (const std::string& name : names) {
    words.push_back(name.size() > begin + end ? name.substr(begin, name.size() - begin - end)
                                              : std::string());
  }
  return words;
}

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
  const bool is_grey_stack = fields.size() == 1 && options.axes.empty() &&
                             (options.dataset.empty() || fields.front()->name == options.dataset) &&
                             has_unlike_planes(file, *fields.front());
  const auto is_stack = [&](const ArrayEntry& entry) {
    const bool is_named =
        options.dataset.empty() ? !has_other_name(entry) : entry.name == options.dataset;
    return is_named && (is_grey_stack ? &entry == fields.front() : can_be_stack(entry));
  };
  const bool is_one = !is_grey_stack && std::ranges::any_of(fields, [](const ArrayEntry* entry) {
    return !has_other_name(*entry);
  });
  const auto& all = file.entries();
  if ((is_one && options.dataset.empty()) || std::ranges::count_if(all, is_stack) != 1) return {};
  const ArrayEntry& stack = *std::ranges::find_if(all, is_stack);
  several.names_ = {stack.name};
  several.count_ = static_cast<int>(std::min<std::size_t>(stack.shape.front(), 1'000'000));
  several.are_unrelated_channels_ = is_grey_stack;
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
  auto part = std::make_unique<PartOfFile>(file, number);
  if (names_.size() == 1) {
    for (const ArrayEntry& entry : file.entries()) {
      const bool is_stack = entry.other_kind.empty() && !entry.is_of_views() &&
                            entry.shape.size() > 1 &&
                            entry.shape.front() == static_cast<std::size_t>(count_);
      is_stack ? part->add_slice(entry) : part->add_whole(entry);
    }
    return part;
  }
  const std::vector<std::string> words = own_words(names_);
  for (const ArrayEntry& entry : file.entries()) {
    const auto is_of = [&](std::size_t i) {
      return entry.name == names_[i] || holds_word(entry.name, words[i]);
    };
    bool is_of_another = false;
    for (std::size_t i = 0; i < names_.size(); ++i) is_of_another |= i != number && is_of(i);
    const bool is_own = entry.name == names_[number] || is_of(number) || !is_of_another;
    if (is_own && (entry.name == names_[number] || !std::ranges::count(names_, entry.name))) {
      part->add_whole(entry);
    }
  }
  return part;
}

std::string MultiFieldFile::text(int index) const {
  if (names_.size() == 1) {
    return fmt::format(
        "{} holds {} light fields{}: number {} is opened, --frame 0 to {} opens another.",
        names_.front().empty() ? "The array" : names_.front(), count_,
        are_unrelated_channels_
            ? ", for the planes of its first axis show different scenes (--axes "
              "cvuyx takes them for channels)"
            : "",
        index, count_ - 1);
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
