// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/label_list.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"

#include <algorithm>
#include <sstream>

namespace episcope::io {

namespace fs = std::filesystem;

std::vector<fs::path> label_files_of(const fs::path& file) {
  std::vector<fs::path> files;
  const fs::path folder = file.parent_path();
  if (file.filename() != "lf.h5") files.push_back(folder / (file.stem().string() + "_labels.h5"));
  files.push_back(folder / "labels.h5");
  return files;
}

fs::path labels_beside(const fs::path& file) {
  const std::vector<fs::path> files = label_files_of(file);
  if (files.size() == 1 || !has_hdf5_signature(files.front())) return files.back();
  try {
    const Hdf5Input labels(files.front());
    const bool has_labels = labels.has(kTrueLabels) || labels.has("SCRIBBLES");
    return has_labels ? files.front() : files.back();
  } catch (const IoError&) {
    return files.back();  // damaged
  }
}
namespace {

constexpr int kColorChannels = 3;

}  // namespace

std::vector<LabelInfo> read_label_list(const Hdf5Input& file, const std::string& dataset) {
  const std::vector<double> ids = file.numbers(dataset, "label_ids");
  const std::vector<double> colors = file.numbers(dataset, "label_colors");
  std::istringstream names(file.text(dataset, "label_names").value_or(""));
  if (colors.size() != ids.size() * kColorChannels) return {};
  std::vector<LabelInfo> labels;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    LabelInfo label;
    const auto id = whole_int(ids[i]);
    if (!id || !std::getline(names, label.name)) return {};
    label.id = *id;
    for (std::size_t c = 0; c < kColorChannels; ++c) {
      const int level = whole_int(colors[i * kColorChannels + c]).value_or(0);
      label.color[c] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

void add_label_list(Hdf5Output& file, const std::string& dataset,
                    const std::vector<LabelInfo>& labels) {
  if (labels.empty()) return;
  std::vector<int> ids;
  std::vector<int> colors;
  std::string names;
  for (const LabelInfo& label : labels) {
    ids.push_back(label.id);
    colors.insert(colors.end(), label.color.begin(), label.color.end());
    names += label.name + "\n";
  }
  file.set_integers(dataset, "label_ids", ids);
  file.set_integers(dataset, "label_colors", colors);
  file.set_text(dataset, "label_names", names);
}

}  // namespace episcope::io
