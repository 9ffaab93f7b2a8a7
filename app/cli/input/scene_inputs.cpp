// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/input/scene_inputs.h"

#include "app/session/scene/builtin_inputs.h"
#include "app/session/scene/collections.h"
#include "app/session/scene/load_scene.h"
#include "engine/core/error.h"
#include "engine/io/open/reader.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/sequence/sequence_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace episcope::cli {
namespace {

std::vector<io::CollectionEntry> entries_at(const std::string& input, const ReadOptions& options,
                                            const Progress& progress) {
  const io::OpenOptions open = io::open_schema().parse(options.options.values());
  return collection_at(input, open, default_cache_folder(), progress);
}

/// How many frames an INPUT has; 0 if it is no sequence.
int frames_of(const std::string& input, const io::OpenOptions& options) {
  if (reader_of(input, options) != io::kSequenceReader) return 0;
  const io::FoundReader found = io::find_reader(input, options);
  return found.reader->probe(found.path, options).frames;
}

/// An INPUT that stands for itself.
io::CollectionEntry single(const std::string& input, const io::OpenOptions& options) {
  const std::string builtin = builtin_scene_id(input);
  return {.path = input,
          .name = builtin.empty() ? io::scene_name(input) : builtin_input_name(builtin),
          .reader = {},
          .probe = {.frames = frames_of(input, options)}};
}

void add_frames(const io::CollectionEntry& entry, const std::string& name,
                std::vector<SceneInput>& scenes) {
  const auto digits = std::to_string(entry.probe.frames - 1).size();
  for (int frame = 0; frame < entry.probe.frames; ++frame) {
    scenes.push_back(
        {entry.path.string(), fmt::format("{}_frame_{:0{}}", name, frame, digits), frame});
  }
}

/// What an INPUT stands for.
std::vector<io::CollectionEntry> entries_of(const std::string& input, const ReadOptions& options,
                                            const Progress& progress) {
  check_input(input);
  std::vector<io::CollectionEntry> entries = entries_at(input, options, progress);
  if (entries.empty()) {
    entries.push_back(single(input, io::open_schema().parse(options.options.values())));
  }
  return entries;
}

std::vector<SceneInput> named(const std::vector<io::CollectionEntry>& all, Frames frames) {
  const std::vector<std::string> names = unique_names(all);
  std::vector<SceneInput> scenes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (frames == Frames::All && all[i].probe.frames > 0) {
      add_frames(all[i], names[i], scenes);
    } else {
      scenes.push_back({all[i].path.string(), names[i]});
    }
  }
  return scenes;
}

}  // namespace

std::vector<SceneInput> scene_inputs(const std::vector<std::string>& inputs,
                                     const ReadOptions& options, Frames frames,
                                     const Progress& progress) {
  std::vector<io::CollectionEntry> all;
  for (const std::string& input : inputs) {
    std::ranges::move(entries_of(input, options, progress), std::back_inserter(all));
  }
  return named(all, frames);
}

std::vector<SceneInput> scene_inputs_and_failed(const std::vector<std::string>& inputs,
                                                const ReadOptions& options, Frames frames,
                                                const Progress& progress) {
  std::vector<io::CollectionEntry> all;
  for (const std::string& input : inputs) {
    try {
      std::ranges::move(entries_of(input, options, progress), std::back_inserter(all));
    } catch (const IoError&) {
      all.push_back({.path = input, .name = io::scene_name(input), .reader = {}, .probe = {}});
    }
  }
  return named(all, frames);
}

bool is_collection(const std::string& input, const ReadOptions& options, const Progress& progress) {
  return !entries_at(input, options, progress).empty();
}

}  // namespace episcope::cli
