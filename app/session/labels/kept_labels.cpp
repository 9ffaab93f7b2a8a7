// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/kept_labels.h"

#include "app/session/labels/save_segmentation.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/io/labels/segmentation_file.h"

#include <algorithm>
#include <string_view>

namespace episcope {

std::uint64_t hash_of(const ScribbleLayer& strokes) {
  Fnv1a hash;
  for (const ViewIndex view : strokes.painted_views()) {
    hash.add_word(static_cast<std::uint64_t>(view.v));
    hash.add_word(static_cast<std::uint64_t>(view.u));
    const ImageView<const std::uint8_t> image = strokes.view(view);
    hash.add({reinterpret_cast<const char*>(image.data), image.size()});
  }
  return hash.value();
}

void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress) {
  write_segmentation(path, {labels.labeling, labels.infos, {}, {}, {}}, input,
                     StoredProbabilities::None, progress);
}

LabelingPtr read_kept_labels(const std::filesystem::path& path, const Progress& progress) {
  const io::SegmentationFile file(path);
  auto labeling = std::make_shared<Labeling>();
  for (const LabelInfo& info : file.infos()) labeling->probabilities.ids.push_back(info.id);
  const int count = file.grid().count();
  for (int i = 0; i < count; ++i) {
    progress.report(static_cast<double>(i) / count);
    const ViewIndex view = file.grid().view_at(i, file.first());
    const Image<std::int32_t> labels = file.labels(view);
    if (i == 0) {
      labeling->labels =
          ViewStack<std::int32_t>(file.grid(), labels.height(), labels.width(), 1, file.first());
    }
    std::copy(labels.begin(), labels.end(), labeling->labels.view(view).data);
  }
  return labeling;
}

}  // namespace episcope
