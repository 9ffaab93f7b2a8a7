// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_method.h"
#include "engine/disparity/propagate_planes.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/hash.h"
#include "engine/disparity/carried_run.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/net.h"
#include "engine/disparity/net_evidence.h"
#include "engine/disparity/net_weights.h"
#include "engine/disparity/stereo_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace episcope {

namespace {

namespace fs = std::filesystem;

constexpr int kMostRounds = 4;
constexpr double kShortestRange = 0.2;  // px
// Work of the parts of the network, GFLOP for 512² px (resources/training/README.md).
constexpr double kVolumeWork = 808.0 / 40;  // A label,
constexpr double kRoundWork = 203;
constexpr double kRefinementWork = 178;

// The weights of a file, also on the device from when they are first wanted there.
class ReadWeights {
 public:
  explicit ReadWeights(const NamedArrays& arrays) : weights_(arrays), hash_(arrays.hash) {}

  [[nodiscard]] const NetWeights& weights() const { return weights_; }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] const cuda::DeviceNet& on_device(const Progress& progress) const {
    const std::lock_guard lock(mutex_);
    if (!device_) device_ = std::make_unique<cuda::DeviceNet>(net_parts(weights_), progress);
    return *device_;
  }

 private:
  NetWeights weights_;
  std::uint64_t hash_ = 0;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const cuda::DeviceNet> device_;
};

std::shared_ptr<const ReadWeights> read_weights(const fs::path& path) {
  const NamedArrays arrays = read_named_arrays(path);
  try {
    return std::make_shared<const ReadWeights>(arrays);
  } catch (const InvalidInput& error) {
    throw IoError(path, error.what());
  }
}

// The weights of the last file.
class KeptWeights {
 public:
  std::shared_ptr<const ReadWeights> of(const fs::path& path) {
    std::error_code failure;
    const fs::file_time_type written = fs::last_write_time(path, failure);
    const std::lock_guard lock(mutex_);
    if (!weights_ || failure || path != path_ || written != written_) {
      weights_ = read_weights(path);
      path_ = path;
      written_ = written;
    }
    return weights_;
  }

 private:
  std::mutex mutex_;
  fs::path path_;
  fs::file_time_type written_;
  std::shared_ptr<const ReadWeights> weights_;
};

std::shared_ptr<const ReadWeights> weights_of(const NetMethodParameters& parameters) {
  static KeptWeights& kept = *new KeptWeights;  // never freed: the driver may be gone by then
  return kept.of(parameters.weights.empty() ? installed_weights(kNetWeights)
                                            : fs::absolute(parameters.weights));
}

Interval wide_enough(Interval range) {
  const double missing = std::max(kShortestRange - range.length(), 0.0) / 2;
  return {range.min - missing, range.max + missing};
}

Estimate estimate_of(ViewIndex view, Interval range, const NetMaps& maps) {
  Estimate estimate;
  estimate.range = range;
  const auto stack_of = [&](const Image<float>& map) {
    ViewStack<float> stack({1, 1}, map.height(), map.width(), 1, view);
    std::copy(map.begin(), map.end(), stack.data());
    return stack;
  };
  estimate.field.disparity = stack_of(maps.disparity);
  estimate.confidence = stack_of(maps.confidence);
  estimate.second =
      DisparityField::unknown({1, 1}, maps.second.height(), maps.second.width(), view);
  for (std::size_t i = 0; i < maps.second.size(); ++i) {
    if (!(maps.second_probability.data()[i] >= kLeastSecond)) continue;
    estimate.second.disparity.data()[i] = maps.second.data()[i];
    estimate.second.valid.data()[i] = 1;
  }
  return estimate;
}

Image<float> image_of(ImageView<const float> view) {
  Image<float> image(view.height, view.width);
  std::copy_n(view.data, image.size(), image.data());
  return image;
}

class NetMethod final : public CarriedMethod {
 public:
  // Reads the weights, finds the range.
  NetMethod(const LightField& light_field, const NetMethodParameters& parameters, Device device,
            const Progress& progress)
      : lf_(light_field),
        parameters_(parameters),
        weights_(weights_of(parameters)),
        device_(device == Device::Cuda ? &weights_->on_device(progress.part(0, 0)) : nullptr),
        range_(wide_enough(search_range(light_field, parameters.range, progress.part(0, 0.5)))) {
    choose_places(progress.part(0.5, 1));
  }

  [[nodiscard]] ViewIndex first_view() const override {
    return parameters_.view.value_or(lf_.center());
  }
  [[nodiscard]] Interval range() const override { return range_; }
  [[nodiscard]] const LightField& compared() const override { return lf_; }

  [[nodiscard]] Estimate estimate_first(const Progress& progress) override {
    const ViewIndex view = first_view();
    Estimate estimate = estimate_of(
        view, range_,
        estimate_net(lf_, view, weights_->weights(), view_parameters(), progress, device_));
    estimate.notes = place_notes_;
    if (!parameters_.weights.empty()) {
      estimate.notes.push_back(fmt::format(finding_text("run.weights"), parameters_.weights,
                                           hash_digits(weights_->hash())));
    }
    return estimate;
  }
  [[nodiscard]] Estimate estimate_next(ViewIndex view, const std::vector<Estimate>& maps,
                                       const Progress& progress) override {
    const PropagatedMaps carried = propagate_to_views(maps, {view, {1, 1}}, progress.part(0, 0.01));
    return estimate_of(
        view, range_,
        polish_by_net(lf_, view, image_of(carried.disparity.view(view)), weights_->weights(),
                      view_parameters(), progress.part(0.01, 1), device_));
  }

  [[nodiscard]] bool has_corners() const override { return parameters_.has_corners; }
  [[nodiscard]] double share_of_next() const override {
    return (kRoundWork + kRefinementWork) / (kVolumeWork * net_label_count(range_) +
                                             kRoundWork * parameters_.rounds + kRefinementWork);
  }

  // Maps, and the rows of views that evidence is taken from; tensors are large arrays.
  [[nodiscard]] double bytes_of_view() const override {
    constexpr double kOfPixel = 160, kOfSample = 32;
    constexpr int kRowsAround = 2 * kNetBand;
    const GridShape grid = lf_.grid();
    const double farthest = std::max(std::abs(range_.min), std::abs(range_.max)) + 1;
    const double rows = std::min(kRowsAround + farthest * std::max(grid.v, 1), 1.0 * lf_.height());
    const double views = std::min(grid.count(), kNetSectors * kNetSectorViews + 1);
    return lf_.width() * (kOfPixel * lf_.height() + kOfSample * rows * views);
  }

 private:
  [[nodiscard]] NetParameters view_parameters() const {
    return {range_, parameters_.silhouettes, parameters_.rounds, places_};
  }
  void choose_places(const Progress& progress) {
    const StereoCosts costs = prepare_stereo(lf_, MatchedViews::CrossHair,
                                             {.epsilon = kUncapped,
                                              .compensate_noise = false,
                                              .aggregation = 0,
                                              .positions = parameters_.positions,
                                              .range = range_,
                                              .view = parameters_.view},
                                             progress);
    places_ = costs.matching.places;
    place_notes_ = costs.notes;
  }

  const LightField& lf_;
  NetMethodParameters parameters_;
  std::shared_ptr<const ReadWeights> weights_;
  const cuda::DeviceNet* device_;  // Null: the CPU.
  Interval range_;
  NetPlaces places_;
  std::vector<std::string> place_notes_;
};

BlockwiseRun net_in_blocks(const LightField& lf, const NetMethodParameters& parameters,
                           ViewSelection views, const Progress& progress) {
  BlockwiseRun run =
      carried_in_blocks(lf, std::make_unique<NetMethod>(lf, parameters, Device::Cpu, progress),
                        views, progress.threads());
  run.has_second = run.maps.grid.count() == 1;
  return run;
}

Schema<NetMethodParameters> net_schema() {
  using P = NetMethodParameters;
  return Schema<P>()
      .choice("silhouettes", &P::silhouettes,
              {"Silhouettes",
               "Where a pixel shows two surfaces: mode, the more probable one; mean, the mean of "
               "both by their shares, which has the smaller squared error"})
      .integer("rounds", &P::rounds,
               {"Refinement rounds",
                "Rounds in which each pixel chooses among the disparities around it"},
               {1, kMostRounds})
      .flag("corners", &P::has_corners,
            {"Corner views",
             "For all views: estimate the corners of the grid, too; without, the first view is "
             "carried to all others in half the time"})
      .choice("positions", &P::positions, {"Camera positions", kPositionsHelp})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20})
      .view(
          "view", &P::view,
          {"View", "Row and column of the view to estimate, or to begin with; auto = center view"})
      .text("weights", &P::weights,
            {"Weights", "File of the network's weights; by default those of the program"})
      .search("rounds", {1, 2});
}

}  // namespace

Names<Silhouettes> names_of(Silhouettes) {
  return {{Silhouettes::Mode, "mode", "more probable surface"},
          {Silhouettes::Mean, "mean", "mean of both surfaces"}};
}

Estimate estimate_by_net(const LightField& lf, const NetMethodParameters& parameters,
                         ViewSelection views, const Progress& progress, Device device) {
  NetMethod method(lf, parameters, device, progress.part(0, 0.02));
  return run_carried(method, views, progress.part(0.02, 1));
}

Estimator net_estimator() {
  return make_estimator<NetMethodParameters>(
      {.id = "net",
       .name = "NET",
       .summary = "A network chooses and refines disparities by the evidence of all views",
       .reference = "Own; trained on procedural light fields alone",
       .all_views = true,
       .devices = {Device::Cpu, Device::Cuda},
       .weights = kNetWeights,
       .main_parameters = {"range", "rounds", "silhouettes"}},
      net_schema(), estimate_by_net, net_in_blocks);
}

}  // namespace episcope
