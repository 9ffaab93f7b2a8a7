// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/sequence_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/names/index_fields.h"
#include "engine/io/models/names/view_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct NumberedFolder {
  fs::path path;
  std::string before;  ///< Of the number, in the name.
  std::string after;
  long number = 0;
};

/// A name with one number; none if it has no number, several, or one of too many digits.
std::optional<NumberedFolder> numbered(const fs::path& path) {
  constexpr std::size_t most_digits = 9;
  const std::string name = path.filename().string();
  const auto begin = std::find_if(name.begin(), name.end(), is_digit);
  const auto end = std::find_if_not(begin, name.end(), is_digit);
  // The 5 of ".h5" is no number of a name.
  const auto stem_end = name.begin() + static_cast<std::ptrdiff_t>(path.stem().string().size());
  if (begin >= stem_end || std::any_of(end, stem_end, is_digit)) return std::nullopt;
  const std::string digits(begin, end);
  if (digits.size() > most_digits) return std::nullopt;
  return NumberedFolder{path, std::string(name.begin(), begin), std::string(end, name.end()),
                        std::stol(digits)};
}

/// The letters around the number.
std::string word_of(const NumberedFolder& one) {
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
  std::vector<NumberedFolder> frames;
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
  std::ranges::sort(frames, {}, &NumberedFolder::number);
  if (std::ranges::adjacent_find(frames, {}, &NumberedFolder::number) != frames.end()) return {};
  NumberedFrames found;
  for (NumberedFolder& one : frames) {
    found.paths.push_back(std::move(one.path));
    found.numbers.push_back(one.number);
  }
  return found;
}

NumberedFrames numbered_images(const fs::path& folder) {
  return frames_among(list_images(folder), Others::LeftOut);
}

/// Light fields that follow each other in time, all views of which lie in one folder.
struct CameraFrames {
  std::vector<long> numbers{};          ///< In names, ascending; empty = there are none.
  std::vector<std::string> patterns{};  ///< Of the names of each frame: "cam{index}_frame003.png".
};

constexpr std::size_t kFewestFrameViews = 3;

/// The number that counts frames; nothing if there is none, or several.
std::optional<std::size_t> frame_field(const NameGroup& group) {
  const NameWords words(group.skeleton);
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < group.images.front().numbers.size(); ++i) {
    if (!words.is_other_count(i)) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

/// By the number of their frame; empty if that is none.
std::map<long, NameGroup> by_frame(const NameGroup& group, std::size_t field) {
  std::map<long, NameGroup> frames;
  for (const NumberedImage& image : group.images) {
    const auto number = image.numbers[field].count();
    if (!number) return {};
    NameGroup& frame = frames[static_cast<long>(*number)];
    frame.skeleton = group.skeleton;
    frame.images.push_back(image);
  }
  return frames;
}

/// The frames of a folder of images whose names have a number that a word calls that of a frame
/// (`NameWords::is_other_count`), and others that tell the views of a frame apart: two frames or
/// more, of as many views each. Looks at names only.
CameraFrames find_camera_frames(const std::filesystem::path& folder) {
  const std::vector<NameGroup> groups = group_by_name(list_images(folder));
  if (groups.empty()) return {};
  const auto field = frame_field(groups.front());
  if (!field) return {};
  std::map<long, NameGroup> frames = by_frame(groups.front(), *field);
  if (frames.size() < 2) return {};
  const std::size_t count = frames.begin()->second.images.size();
  CameraFrames found;
  for (auto& [number, frame] : frames) {
    separate_joined_digits(frame);
    const IndexFields fields = find_index_fields(frame);
    const bool tells_views =
        fields.form == IndexFields::Form::Grid || fields.form == IndexFields::Form::List;
    if (frame.images.size() != count || count < kFewestFrameViews || !tells_views) return {};
    found.numbers.push_back(number);
    found.patterns.push_back(pattern_text(frame, fields));
  }
  return found;
}

std::vector<fs::path> names_of(const std::vector<fs::path>& images) {
  std::vector<fs::path> names;
  for (const fs::path& image : images) names.push_back(image.filename());
  return names;
}

/// The frames of a folder that holds a folder for each camera, with a picture for each frame in it:
/// "cam_04/0001.png", "03_04/frame_7.png". Pictures are called the same in all of them, by a
/// running number alone or after a word for time; folders have the numbers of rows and columns, or
/// one after a word for a view or a camera. Looks at names only.
CameraFrames find_camera_folders(const fs::path& folder) {
  constexpr std::size_t kFewestFolders = 4;
  const std::vector<fs::path> folders = list_folders(folder);
  if (folders.size() < kFewestFolders || count_images(folder) > 0) return {};
  const NumberedFrames frames = numbered_images(folders.front());
  const std::vector<fs::path> images = list_images(folders.front());
  if (frames.paths.empty() || frames.paths.size() != images.size()) return {};
  const std::vector<fs::path> names = names_of(images);
  for (const fs::path& other : folders) {
    if (names_of(list_images(other)) != names) return {};
  }
  CameraFrames found;
  for (std::size_t i = 0; i < frames.paths.size(); ++i) {
    const auto views = find_folders_with(folder, frames.paths[i].filename().string());
    if (!views) return {};
    found.numbers.push_back(frames.numbers[i]);
    found.patterns.push_back(views->pattern);
  }
  return found;
}

/// A light field of a sequence: a folder or a file, or the images of a folder that fit a pattern.
struct Frame {
  fs::path path;
  std::string pattern{};
  long number = 0;

  /// How to open it alone.
  [[nodiscard]] OpenOptions options(const OpenOptions& of_sequence) const {
    OpenOptions single = of_sequence;
    single.frame = 0;
    if (!pattern.empty()) single.pattern = pattern;
    return single;
  }
  /// What it is called: that of the images of a folder exists as a name only.
  [[nodiscard]] fs::path name() const {
    return pattern.empty() ? path : path / fmt::format("frame_{}", number);
  }
};

std::vector<Frame> frames_of(const fs::path& folder) {
  std::vector<Frame> frames;
  const NumberedFrames named = numbered_frames(folder);
  for (std::size_t i = 0; i < named.paths.size(); ++i) {
    frames.push_back({named.paths[i], {}, named.numbers[i]});
  }
  if (!frames.empty()) return frames;
  CameraFrames cameras = find_camera_frames(folder);
  if (cameras.numbers.empty()) cameras = find_camera_folders(folder);
  for (std::size_t i = 0; i < cameras.numbers.size(); ++i) {
    frames.push_back({folder, cameras.patterns[i], cameras.numbers[i]});
  }
  return frames;
}

/// The reader of a frame, if it is a light field of its own.
FoundReader reader_of_frame(const Frame& frame, const OpenOptions& of_sequence) {
  const OpenOptions options = frame.options(of_sequence);
  for (const Reader& reader : readers()) {
    if (reader.id == std::string_view(kSequenceReader)) continue;
    fs::path found = reader.find(frame.path, options);
    if (found.empty()) continue;
    const bool is_own = found == frame.path || fs::is_directory(frame.path);
    return is_own ? FoundReader{&reader, std::move(found)} : FoundReader();
  }
  return {};
}

SceneProbe probe_of(const Frame& frame, const FoundReader& found, const OpenOptions& options) {
  return found.reader->probe ? found.reader->probe(found.path, frame.options(options))
                             : SceneProbe();
}

bool have_same_shape(const SceneProbe& a, const SceneProbe& b) {
  return a.grid == b.grid && a.list == b.list && a.height == b.height && a.width == b.width &&
         a.channels == b.channels;
}

/// Whether the first, the middle and the last frame are light fields of one form and shape: looking
/// at all of them would make the search for a reader slow.
bool are_frames(const std::vector<Frame>& frames, const OpenOptions& options) {
  const FoundReader first = reader_of_frame(frames.front(), options);
  if (!first.reader) return false;
  const SceneProbe probe = probe_of(frames.front(), first, options);
  for (const std::size_t i : {frames.size() / 2, frames.size() - 1}) {
    const FoundReader other = reader_of_frame(frames[i], options);
    if (other.reader != first.reader) return false;
    if (!have_same_shape(probe_of(frames[i], other, options), probe)) return false;
  }
  return true;
}

fs::path find_sequence(const fs::path& path, const OpenOptions& options) {
  std::error_code error;
  if (!fs::is_directory(path, error) || is_there(path / "lf.h5")) return {};
  if (!options.pattern.empty() && count_images(path) > 0) return {};
  if (!options.pattern.empty() && find_view_folders(path, options.pattern)) return {};
  const std::vector<Frame> frames = frames_of(path);
  if (frames.empty() || find_row_folders(path, options)) return {};
  try {
    return are_frames(frames, options) ? path : fs::path();
  } catch (const Error&) {
    return {};  // Frames that cannot be read: the others of a collection still can.
  }
}

/// Throws InvalidInput if there is no such frame.
const Frame& chosen_frame(const std::vector<Frame>& frames, int frame, const fs::path& folder) {
  const auto count = frames.size();
  if (frame >= 0 && static_cast<std::size_t>(frame) < count) {
    return frames[static_cast<std::size_t>(frame)];
  }
  throw InvalidInput(
      fmt::format("{} has {} frames, but frame {} was asked for; name one from 0 to "
                  "{} with --frame",
                  folder.string(), count, frame, count - 1));
}

void report_frames(const std::vector<Frame>& frames, const OpenOptions& options, Scene& scene) {
  scene.sequence = {options.frame, static_cast<int>(frames.size())};
  const fs::path name = frames[static_cast<std::size_t>(options.frame)].name();
  scene.convention.format =
      fmt::format("sequence, {}: {}", name.filename().string(), scene.convention.format);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const long step = frames[1].number - frames[0].number;
    if (frames[i].number - frames[i - 1].number <= step) continue;
    scene.convention.warnings.push_back(
        fmt::format(finding_text("frames.gap"), frames[i - 1].number + step));
    break;
  }
}

/// What is told of a frame: its light field opens by the folder of the sequence.
LightFieldInfo info_in_sequence(LightFieldInfo info, const fs::path& folder,
                                const OpenOptions& options) {
  info.name = scene_name(folder);
  info.source = folder.string();
  info.reading = {kSequenceReader, given_options(options)};
  info.reading.set_focus(0);  // baked in afterwards, if at all
  return info;
}

Scene read_sequence(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  const std::vector<Frame> frames = frames_of(folder);
  const Frame& frame = chosen_frame(frames, options.frame, folder);
  const FoundReader found = reader_of_frame(frame, options);
  if (!found.reader) {
    throw IoError(frame.path, "this frame is not a light field; restore or remove it");
  }
  OpenOptions single = frame.options(options);
  if (options.on_center_view) {
    single.on_center_view = [&](const Image<std::uint8_t>& center, const LightFieldInfo& info,
                                GridShape grid) {
      options.on_center_view(center, info_in_sequence(info, folder, options), grid);
    };
  }
  Scene scene = found.reader->read(found.path, single, progress);
  // Nobody else has seen the light field yet, and a copy would double the memory.
  auto& own = const_cast<LightField&>(*scene.light_field);
  LightFieldInfo info = info_in_sequence(own.info(), folder, options);
  scene.light_field = std::make_shared<const LightField>(std::move(own), std::move(info));
  report_frames(frames, options, scene);
  return scene;
}

SceneProbe probe_sequence(const fs::path& folder, const OpenOptions& options) {
  const std::vector<Frame> frames = frames_of(folder);
  const FoundReader first = reader_of_frame(frames.front(), options);
  SceneProbe probe = probe_of(frames.front(), first, options);
  probe.frames = static_cast<int>(frames.size());
  return probe;
}

/// A frame may be of any form, and so know any option.
std::span<const char* const> all_options() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const auto& option : open_schema().descriptions()) {
      if (option.key != Reading::kFocus) all.push_back(option.key);
    }
    return all;
  }();
  static const std::vector<const char*> names = [] {
    std::vector<const char*> all;
    for (const std::string& key : keys) all.push_back(key.c_str());
    return all;
  }();
  return names;
}

}  // namespace

NumberedFrames numbered_frames(const fs::path& folder) {
  const std::vector<fs::path> folders = listed(folder, true);
  if (!folders.empty()) return frames_among(folders, Others::Refused);
  return frames_among(listed(folder, false), Others::LeftOut);
}

fs::path frame_path(const LightFieldInfo& info) {
  if (info.reading.reader != kSequenceReader || !fs::is_directory(info.source)) return {};
  const std::vector<Frame> frames = frames_of(info.source);
  const OpenOptions options = open_schema().parse(info.reading.options);
  const auto frame = static_cast<std::size_t>(options.frame);
  return frame < frames.size() ? frames[frame].name() : fs::path();
}

Reader sequence_reader() {
  return {.id = kSequenceReader,
          .name = "a sequence of light fields",
          .options = all_options(),
          .find = find_sequence,
          .read = read_sequence,
          .probe = probe_sequence};
}

}  // namespace episcope::io
