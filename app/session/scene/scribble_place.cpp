// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/scribble_place.h"

#include "engine/core/error.h"
#include "engine/io/archive/archive_reader.h"
#include "engine/io/labels/scribble_file.h"
#include "engine/io/sequence/sequence_reader.h"

#include <unistd.h>

namespace episcope {

namespace fs = std::filesystem;

fs::path label_place(const LightField& light_field) {
  const fs::path source = light_field.info().source;
  std::error_code ignored;
  if (const fs::path frame = io::frame_path(light_field.info()); !frame.empty()) {
    return fs::is_directory(frame, ignored) ? frame / "labels.h5"
                                            : source / ("labels_" + frame.stem().string() + ".h5");
  }
  if (fs::is_directory(source, ignored)) return source / "labels.h5";
  if (!fs::is_regular_file(source, ignored)) return {};
  const bool is_archive = light_field.info().reading.reader == io::kArchiveReader;
  // Several light fields of other forms may share a folder.
  const int frame = io::open_schema().parse(light_field.info().reading.options).frame;
  std::string stem = source.stem().string();
  if (frame > 0) stem.append("_").append(std::to_string(frame));  // one of several in the file
  const std::string name = is_archive ? "labels.h5" : stem + "_labels.h5";
  return source.parent_path() / name;
}

bool is_writable(const fs::path& path) {
  // Files are replaced, so the folder decides too.
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return false;
  return ::access(path.c_str(), F_OK) != 0 || ::access(path.c_str(), W_OK) == 0;
}

void read_kept_scribbles(Scene& scene, const Progress& progress) {
  const fs::path place = label_place(*scene.light_field);
  std::error_code ignored;
  // Readers of the archive look there themselves.
  const LightFieldInfo& info = scene.light_field->info();
  const fs::path frame = io::frame_path(info);
  const bool is_known = info.reading.reader == io::kArchiveReader ||
                        (!frame.empty() && fs::exists(frame / "lf.h5", ignored));
  if (is_known || !fs::exists(place, ignored)) return;
  try {
    scene.scribbles = io::read_scribbles(place, scene, progress);
  } catch (const IoError& error) {
    scene.convention.warnings.push_back(std::string("Scribbles were not read: ") + error.what());
  }
}

}  // namespace episcope
