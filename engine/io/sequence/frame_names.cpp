// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/sequence/frame_names.h"

#include "engine/core/text/suffix.h"
#include "engine/io/grid/image_list.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct Numbered {
  fs::path path;
  std::string before;  ///< Of the number, in the name.
  std::string after;
  long number = 0;
};

/// A name with one number; none if it has no number, several, or one of too many digits.
std::optional<Numbered> numbered(const fs::path& path) {
  constexpr std::size_t most_digits = 9;
  const std::string name = path.filename().string();
  const auto begin = std::find_if(name.begin(), name.end(), is_digit);
  const auto end = std::find_if_not(begin, name.end(), is_digit);
  // The 5 of ".h5" is no number of a name.
  const auto stem_end = name.begin() + static_cast<std::ptrdiff_t>(path.stem().string().size());
  if (begin >= stem_end || std::any_of(end, stem_end, is_digit)) return std::nullopt;
  const std::string digits(begin, end);
  if (digits.size() > most_digits) return std::nullopt;
  return Numbered{path, std::string(name.begin(), begin), std::string(end, name.end()),
                  std::stol(digits)};
}

/// The letters around the number.
std::string word_of(const Numbered& one) {
  std::string letters;
  for (const char c :
       one.before + one.after.substr(0, one.after.size() - suffix_of(one.path).size())) {
    const bool is_mark = c == '_' || c == '-' || c == '.' || c == ' ' || c == '=';
    if (!is_mark) letters += c;
  }
  return lower_case(letters);
}

bool speaks_of_time(const std::string& word) {
  constexpr std::array words{"f", "fr", "frame", "frames", "t", "time", "timestep", "step"};
  return std::ranges::find(words, word) != words.end();
}

std::vector<fs::path> listed(const fs::path& folder, bool is_folder_wanted) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code error;
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    const bool is_wanted =
        is_folder_wanted ? entry.is_directory(error) : entry.is_regular_file(error);
    if (!is_hidden && is_wanted) paths.push_back(entry.path());
  }
  return paths;
}

enum class Others { Refused, LeftOut };

/// All that are numbered, if they are of one pattern.
NumberedFrames frames_among(const std::vector<fs::path>& paths, Others others) {
  std::vector<Numbered> frames;
  for (const fs::path& path : paths) {
    auto one = numbered(path);
    if (!one) continue;
    const std::string word = word_of(*one);
    if (!word.empty() && !speaks_of_time(word) && others == Others::LeftOut) continue;
    if (!frames.empty() &&
        (one->before != frames.front().before || one->after != frames.front().after)) {
      return {};
    }
    frames.push_back(std::move(*one));
  }
  if (frames.size() < 2) return {};
  const std::string word = word_of(frames.front());
  const bool has_others = frames.size() < paths.size();
  if (word.empty() ? has_others && others == Others::Refused : !speaks_of_time(word)) {
    return {};
  }
  std::ranges::sort(frames, {}, &Numbered::number);
  if (std::ranges::adjacent_find(frames, {}, &Numbered::number) != frames.end()) return {};
  NumberedFrames found;
  for (Numbered& one : frames) {
    found.paths.push_back(std::move(one.path));
    found.numbers.push_back(one.number);
  }
  return found;
}

}  // namespace

NumberedFrames numbered_frames(const fs::path& folder) {
  const std::vector<fs::path> folders = listed(folder, true);
  if (!folders.empty()) return frames_among(folders, Others::Refused);
  return frames_among(listed(folder, false), Others::LeftOut);
}

NumberedFrames numbered_images(const fs::path& folder) {
  return frames_among(list_images(folder), Others::LeftOut);
}

}  // namespace episcope::io
