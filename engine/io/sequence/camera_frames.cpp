// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/sequence/camera_frames.h"

#include "engine/io/grid/image_list.h"
#include "engine/io/grid/index_fields.h"
#include "engine/io/grid/joined_digits.h"
#include "engine/io/grid/name_words.h"

#include <map>
#include <optional>

namespace episcope::io {
namespace {

constexpr std::size_t kFewestViews = 3;

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

}  // namespace

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
    if (frame.images.size() != count || count < kFewestViews || !tells_views) return {};
    found.numbers.push_back(number);
    found.patterns.push_back(pattern_text(frame, fields));
  }
  return found;
}

}  // namespace episcope::io
