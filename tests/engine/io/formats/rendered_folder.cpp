// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/formats/rendered_folder.h"

#include <QTest>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace episcope::test {

RenderedFolder::RenderedFolder() : LayeredFolder(kGrid) {
  write_views(part("views/view_{:02}_{:02}.png"));
  write_npy(part("depth/depth_{:02}_{:02}.npy"), scene.depth);
  write_npy(part("labels/label_{:02}_{:02}.npy"), scene.labels);
  write_manifest(whole());
}

std::vector<ViewIndex> RenderedFolder::whole() {
  std::vector<ViewIndex> views;
  for (int i = 0; i < kGrid.count(); ++i) views.push_back(kGrid.view_at(i));
  return views;
}

LayeredFolder::Name RenderedFolder::part(const std::string& form) {
  return
      [form](int row, int column) { return fmt::format(fmt::runtime(form), row - 1, column - 1); };
}

void RenderedFolder::write_manifest(const std::vector<ViewIndex>& complete,
                                    std::pair<std::string, std::string> changed) const {
  std::string views;
  for (const ViewIndex view : complete) {
    views += fmt::format("{}[{}, {}]", views.empty() ? "" : ", ", view.v, view.u);
  }
  std::string text = fmt::format(
      R"({{"format": "episcope light field", "version": 1, "blender": "3.4.1",
 "grid": {{"rows": {}, "columns": {}}}, "size": {{"width": {}, "height": {}}},
 "camera": {{"baseline": 0.5, "focal_length_px": 120, "zero_plane": {}}},
 "disparity_range": [-0.5, 1.5],
 "labels": [{{"value": 2, "name": "square"}}, {{"value": 5, "name": "wall"}}],
 "files": {{"views": "views/view_{{row:02}}_{{column:02}}.png",
  "depth": "depth/depth_{{row:02}}_{{column:02}}.npy",
  "labels": "labels/label_{{row:02}}_{{column:02}}.npy"}},
 "complete": [{}]}})",
      kGrid.v, kGrid.u, scene.views.width(), scene.views.height(), kZeroPlane, views);
  for (std::string* end : {&changed.first, &changed.second}) std::ranges::replace(*end, '\'', '"');
  const auto at = text.find(changed.first);
  QVERIFY2(at != std::string::npos, changed.first.c_str());
  text.replace(at, changed.first.size(), changed.second);
  std::ofstream(path("light_field.json"), std::ios::binary) << text;
}

}  // namespace episcope::test
