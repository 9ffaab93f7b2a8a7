// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/sequence/sequence_reader.h"

#include "engine/core/error.h"
#include "engine/io/grid/row_folders.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/sequence/frame_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// The reader of a frame, if it is a light field of its own.
FoundReader reader_of_frame(const fs::path& frame, const OpenOptions& options) {
  for (const Reader& reader : readers()) {
    if (reader.id == std::string_view(kSequenceReader)) continue;
    fs::path found = reader.find(frame, options);
    if (found.empty()) continue;
    const bool is_own = found == frame || fs::is_directory(frame);
    return is_own ? FoundReader{&reader, std::move(found)} : FoundReader();
  }
  return {};
}

SceneProbe probe_of(const FoundReader& frame, const OpenOptions& options) {
  return frame.reader->probe ? frame.reader->probe(frame.path, options) : SceneProbe();
}

bool have_same_shape(const SceneProbe& a, const SceneProbe& b) {
  return a.grid == b.grid && a.list == b.list && a.height == b.height && a.width == b.width &&
         a.channels == b.channels;
}

/// Whether the first, the middle and the last frame are light fields of one form and shape: looking
/// at all of them would make the search for a reader slow.
bool are_frames(const NumberedFrames& frames, const OpenOptions& options) {
  const FoundReader first = reader_of_frame(frames.paths.front(), options);
  if (!first.reader) return false;
  const SceneProbe probe = probe_of(first, options);
  for (const std::size_t i : {frames.paths.size() / 2, frames.paths.size() - 1}) {
    const FoundReader other = reader_of_frame(frames.paths[i], options);
    if (other.reader != first.reader) return false;
    if (!have_same_shape(probe_of(other, options), probe)) return false;
  }
  return true;
}

fs::path find_sequence(const fs::path& path, const OpenOptions& options) {
  std::error_code error;
  if (!fs::is_directory(path, error) || is_there(path / "lf.h5")) return {};
  const NumberedFrames frames = numbered_frames(path);
  if (frames.paths.empty() || find_row_folders(path, options)) return {};
  try {
    return are_frames(frames, options) ? path : fs::path();
  } catch (const Error&) {
    return {};  // Frames that cannot be read: the others of a collection still can.
  }
}

/// Throws InvalidInput if there is no such frame.
const fs::path& chosen_frame(const NumberedFrames& frames, int frame, const fs::path& folder) {
  const auto count = frames.paths.size();
  if (frame >= 0 && static_cast<std::size_t>(frame) < count) {
    return frames.paths[static_cast<std::size_t>(frame)];
  }
  throw InvalidInput(
      fmt::format("{} has {} frames, but frame {} was asked for; name one from 0 to "
                  "{} with --frame",
                  folder.string(), count, frame, count - 1));
}

void report_frames(const NumberedFrames& frames, const OpenOptions& options, Scene& scene) {
  scene.sequence = {options.frame, static_cast<int>(frames.paths.size())};
  const fs::path& path = frames.paths[static_cast<std::size_t>(options.frame)];
  scene.convention.format =
      fmt::format("sequence, {}: {}", path.filename().string(), scene.convention.format);
  for (std::size_t i = 1; i < frames.numbers.size(); ++i) {
    const long step = frames.numbers[1] - frames.numbers[0];
    if (frames.numbers[i] - frames.numbers[i - 1] <= step) continue;
    scene.convention.warnings.push_back(
        fmt::format("The frame number {} is missing; frames are counted without it.",
                    frames.numbers[i - 1] + step));
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
  const NumberedFrames frames = numbered_frames(folder);
  const FoundReader found = reader_of_frame(chosen_frame(frames, options.frame, folder), options);
  if (!found.reader) {
    throw IoError(frames.paths[static_cast<std::size_t>(options.frame)],
                  "this frame is not a light field; restore or remove it");
  }
  OpenOptions single = options;
  single.frame = 0;
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
  const NumberedFrames frames = numbered_frames(folder);
  const FoundReader first = reader_of_frame(frames.paths.front(), options);
  SceneProbe probe = probe_of(first, options);
  probe.frames = static_cast<int>(frames.paths.size());
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
  const NumberedFrames frames = numbered_frames(info.source);
  const OpenOptions options = open_schema().parse(info.reading.options);
  const auto frame = static_cast<std::size_t>(options.frame);
  return frame < frames.paths.size() ? frames.paths[frame] : fs::path();
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
