// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/finding.h"

#include <cstddef>
#include <span>
#include <utility>

namespace episcope {
namespace {

// The parts around the placeholders; one more than there are placeholders.
std::vector<std::string_view> literal_parts(std::string_view english) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t open = english.find('{', begin);
    parts.push_back(english.substr(begin, open - begin));
    if (open == std::string_view::npos) return parts;
    begin = english.find('}', open) + 1;
  }
}

using Parts = std::span<const std::string_view>;

// Whether `sentence`, which begins with a value, is values between the parts that are left; adds
// the values.
bool take_values(std::string_view sentence, Parts parts, std::vector<std::string>& values) {
  if (parts.empty()) return sentence.empty();
  const bool is_last = parts.size() == 1;
  for (std::size_t at = 0; at <= sentence.size(); ++at) {
    if (is_last) {
      if (!sentence.ends_with(parts[0]) || sentence.size() < parts[0].size()) return false;
      at = sentence.size() - parts[0].size();
    } else {
      at = sentence.find(parts[0], at);
    }
    if (at == std::string_view::npos) return false;
    values.emplace_back(sentence.substr(0, at));
    if (take_values(sentence.substr(at + parts[0].size()), parts.subspan(1), values)) return true;
    values.pop_back();
    if (is_last) return false;
  }
  return false;
}

struct Template {
  std::string_view code;
  std::vector<std::string_view> parts;
};

std::optional<Finding> match(std::string_view sentence, const Template& text) {
  const Parts parts(text.parts);
  if (!sentence.starts_with(parts[0])) return std::nullopt;
  sentence.remove_prefix(parts[0].size());
  Finding finding{std::string(text.code), {}};
  if (!take_values(sentence, parts.subspan(1), finding.values)) return std::nullopt;
  return finding;
}

// How much a sentence says that it is: whether it begins with words, then how long its words are.
std::pair<bool, std::size_t> distinctness(const Template& text) {
  std::size_t length = 0;
  for (const std::string_view part : text.parts) length += part.size();
  return {!text.parts[0].empty(), length};
}

// The most special first, else in the order of the table.
const std::vector<Template>& templates() {
  static const std::vector<Template> sorted = [] {
    std::vector<Template> all;
    for (const FindingText& text : kFindingTexts) {
      all.push_back({text.code, literal_parts(text.english)});
    }
    std::ranges::stable_sort(all, std::ranges::greater(), distinctness);
    return all;
  }();
  return sorted;
}

}  // namespace

std::string numbered(std::string_view english) {
  const std::vector<std::string_view> parts = literal_parts(english);
  std::string text(parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    text += '%' + std::to_string(i);
    text += parts[i];
  }
  return text;
}

const FindingText* find_finding_text(std::string_view code) {
  const auto* found = std::ranges::find(kFindingTexts, code, &FindingText::code);
  return found == kFindingTexts.end() ? nullptr : found;
}

std::optional<Finding> finding_of(std::string_view sentence) {
  for (const Template& text : templates()) {
    if (auto found = match(sentence, text)) return found;
  }
  return std::nullopt;
}

bool is_note(std::string_view sentence) {
  const auto finding = finding_of(sentence);
  return finding && find_finding_text(finding->code)->level == FindingLevel::Note;
}

}  // namespace episcope
