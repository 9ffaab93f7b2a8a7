// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/lettered_rows.h"

#include "engine/core/text/suffix.h"
#include "engine/io/grid/index_fields.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestLetters = 3;

/// Names without a letter, which stands in this place.
struct Lettered {
  std::string rest;
  std::size_t place = 0;

  friend bool operator<(const Lettered& a, const Lettered& b) {
    return std::pair(a.place, a.rest) < std::pair(b.place, b.rest);
  }
};

/// Places of letters with none beside them, but for those of the suffix.
std::vector<std::size_t> lonely_letters(const std::string& skeleton) {
  const std::size_t end = std::min(skeleton.rfind('.'), skeleton.size());
  const auto is_letter_at = [&](std::size_t at) { return at < end && is_letter(skeleton[at]); };
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < end; ++at) {
    if (is_letter_at(at) && !is_letter_at(at + 1) && (at == 0 || !is_letter_at(at - 1))) {
      places.push_back(at);
    }
  }
  return places;
}

/// Whether these are the first letters, upper case or lower case.
bool run_from_a(const std::vector<char>& letters) {
  const char first = letters.front();
  if ((first != 'a' && first != 'A') || letters.size() < kFewestLetters) return false;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (letters[i] != static_cast<char>(first + static_cast<int>(i))) return false;
  }
  return true;
}

/// Groups by the letter that tells them apart.
using Rows = std::map<char, const NameGroup*>;

bool are_rows(const Rows& rows) {
  std::vector<char> letters;
  for (const auto& [letter, group] : rows) letters.push_back(letter);
  const std::size_t count = rows.begin()->second->images.size();
  return run_from_a(letters) && count > 1 && std::ranges::all_of(rows, [&](const auto& row) {
           return row.second->images.size() == count;
         });
}

NameGroup joined(const Rows& rows, std::size_t place) {
  NameGroup whole{rows.begin()->second->skeleton, {}};
  whole.skeleton[place] = kNumberMark;
  const auto number =
      std::count(whole.skeleton.begin(),
                 whole.skeleton.begin() + static_cast<std::ptrdiff_t>(place), kNumberMark);
  int row = 0;
  for (const auto& [letter, group] : rows) {
    ++row;
    for (NumberedImage image : group->images) {
      NameNumber added{.text = std::to_string(row)};
      added.value = row;
      image.numbers.insert(image.numbers.begin() + number, std::move(added));
      whole.images.push_back(std::move(image));
    }
  }
  return whole;
}

}  // namespace

void join_lettered_rows(std::vector<NameGroup>& groups) {
  std::map<Lettered, Rows> candidates;
  for (const NameGroup& group : groups) {
    for (const std::size_t place : lonely_letters(group.skeleton)) {
      std::string rest = group.skeleton;
      const char letter = std::exchange(rest[place], '?');
      candidates[{std::move(rest), place}][letter] = &group;
    }
  }
  const auto found = std::ranges::find_if(
      candidates, [](const auto& candidate) { return are_rows(candidate.second); });
  if (found == candidates.end()) return;
  NameGroup whole = joined(found->second, found->first.place);
  if (find_index_fields(whole).form != IndexFields::Form::Grid) return;
  const std::string rest = found->first.rest;
  std::erase_if(groups, [&, place = found->first.place](NameGroup& group) {
    if (group.skeleton.size() != rest.size()) return false;
    std::string other = group.skeleton;
    other[place] = '?';
    return other == rest && group.skeleton[place] != kNumberMark;
  });
  groups.insert(groups.begin(), std::move(whole));
}

std::optional<std::vector<fs::path>> by_letter(std::vector<fs::path> folders) {
  if (folders.empty()) return std::nullopt;
  std::ranges::sort(folders);
  std::vector<char> letters;
  for (const fs::path& folder : folders) {
    const std::string name = folder.filename().string();
    if (name.size() != 1) return std::nullopt;
    letters.push_back(name.front());
  }
  return run_from_a(letters) ? std::optional(std::move(folders)) : std::nullopt;
}

}  // namespace episcope::io
