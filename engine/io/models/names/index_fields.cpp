// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/index_fields.h"

#include "engine/core/text.h"
#include "engine/io/models/names/view_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace episcope::io {
namespace {

using FieldForm = IndexFields::Form;

constexpr std::size_t kMostFields = 8;  ///< That vary; names with more tell nothing.
constexpr double kMostlyThere = 0.5;    ///< Part of a grid that names must fill to be one.

/// One number of the names of a group.
struct Field {
  bool is_position = false;
  bool is_index = false;              ///< Whole and different from name to name.
  bool has_signed_run = false;        ///< A position of which `run` and `places` are known, too.
  bool has_even_steps = false;        ///< A position with a fraction: `run` counts its values.
  NumberRun run{{0}};                 ///< Of an index.
  std::vector<std::size_t> places{};  ///< Where in the run each name is.
};

/// Counts positions by their order, if they lie at equal distances.
void count_positions(const NameGroup& group, std::size_t number, Field& field) {
  constexpr double kStepTolerance = 0.1;  // of a step
  std::vector<double> values;
  for (const NumberedImage& image : group.images) {
    values.push_back(image.numbers[number].position());
  }
  std::vector<double> steps = values;
  std::ranges::sort(steps);
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  const double step = (steps.back() - steps.front()) / std::max<double>(1, steps.size() - 1.0);
  std::vector<long long> counts;
  for (const double value : values) {
    const double place = step > 0 ? (value - steps.front()) / step : 0;
    if (std::abs(place - std::round(place)) > kStepTolerance) return;
    counts.push_back(std::llround(place));
    field.places.push_back(static_cast<std::size_t>(counts.back()));
  }
  field.run = NumberRun(counts);
  field.has_even_steps = field.run.values.size() == steps.size() && steps.size() > 1;
}

Field field_of(const NameGroup& group, std::size_t number) {
  const auto all_are = [&](auto&& claim) {
    return std::ranges::all_of(
        group.images, [&](const NumberedImage& image) { return claim(image.numbers[number]); });
  };
  const bool has_dashes = all_are([](const NameNumber& each) { return each.may_be_dash; });
  Field field;
  field.is_position = !all_are(
      [&](const NameNumber& each) { return each.is_whole && (has_dashes || !each.has_minus); });
  if (!all_are([](const NameNumber& each) { return each.count().has_value(); })) {
    if (field.is_position) count_positions(group, number, field);
    return field;
  }
  std::vector<long long> values;
  for (const NumberedImage& image : group.images) {
    const NameNumber& each = image.numbers[number];
    values.push_back(field.is_position ? *each.signed_count() : *each.count());
  }
  field.run = NumberRun(values);
  field.is_index = !field.is_position && field.run.values.size() > 1;
  field.has_signed_run = field.is_position && !field.run.has_gaps() &&
                         field.run.values.front() < 0 && field.run.values.back() > 0;
  for (const long long value : values) field.places.push_back(*field.run.place_of(value));
  return field;
}

/// Whether two indices only repeat each other in another form.
bool is_same(const Field& a, const Field& b) {
  if (a.run.values.size() != b.run.values.size()) return false;
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> partner(a.run.values.size(), kNone);
  std::vector<bool> is_taken(a.run.values.size());
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    std::size_t& expected = partner[a.places[i]];
    if (expected == kNone && !is_taken[b.places[i]]) {
      expected = b.places[i];
      is_taken[expected] = true;
    }
    if (expected != b.places[i]) return false;
  }
  return true;
}

/// Whether no two names have both indices in common.
bool tells_names_apart(const Field& a, const Field& b) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    cells.push_back(a.places[i] * b.run.values.size() + b.places[i]);
  }
  std::ranges::sort(cells);
  return std::ranges::adjacent_find(cells) == cells.end();
}

/// Two indices that may be row and column.
struct NumberPair {
  std::size_t first = 0;
  std::size_t second = 0;
  WordOrder words = WordOrder::Unknown;
  bool is_full = false;
  double filled = 0;
  /// What speaks for it, the most important first.
  std::tuple<bool, bool, int, double, bool> rank{};
};

class Finder {
 public:
  explicit Finder(const NameGroup& group) : count_(group.images.size()), words_(group.skeleton) {
    const std::size_t numbers = group.images.front().numbers.size();
    for (std::size_t i = 0; i < numbers; ++i) {
      fields_.push_back(field_of(group, i));
      if (fields_.back().is_index) varying_.push_back(i);
    }
    group_ = &group;
  }

  IndexFields find() const {
    IndexFields found = find_indices();
    if (found.form == FieldForm::None) {
      if (const auto grid = signed_grid()) return *grid;
      if (const auto grid = position_grid()) return *grid;
    }
    add_positions(found);
    return found;
  }

 private:
  IndexFields find_indices() const {
    if (varying_.empty()) return {};
    if (varying_.size() > kMostFields) return {.form = FieldForm::Unclear};
    if (varying_.size() == 1) return line_or_list(varying_.front());
    const std::vector<NumberPair> pairs = ranked_pairs();
    const bool is_grid = !pairs.empty() && (pairs[0].is_full || pairs[0].filled >= kMostlyThere);
    if (is_grid && is_ambiguous(pairs)) return {.form = FieldForm::Unclear};
    if (is_grid) return as_grid(pairs.front());
    if (const auto running = running_index()) return {.form = FieldForm::List, .index = running};
    if (varying_.size() == 2 && may_be_index(varying_[0]) && may_be_index(varying_[1])) {
      const auto [a, b] = std::pair(varying_[0], varying_[1]);
      return as_grid({a, b, words_.order_of(a, b)});
    }
    return {.form = FieldForm::Unclear};
  }

  /// Of rows or columns.
  bool may_be_index(std::size_t number) const {
    return !fields_[number].run.is_scattered() && !words_.is_other_count(number);
  }

  static IndexFields as_grid(const NumberPair& pair) {
    const bool is_swapped = pair.words == WordOrder::ColumnFirst;
    return {.form = pair.is_full ? FieldForm::Grid : FieldForm::Gaps,
            .row = is_swapped ? pair.second : pair.first,
            .column = is_swapped ? pair.first : pair.second,
            .is_told_by_words = pair.words != WordOrder::Unknown};
  }

  /// Every pair that could be row and column, the best first.
  std::vector<NumberPair> ranked_pairs() const {
    std::vector<NumberPair> pairs;
    for (std::size_t i = 0; i < varying_.size(); ++i) {
      for (std::size_t j = i + 1; j < varying_.size(); ++j) {
        const Field& a = fields_[varying_[i]];
        const Field& b = fields_[varying_[j]];
        const bool may_fit = a.run.values.size() * b.run.values.size() >= count_ &&
                             may_be_index(varying_[i]) && may_be_index(varying_[j]);
        if (!may_fit || !tells_names_apart(a, b)) continue;
        NumberPair pair{varying_[i], varying_[j], words_.order_of(varying_[i], varying_[j])};
        pair.filled = static_cast<double>(count_) /
                      (static_cast<double>(a.run.length()) * static_cast<double>(b.run.length()));
        pair.is_full = static_cast<long long>(count_) == a.run.length() * b.run.length();
        pair.rank = {pair.is_full, pair.words != WordOrder::Unknown,
                     int{a.run.is_plain()} + int{b.run.is_plain()}, pair.filled, j == i + 1};
        pairs.push_back(pair);
      }
    }
    std::ranges::stable_sort(pairs, std::ranges::greater{}, &NumberPair::rank);
    return pairs;
  }

  /// Whether another pair has as much to say for itself as the first and says something else.
  bool is_ambiguous(const std::vector<NumberPair>& pairs) const {
    const NumberPair& best = pairs.front();
    const Field& a = fields_[best.first];
    const Field& b = fields_[best.second];
    return std::any_of(pairs.begin() + 1, pairs.end(), [&](const NumberPair& other) {
      if (other.rank != best.rank) return false;
      const Field& c = fields_[other.first];
      const Field& d = fields_[other.second];
      return !(is_same(a, c) && is_same(b, d)) && !(is_same(a, d) && is_same(b, c));
    });
  }

  /// Two positions that form a full grid, of those that `may_be_axis`; nothing if there are more.
  template <class MayBeAxis>
  std::optional<IndexFields> full_grid(MayBeAxis&& may_be_axis) const {
    std::vector<std::size_t> axes;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (may_be_axis(fields_[i])) axes.push_back(i);
    }
    if (axes.size() != 2) return std::nullopt;
    const Field& a = fields_[axes[0]];
    const Field& b = fields_[axes[1]];
    const bool is_full = static_cast<long long>(count_) == a.run.length() * b.run.length();
    if (!is_full || !tells_names_apart(a, b)) return std::nullopt;
    IndexFields found =
        as_grid({.first = axes[0], .second = axes[1], .words = words_.order_of(axes[0], axes[1])});
    found.form = FieldForm::Grid;
    return found;
  }

  /// Rows and columns that are numbers with signs.
  std::optional<IndexFields> signed_grid() const {
    auto found = full_grid([](const Field& field) { return field.has_signed_run; });
    if (found) found->are_signed = true;
    return found;
  }

  /// Positions alone, of which rows and columns follow.
  std::optional<IndexFields> position_grid() const {
    const auto found =
        full_grid([](const Field& field) { return field.has_even_steps || field.has_signed_run; });
    if (!found) return std::nullopt;
    return IndexFields{.form = FieldForm::Grid,
                       .y = found->row,
                       .x = found->column,
                       .is_told_by_words = found->is_told_by_words};
  }

  /// A number that counts all names where the others do not form a grid.
  std::optional<std::size_t> running_index() const {
    for (const bool must_be_plain : {true, false}) {
      for (const std::size_t i : varying_) {
        const NumberRun& run = fields_[i].run;
        const bool counts = run.values.size() == count_ && !run.has_gaps();
        if (counts && (run.is_plain() || !must_be_plain)) return i;
      }
    }
    return std::nullopt;
  }

  /// A single row, a single column, or a list.
  IndexFields line_or_list(std::size_t index) const {
    IndexFields found{.form = FieldForm::List, .index = index};
    if (fields_[index].run.values.size() != count_) return found;
    if (index > 0 && is_constant_index(index - 1, index, index - 1)) {
      found = {.form = FieldForm::Grid, .row = index - 1, .column = index};
    } else if (index + 1 < fields_.size() && is_constant_index(index + 1, index, index)) {
      found = {.form = FieldForm::Grid, .row = index, .column = index + 1};
    }
    if (found.form == FieldForm::List) return found;
    const WordOrder words = words_.order_of(*found.row, *found.column);
    found.is_told_by_words = words != WordOrder::Unknown;
    if (words == WordOrder::ColumnFirst) std::swap(found.row, found.column);
    return found;
  }

  /// Whether a number that is the same in all names is written like an index beside `index`: the
  /// words say so, or it is 0 or 1, where the index begins as well, with as many digits, and free
  /// of letters. `first` is the number of the two that comes first.
  bool is_constant_index(std::size_t constant, std::size_t index, std::size_t first) const {
    const Field& field = fields_[constant];
    if (field.is_position || field.is_index || field.places.empty()) return false;
    if (words_.order_of(first, first + 1) != WordOrder::Unknown) return true;
    const auto& numbers = group_->images.front().numbers;
    const bool is_written_alike = numbers[constant].text.size() == numbers[index].text.size();
    const long long value = field.run.values.front();
    return is_written_alike && value == fields_[index].run.values.front() &&
           (value == 0 || value == 1) && words_.is_free(first) && words_.is_free(first + 1);
  }

  void add_positions(IndexFields& found) const {
    const std::size_t begin =
        std::max({found.row.value_or(0), found.column.value_or(0), found.index.value_or(0)});
    std::vector<std::size_t> positions;
    for (std::size_t i = begin; i < fields_.size() && positions.size() < 2; ++i) {
      if (fields_[i].is_position) positions.push_back(i);
    }
    if (positions.size() < 2) return;
    found.y = positions[0];
    found.x = positions[1];
    if (words_.order_of(positions[0], positions[1]) == WordOrder::ColumnFirst) {
      std::swap(found.y, found.x);
    }
  }

  std::size_t count_;
  NameWords words_;
  std::vector<Field> fields_;
  std::vector<std::size_t> varying_;
  const NameGroup* group_ = nullptr;
};

std::string sign_of(const NameNumber& number) {
  if (number.has_minus) return "-";
  return number.has_plus ? "+" : "";
}

/// What stands for a number in the pattern of its group.
std::string number_text(const NameGroup& group, const IndexFields& fields, std::size_t number) {
  if (number == fields.row) return "{row}";
  if (number == fields.column) return "{col}";
  if (number == fields.index) return "{index}";
  if (number == fields.y) return "{y}";
  if (number == fields.x) return "{x}";
  const NameNumber& first = group.images.front().numbers[number];
  const bool is_constant = std::ranges::all_of(group.images, [&](const NumberedImage& image) {
    const NameNumber& each = image.numbers[number];
    return each.text == first.text && sign_of(each) == sign_of(first);
  });
  return is_constant ? sign_of(first) + first.text : "*";
}

}  // namespace

IndexFields find_index_fields(const NameGroup& group) {
  if (group.images.size() < 2) return {};
  return Finder(group).find();
}

std::string pattern_text(const NameGroup& group, const IndexFields& fields) {
  std::string pattern;
  std::size_t number = 0;
  for (const char c : group.skeleton) {
    if (c != kNumberMark) {
      pattern += c;
      continue;
    }
    const bool is_index = number == fields.row || number == fields.column || number == fields.index;
    if (is_index && !fields.are_signed) pattern += sign_of(group.images.front().numbers[number]);
    pattern += number_text(group, fields, number++);
  }
  return pattern;
}

namespace {

constexpr std::size_t kMostDigits = 3;  ///< Of a row or a column.

NameNumber part_of(const NameNumber& number, std::size_t begin, std::size_t count) {
  NameNumber part{.text = number.text.substr(begin, count)};
  std::from_chars(part.text.data(), part.text.data() + part.text.size(), part.value);
  return part;
}

/// Digits of each half; nothing if the numbers differ in length or cannot be halved.
std::optional<std::size_t> half_length(const NameGroup& group, std::size_t number) {
  const std::size_t length = group.images.front().numbers[number].text.size();
  const bool is_alike = std::ranges::all_of(group.images, [&](const NumberedImage& image) {
    const NameNumber& each = image.numbers[number];
    return each.is_whole && !each.has_minus && each.text.size() == length;
  });
  if (!is_alike || length % 2 != 0 || length > 2 * kMostDigits) return std::nullopt;
  return length / 2;
}

NumberRun run_of(const NameGroup& group, std::size_t number) {
  std::vector<long long> values;
  for (const NumberedImage& image : group.images) values.push_back(*image.numbers[number].count());
  return NumberRun(std::move(values));
}

NameGroup halved(const NameGroup& group, std::size_t number, std::size_t half) {
  NameGroup result = group;
  std::size_t mark = 0;
  for (std::size_t i = 0; i <= number; ++i) mark = group.skeleton.find(kNumberMark, mark) + 1;
  result.skeleton.insert(mark, 1, kNumberMark);
  for (NumberedImage& image : result.images) {
    const NameNumber whole = image.numbers[number];
    image.numbers[number] = part_of(whole, 0, half);
    image.numbers.insert(image.numbers.begin() + static_cast<std::ptrdiff_t>(number) + 1,
                         part_of(whole, half, half));
  }
  return result;
}

}  // namespace

void separate_joined_digits(NameGroup& group) {
  const IndexFields fields = find_index_fields(group);
  if (fields.form != IndexFields::Form::List || !fields.index) return;
  const auto half = half_length(group, *fields.index);
  if (!half || !run_of(group, *fields.index).has_gaps()) return;
  NameGroup separate = halved(group, *fields.index, *half);
  const NumberRun rows = run_of(separate, *fields.index);
  const NumberRun columns = run_of(separate, *fields.index + 1);
  const bool is_grid = rows.values.size() > 1 && columns.values.size() > 1 && rows.is_plain() &&
                       columns.is_plain() &&
                       rows.values.size() * columns.values.size() == group.images.size();
  if (is_grid && find_index_fields(separate).form == IndexFields::Form::Grid) {
    group = std::move(separate);
  }
}

namespace {

constexpr std::size_t kLongestCount = 18;  ///< Digits that a long long holds.

/// The end of the number that begins with the digit at `begin`: digits, maybe with a fraction,
/// maybe with an exponent that has a sign ("5.9e-08", but not "12e4", which is no number in a
/// name). What follows a point has no fraction: in "toys.3.4" points part numbers.
std::size_t end_of_number(std::string_view text, std::size_t begin) {
  std::size_t end = end_of_digits(text, begin);
  const bool is_parted_by_points = begin > 0 && text[begin - 1] == '.';
  if (!is_parted_by_points && end + 1 < text.size() && text[end] == '.' &&
      is_digit(text[end + 1])) {
    end = end_of_digits(text, end + 1);
  }
  const bool has_exponent = end + 2 < text.size() && (text[end] == 'e' || text[end] == 'E') &&
                            (text[end + 1] == '-' || text[end + 1] == '+') &&
                            is_digit(text[end + 2]);
  return has_exponent ? end_of_digits(text, end + 2) : end;
}

NameNumber number_of(std::string_view text) {
  NameNumber number{.text = std::string(text)};
  number.is_whole = end_of_digits(text, 0) == text.size();
  std::from_chars(text.data(), text.data() + text.size(), number.value);
  return number;
}

}  // namespace

std::optional<long long> NameNumber::count() const {
  if (!is_whole || text.size() > kLongestCount) return std::nullopt;
  long long count = 0;
  std::from_chars(text.data(), text.data() + text.size(), count);
  return count;
}

std::optional<long long> NameNumber::signed_count() const {
  const auto unsigned_count = count();
  return unsigned_count && has_minus ? -*unsigned_count : unsigned_count;
}

NameParts split_name(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  NameParts parts;
  for (std::size_t at = 0; at < stem.size();) {
    if (!is_digit(stem[at])) {
      parts.skeleton += stem[at++];
      continue;
    }
    const std::size_t end = end_of_number(stem, at);
    NameNumber number = number_of(std::string_view(stem).substr(at, end - at));
    const bool has_sign = at > 0 && (stem[at - 1] == '-' || stem[at - 1] == '+');
    if (has_sign && (at < 2 || !is_digit(stem[at - 2]))) {
      number.has_plus = stem[at - 1] == '+';
      number.has_minus = !number.has_plus;
      number.may_be_dash = number.has_minus && at >= 2 && is_letter(stem[at - 2]);
      parts.skeleton.pop_back();
    }
    parts.skeleton += kNumberMark;
    parts.numbers.push_back(std::move(number));
    at = end;
  }
  parts.skeleton += suffix_of(path);
  return parts;
}

std::vector<NameGroup> group_by_name(const std::vector<std::filesystem::path>& images) {
  std::unordered_map<std::string, std::size_t> places;
  std::vector<NameGroup> groups;
  for (const std::filesystem::path& path : images) {
    NameParts parts = split_name(path);
    const auto [place, is_new] = places.try_emplace(parts.skeleton, groups.size());
    if (is_new) groups.push_back({std::move(parts.skeleton), {}});
    groups[place->second].images.push_back({path, std::move(parts.numbers)});
  }
  std::ranges::stable_sort(groups, std::ranges::greater{},
                           [](const NameGroup& group) { return group.images.size(); });
  return groups;
}

namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_separator(char c) {
  return std::string_view("_- =([,.").find(c) != std::string_view::npos;
}

/// The word at the end of `text`, of "viewRow" and "view_row" the word "row".
std::string last_word(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && (is_lower(text[begin - 1]) || is_upper(text[begin - 1]))) {
    --begin;
    const bool is_hump = is_upper(text[begin]) && begin > 0 && is_lower(text[begin - 1]);
    if (is_hump) break;
  }
  return lower_case(std::string(text.substr(begin)));
}

std::string first_word(std::string_view text) {
  const auto end =
      std::ranges::find_if_not(text, [](char c) { return is_lower(c) || is_upper(c); });
  return lower_case(std::string(text.begin(), end));
}

/// What stands before each number, and behind the last.
std::vector<std::string_view> between_numbers(std::string_view skeleton) {
  std::vector<std::string_view> texts;
  std::size_t begin = 0;
  for (std::size_t end; (end = skeleton.find(kNumberMark, begin)) != std::string_view::npos;) {
    texts.push_back(skeleton.substr(begin, end - begin));
    begin = end + 1;
  }
  texts.push_back(skeleton.substr(begin));
  return texts;
}

struct WordPair {
  const char* row;
  const char* column;
};
constexpr std::array kWordPairs{WordPair{"r", "c"}, WordPair{"y", "x"}, WordPair{"v", "u"},
                                WordPair{"t", "s"}};

template <std::size_t N>
bool is_one_of(const std::array<const char*, N>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool is_row(const std::string& word) {
  return is_one_of(std::array{"row", "rows"}, word);
}

bool is_column(const std::string& word) {
  return is_one_of(std::array{"col", "cols", "column", "columns"}, word);
}

bool is_role(const std::string& word) {
  return is_row(word) || is_column(word) ||
         std::ranges::any_of(kWordPairs, [&](const WordPair& pair) {
           return word == pair.row || word == pair.column;
         });
}

WordOrder order_of_words(const std::string& first, const std::string& second) {
  if (is_row(first) || is_column(second)) {
    return is_column(first) || is_row(second) ? WordOrder::Unknown : WordOrder::RowFirst;
  }
  if (is_column(first) || is_row(second)) return WordOrder::ColumnFirst;
  for (const auto& [row, column] : kWordPairs) {
    if (first == row && second == column) return WordOrder::RowFirst;
    if (first == column && second == row) return WordOrder::ColumnFirst;
  }
  return WordOrder::Unknown;
}

template <std::size_t N>
bool has_word(const std::string& text, const std::array<const char*, N>& beginnings) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char before = at == 0 ? '_' : text[at - 1];
    const bool begins_word =
        !(is_lower(before) || is_upper(before)) || (is_upper(text[at]) && is_lower(before));
    if (!begins_word) continue;
    const std::string rest = lower_case(text.substr(at, 16));
    if (std::ranges::any_of(beginnings, [&](const char* word) { return rest.starts_with(word); })) {
      return true;
    }
  }
  return false;
}

}  // namespace

NameWords::NameWords(const std::string& skeleton) {
  const std::vector<std::string_view> texts = between_numbers(skeleton);
  for (std::size_t i = 0; i + 1 < texts.size(); ++i) {
    const auto is_part_of_word = [](char c) { return !is_separator(c); };
    const auto last = std::ranges::find_if(texts[i].rbegin(), texts[i].rend(), is_part_of_word);
    before_.push_back(last_word(std::string_view(texts[i].begin(), last.base())));
    free_.push_back(texts[i].empty() ? i == 0 : is_separator(texts[i].back()));
    after_.push_back(first_word(texts[i + 1]));
  }
}

WordOrder NameWords::order_of(std::size_t first, std::size_t second) const {
  // In "3row_5col" the word before the second number belongs to the first.
  const bool are_after =
      !is_role(before_[first]) && is_role(after_[first]) && is_role(after_[second]);
  return are_after ? order_of_words(after_[first], after_[second])
                   : order_of_words(before_[first], before_[second]);
}

bool NameWords::is_other_count(std::size_t number) const {
  return is_one_of(std::array{"frame", "frames", "time", "exposure"}, before_[number]);
}

bool names_companions(const std::string& skeleton) {
  return has_word(
      skeleton, std::array{"label", "mask", "depth", "disp", "seg", "gt", "normal", "thumb", "conf",
                           "weight", "truth", "objectid", "albedo", "diffuse", "specular"});
}

bool names_mosaics(const std::string& skeleton) {
  return has_word(skeleton, std::array{"eslf", "macpi", "qs/"});
}

}  // namespace episcope::io
