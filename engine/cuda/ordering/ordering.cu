// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/ordering/ordering.h"

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/ordering/ordering_terms.cuh"
#include "engine/cuda/tv_l2/denoise_maps.cuh"
#include "engine/cuda/tv_l2/tv_l2_solver.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

// All that the device holds for the sweeps.
class Sweeper {
 public:
  Sweeper(const LightField& lf, const OrderingSweeps& sweeps, const ViewStack<float>& observed,
          const ViewStack<float>& confidence, const ViewStack<float>& u, const Progress& progress);

  // Improves all views of one colour of the chequerboard; returns the largest relative gap.
  double improve(int colour, const Progress& progress);
  void download_to(ViewStack<float>& u, const Progress& progress) {
    download(u, u_, stream_, progress);
  }

 private:
  [[nodiscard]] int count(int colour) const { return static_cast<int>(views_[colour].size()); }

  const OrderingSweeps& sweeps_;
  std::shared_ptr<const DeviceLightField> light_field_;
  OrderedMaps maps_;
  DeviceStream stream_;
  DeviceArray<float> observed_, u_, weights_, edges_;
  DeviceArray<std::uint8_t> counts_;
  DeviceArray<float> batch_f_, batch_w_, batch_g_;  // of the views of one colour
  std::vector<int> views_[2];                       // their numbers
  DeviceArray<int> numbers_[2];
};

Sweeper::Sweeper(const LightField& lf, const OrderingSweeps& sweeps,
                 const ViewStack<float>& observed, const ViewStack<float>& confidence,
                 const ViewStack<float>& u, const Progress& progress)
    : sweeps_(sweeps),
      light_field_(on_device(lf, progress)),
      maps_{lf.grid(), lf.height(), lf.width()},
      observed_(upload(observed.data(), observed.size(), stream_, progress)),
      u_(upload(u.data(), u.size(), stream_, progress)),
      weights_(u.size(), stream_),
      edges_(u.size(), stream_),
      counts_(upload(sweeps.counts.data(), sweeps.counts.size(), stream_, progress)) {
  const auto trust = upload(confidence.data(), confidence.size(), stream_, progress);
  MapDenoising weighting;
  weighting.weight_power = sweeps.weight_power;
  weighting.min_weight = sweeps.min_weight;
  weighting.edge_strength = sweeps.edge_strength;
  fill_weights(light_field_->samples(), {lf.grid(), {}}, 0, lf.grid().count(), weighting,
               trust.data(), nullptr, {weights_.data(), edges_.data()}, stream_);
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    views_[(view.u + view.v) % 2].push_back(i);
  }
  const std::size_t batch = views_[0].size() * static_cast<std::size_t>(maps_.pixels());
  batch_f_ = {batch, stream_};
  batch_w_ = {batch, stream_};
  batch_g_ = {batch, stream_};
  for (int colour : {0, 1}) {
    numbers_[colour] = upload(views_[colour].data(), views_[colour].size(), stream_, Progress(1));
  }
}

double Sweeper::improve(int colour, const Progress& progress) {
  if (views_[colour].empty()) return 0;
  majorise({maps_, numbers_[colour].data(), count(colour), u_.data(), observed_.data(),
            weights_.data(), edges_.data(), counts_.data()},
           {sweeps_.rise, sweeps_.fall, sweeps_.softness},
           {batch_f_.data(), batch_w_.data(), batch_g_.data()}, stream_);
  TvL2DeviceSolver solver(maps_.height, maps_.width, count(colour), stream_);
  double gap = 0;
  for (const TvL2Outcome& outcome :
       solver.solve({batch_f_.data(), batch_w_.data(), batch_g_.data(), sweeps_.lambda},
                    sweeps_.max_iterations, sweeps_.gap, progress, batch_f_.data())) {
    gap = std::max(gap, outcome.relative_gap());
  }
  for (int i = 0; i < count(colour); ++i) {
    check(cudaMemcpyAsync(u_.data() + views_[colour][i] * maps_.pixels(),
                          batch_f_.data() + i * maps_.pixels(), maps_.pixels() * sizeof(float),
                          cudaMemcpyDeviceToDevice, stream_.get()));
  }
  return gap;
}

}  // namespace

double sweep_in_order(const LightField& lf, const OrderingSweeps& sweeps,
                      const ViewStack<float>& observed, const ViewStack<float>& confidence,
                      ViewStack<float>& u, const Progress& progress) {
  Sweeper sweeper(lf, sweeps, observed, confidence, u, progress.part(0, 0.02));
  const Progress fitting = progress.part(0.02, 0.98);
  const double steps = 2.0 * sweeps.sweeps;
  double gap = 0;
  for (int i = 0; i < 2 * sweeps.sweeps && !progress.finish_requested(); ++i) {
    sweeps.on_half(i, gap);
    const double other = sweeper.improve(i % 2, fitting.part(i / steps, (i + 1) / steps));
    gap = i % 2 == 0 ? other : std::max(gap, other);
  }
  sweeper.download_to(u, progress.part(0.98, 1));
  return gap;
}

OrderedLines count_ordered_lines(const ViewStack<float>& disparity, float limit,
                                 const Progress& progress) {
  const DeviceStream stream;
  const auto maps = upload(disparity.data(), disparity.size(), stream, progress);
  return count_lines({disparity.grid(), disparity.height(), disparity.width()}, maps.data(), limit,
                     stream);
}

}  // namespace episcope::cuda
