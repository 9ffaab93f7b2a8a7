// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/joined_digits.h"

#include "engine/io/grid/index_fields.h"
#include "engine/io/grid/number_run.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace episcope::io {
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

}  // namespace episcope::io
