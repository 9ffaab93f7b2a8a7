// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/class_table.h"

#include <algorithm>
#include <vector>

namespace episcope::io {

std::span<const LabelInfo> urban_classes() {
  static const std::vector<LabelInfo> classes{
      {1, "bike", {168, 198, 168}},       {2, "building", {198, 0, 0}},
      {3, "fence", {202, 154, 198}},      {4, "others", {0, 0, 0}},
      {5, "person", {100, 198, 198}},     {6, "pole", {198, 100, 0}},
      {7, "road", {52, 42, 198}},         {8, "sidewalk", {154, 52, 192}},
      {9, "traffic sign", {198, 0, 168}}, {10, "vegetation", {0, 198, 0}},
      {11, "vehicle", {198, 186, 90}},    {12, "bridge", {108, 107, 161}},
      {13, "rider", {156, 200, 26}},      {14, "sky", {158, 179, 202}}};
  return classes;
}

int urban_class_of(Rgb color) {
  const auto found = std::ranges::find(urban_classes(), color, &LabelInfo::color);
  return found == urban_classes().end() ? 0 : found->id;
}

}  // namespace episcope::io
