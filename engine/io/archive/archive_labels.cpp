// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_labels.h"

#include "engine/io/labels/label_list.h"
#include "engine/io/labels/raise_label.h"
#include "engine/io/labels/scribble_dataset.h"

#include <algorithm>

namespace episcope::io {
namespace {

bool contains_zero(const ViewStack<std::int32_t>& labels) {
  return !labels.empty() && std::find(labels.data(), labels.data() + labels.size(), 0) !=
                                labels.data() + labels.size();
}

}  // namespace

ArchiveLabels read_archive_labels(const Hdf5Input& file, const FieldShape& shape,
                                  ConventionReport& report, const Progress& progress) {
  ArchiveLabels found;
  if (file.has(kTrueLabels)) {
    found.labels = read_maps<std::int32_t>(file, kTrueLabels, shape, progress.part(0, 0.9));
  }
  if (file.has(kTrueLabels)) found.scribbles.labels = read_label_list(file, kTrueLabels);
  if (!file.has("SCRIBBLES")) return found;
  StoredScribbles stored =
      read_scribble_dataset(file, shape, contains_zero(found.labels), progress.part(0.9, 1));
  if (stored.scribbles.labels.empty() && !stored.raises_labels) {
    stored.scribbles.labels = std::move(found.scribbles.labels);
  }
  found.scribbles = std::move(stored.scribbles);
  if (!stored.raises_labels) return found;
  report.raised_labels = true;
  std::for_each(found.labels.data(), found.labels.data() + found.labels.size(), raise_label);
  report.warnings.push_back(
      "Labels start at 0 in this file and unpainted pixels are marked by another value: all labels "
      "are raised by one, so that 0 means unpainted.");
  return found;
}

}  // namespace episcope::io
