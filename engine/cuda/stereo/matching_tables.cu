// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo/matching_tables.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

// A small array: what it takes to pin memory would be more than the copy.
template <class T>
DeviceArray<T> copied(const std::vector<T>& host, const DeviceStream& stream) {
  DeviceArray<T> array(host.size(), stream);
  if (host.empty()) return array;
  check(cudaMemcpyAsync(array.data(), host.data(), array.byte_size(), cudaMemcpyHostToDevice,
                        stream.get()));
  return array;
}

std::vector<GroupShift> grouped(const std::vector<MatchShift>& shifts, int labels) {
  std::vector<GroupShift> groups;
  for (std::size_t way = 0; way < shifts.size(); way += labels) {
    for (int label = 0; label < labels; label += kGroupLabels) {
      const MatchShift& first = shifts[way + label];
      GroupShift group{first.origin, first.origin, first.first, first.last};
      for (int l = label; l < std::min(label + kGroupLabels, labels); ++l) {
        const MatchShift& each = shifts[way + l];
        group.low = std::min(group.low, each.origin);
        group.high = std::max(group.high, each.origin);
        group.first = std::min(group.first, each.first);
        group.last = std::max(group.last, each.last);
      }
      groups.push_back(group);
    }
  }
  return groups;
}

}  // namespace

DeviceMatching::DeviceMatching(const StereoMatching& matching, const ViewPlanes& planes,
                               const float* noise, const DeviceStream& stream,
                               const Visibility& visibility)
    : views_(copied(matching.views, stream)),
      rows_(copied(matching.rows, stream)),
      columns_(copied(matching.columns, stream)),
      row_groups_(copied(grouped(matching.rows, matching.labels), stream)),
      column_groups_(copied(grouped(matching.columns, matching.labels), stream)),
      rows_seen_(copied(matching.rows_seen, stream)),
      columns_seen_(copied(matching.columns_seen, stream)),
      disparities_(copied(matching.disparities, stream)) {
  tables_.planes = planes;
  tables_.views = views_.data();
  tables_.view_count = static_cast<int>(matching.views.size());
  tables_.labels = matching.labels;
  tables_.rows = rows_.data();
  tables_.columns = columns_.data();
  tables_.row_groups = row_groups_.data();
  tables_.column_groups = column_groups_.data();
  tables_.rows_seen = rows_seen_.data();
  tables_.columns_seen = columns_seen_.data();
  tables_.is_cross_hair = matching.is_cross_hair;
  tables_.cap = matching.cap;
  tables_.worst = matching.worst;
  tables_.noise = noise;
  tables_.visibility = visibility;
  tables_.disparities = disparities_.data();
}

}  // namespace episcope::cuda
