// SPDX-License-Identifier: BSD-3-Clause
#include "app/texts/sentences.h"

#include "engine/core/error.h"

#include <fstream>
#include <iterator>
#include <regex>

namespace episcope {
namespace {

bool is_source(const std::filesystem::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".cu";
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw IoError(path, "cannot be read");
  return text;
}

}  // namespace

std::set<std::string> literal_sentences(const std::filesystem::path& folder) {
  static const std::regex sentence(
      R"re((?:[.]step\(|[.](?:step|why_not|format|order|order_check|sign_check|units|units_check|gain) = ))re"
      R"re("((?:[^"\\]|\\.)*)"[;)])re");
  std::set<std::string> sentences;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!is_source(entry.path())) continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), sentence), end; match != end;
         ++match) {
      sentences.insert((*match)[1]);
    }
  }
  return sentences;
}

}  // namespace episcope
