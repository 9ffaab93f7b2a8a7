// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_group.h"

#include "engine/io/archive/archive_layout.h"

#include <vector>

namespace episcope::io {
namespace {

bool has_archive_form(const Hdf5Dataset& dataset) {
  const std::size_t axes = dataset.shape.size();
  if (dataset.type == Hdf5Type::Other || axes < 4 || axes > 5) return false;
  const std::size_t last = dataset.shape.back();
  return axes == 4 || last == 1 || last == 3 || last == 4;
}

bool has_depth(const Hdf5Input& file, const std::string& group) {
  return file.has(group + "/GT_DEPTH") ||
         (file.has(group + "/GT_DEPTH_FOREGROUND") && file.has(group + "/GT_DEPTH_BACKGROUND"));
}

}  // namespace

std::string archive_group(const Hdf5Input& file) {
  if (file.has(kArchiveLightField)) return {};
  const std::string end = std::string("/") + kArchiveLightField;
  std::vector<std::string> groups;
  for (const Hdf5Dataset& dataset : file.datasets()) {
    if (!dataset.name.ends_with(end) || !has_archive_form(dataset)) continue;
    groups.push_back(dataset.name.substr(0, dataset.name.size() - end.size()));
  }
  const bool is_one = groups.size() == 1 && has_depth(file, groups.front());
  return is_one ? groups.front() : std::string();
}

std::shared_ptr<const Hdf5Input> open_archive(const std::filesystem::path& path) {
  auto file = std::make_shared<const Hdf5Input>(path);
  const std::string group = archive_group(*file);
  return group.empty() ? file : std::make_shared<const Hdf5Input>(path, group);
}

}  // namespace episcope::io
