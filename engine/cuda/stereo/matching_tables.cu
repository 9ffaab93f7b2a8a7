// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo/matching_tables.cuh"

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

}  // namespace

DeviceMatching::DeviceMatching(const StereoMatching& matching, const ViewPlanes& planes,
                               const float* noise, const DeviceStream& stream)
    : views_(copied(matching.views, stream)),
      rows_(copied(matching.rows, stream)),
      columns_(copied(matching.columns, stream)),
      rows_seen_(copied(matching.rows_seen, stream)),
      columns_seen_(copied(matching.columns_seen, stream)) {
  tables_.planes = planes;
  tables_.views = views_.data();
  tables_.view_count = static_cast<int>(matching.views.size());
  tables_.labels = matching.labels;
  tables_.rows = rows_.data();
  tables_.columns = columns_.data();
  tables_.rows_seen = rows_seen_.data();
  tables_.columns_seen = columns_seen_.data();
  tables_.is_cross_hair = matching.is_cross_hair;
  tables_.cap = matching.cap;
  tables_.worst = matching.worst;
  tables_.noise = noise;
}

}  // namespace episcope::cuda
