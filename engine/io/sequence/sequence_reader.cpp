// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/sequence/sequence_reader.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/row_folders.h"
#include "engine/io/grid/view_folders.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/sequence/camera_folders.h"
#include "engine/io/sequence/camera_frames.h"
#include "engine/io/sequence/frame_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

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
        fmt::format("The frame number {} is missing; frames are counted without it.",
                    frames[i - 1].number + step));
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
