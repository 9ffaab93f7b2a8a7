// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo/matching_tables.cuh"

namespace episcope::cuda {
namespace {

template <class T>
DeviceArray<T> copied(const std::vector<T>& host, const DeviceStream& stream,
                      const Progress& progress) {
  return upload(host.data(), host.size(), stream, progress);
}

}  // namespace

DeviceMatching::DeviceMatching(const StereoMatching& matching, const DeviceSamples& samples,
                               ViewIndex reference, const float* noise, const DeviceStream& stream,
                               const Progress& progress)
    : views_(copied(matching.views, stream, progress)),
      rows_(copied(matching.rows, stream, progress)),
      columns_(copied(matching.columns, stream, progress)),
      rows_seen_(copied(matching.rows_seen, stream, progress)),
      columns_seen_(copied(matching.columns_seen, stream, progress)) {
  tables_.samples = samples;
  tables_.reference = reference;
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
