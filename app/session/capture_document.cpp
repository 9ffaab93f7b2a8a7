// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture_document.h"

#include "app/session/user_folders.h"
#include "engine/core/text.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace episcope {
namespace {

std::size_t bytes_of(const CaptureWork& work) {
  std::size_t bytes = sizeof(CaptureWork);
  if (work.lens) bytes += work.lens->photographs.size() * sizeof(CalibratedPhotograph);
  for (const CaptureObject& object : work.objects) {
    bytes += sizeof(CaptureObject) + object.pairs.size() * sizeof(capture::PointPair);
    if (object.pose) bytes += object.pose->pairs.size() * sizeof(capture::PairResidual);
  }
  return bytes;
}

template <class Named>
bool is_taken(const std::vector<Named>& all, const std::string& name) {
  return std::ranges::find(all, name, &Named::name) != all.end();
}

/// `stem`, with a number where that is empty or taken.
template <class Named>
std::string free_name(const std::vector<Named>& all, const std::string& stem) {
  if (!stem.empty()) {
    return unique_name(stem, " ", [&](const std::string& name) { return is_taken(all, name); });
  }
  int number = 1;
  while (is_taken(all, std::to_string(number))) ++number;
  return std::to_string(number);
}

CaptureObject new_object(const CaptureWork& work, const std::string& mesh) {
  return {.name = free_name(work.objects, std::filesystem::path(mesh).stem().string()),
          .mesh = mesh};
}

}  // namespace

std::size_t CaptureEdit::byte_size() const {
  return bytes_of(before) + bytes_of(after);
}

CaptureDocument::CaptureDocument(CaptureWork work) : work_(std::move(work)) {
  if (!work_.object()) work_.current = 0;
}

const std::vector<capture::PointPair>& CaptureDocument::pairs() const {
  static const std::vector<capture::PointPair> kNone;
  const CaptureObject* object = work_.object();
  return object ? object->pairs : kNone;
}

void CaptureDocument::edit(const std::function<void(CaptureWork&)>& change) {
  CaptureWork changed = work_;
  change(changed);
  if (changed == work_) return;
  history_.push({work_, changed});
  work_ = std::move(changed);
}

void CaptureDocument::edit_object(const std::function<void(CaptureObject&)>& change) {
  edit([&](CaptureWork& work) {
    if (!work.object()) {
      work.objects.push_back(new_object(work, {}));
      work.current = static_cast<int>(work.objects.size()) - 1;
    }
    change(work.objects[static_cast<std::size_t>(work.current)]);
  });
}

void CaptureDocument::set_lens(CaptureLens lens, const capture::Pattern& pattern) {
  edit([&](CaptureWork& work) {
    work.lens = std::move(lens);
    work.pattern = pattern;
  });
}

void CaptureDocument::set_rectify(const capture::RectifyOptions& options) {
  edit([&](CaptureWork& work) { work.rectify = options; });
}

void CaptureDocument::add_object(const std::string& mesh) {
  edit([&](CaptureWork& work) {
    work.objects.push_back(new_object(work, mesh));
    work.current = static_cast<int>(work.objects.size()) - 1;
  });
}

void CaptureDocument::remove_object() {
  edit([](CaptureWork& work) {
    if (!work.object()) return;
    work.objects.erase(work.objects.begin() + work.current);
    work.current = std::max(0, std::min(work.current, static_cast<int>(work.objects.size()) - 1));
  });
}

void CaptureDocument::rename_object(const std::string& name) {
  if (!work_.object() || name.empty() || is_taken(work_.objects, name)) return;
  edit_object([&](CaptureObject& object) { object.name = name; });
}

void CaptureDocument::choose(int object) {
  if (object >= 0 && object < static_cast<int>(work_.objects.size())) work_.current = object;
}

void CaptureDocument::set_mesh(const std::string& file) {
  if (!work_.object()) return add_object(file);
  edit([&](CaptureWork& work) {
    CaptureObject& object = work.objects[static_cast<std::size_t>(work.current)];
    object.mesh = file;
  });
}

void CaptureDocument::add_pairs(std::vector<capture::PointPair> pairs) {
  if (pairs.empty()) return;
  edit_object([&](CaptureObject& object) {
    for (capture::PointPair& pair : pairs) {
      pair.name = free_name(object.pairs, pair.name);
      object.pairs.push_back(std::move(pair));
    }
  });
}

void CaptureDocument::remove_pairs(const std::vector<int>& places) {
  edit_object([&](CaptureObject& object) {
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      if (!object.pairs[*place].is_locked) object.pairs.erase(object.pairs.begin() + *place);
    }
  });
}

void CaptureDocument::lock_pair(int place, bool is_locked) {
  edit_object([&](CaptureObject& object) { object.pairs[place].is_locked = is_locked; });
}

void CaptureDocument::rename_pair(int place, const std::string& name) {
  if (name.empty() || is_taken(pairs(), name) || name.find_first_of(",\n\r") != std::string::npos) {
    return;
  }
  edit_object([&](CaptureObject& object) { object.pairs[place].name = name; });
}

void CaptureDocument::undo() {
  if (!history_.next_undo()) return;
  work_ = history_.next_undo()->before;
  history_.undo();
}

void CaptureDocument::redo() {
  if (!history_.next_redo()) return;
  work_ = history_.next_redo()->after;
  history_.redo();
}

}  // namespace episcope
