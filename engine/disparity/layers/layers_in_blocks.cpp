// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layers_in_blocks.h"

#include "engine/disparity/common/invalid_pixels.h"
#include "engine/disparity/epi/line_residual_kernel.h"
#include "engine/disparity/layers/double_layers.h"
#include "engine/disparity/layers/layer_search.h"
#include "engine/disparity/layers/layer_smoothing.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace episcope {
namespace {

// Facts: the noise of the check of lines, then how many rays have two layers.
constexpr std::size_t kDoubles = 2;

// Of all samples that are looked at, if they are on disk, per row or per view.
double sample_bytes(const LightField& lf, int parts) {
  return lf.is_on_disk() ? static_cast<double>(lf.byte_size()) / parts : 0;
}

// Both orientations of a band of rows.
class LayerBands {
 public:
  LayerBands(const LightField& lf, const LayerSearch& search, const BlockwiseRun& single,
             const BlockwiseRun& fit, int threads)
      : lf_(lf),
        search_(search),
        single_(single.passes.front()),
        fit_(fit.passes.front()),
        maps_(single.maps),
        needs_(double_layers_need(lf, search.double_scales, search.doubles)),
        threads_(threads) {}

  [[nodiscard]] FinishedBlock compute(const MapBlock& block, const ReadBlock& read,
                                      const Progress& progress) const {
    FinishedBlock made = single_.compute(block, read, {}, progress.part(0, 0.25));
    made.maps.kept.push_back(
        std::move(fit_.compute(block, read, {}, progress.part(0.25, 0.5)).maps.confidence));
    DoubleLayers doubles = measure_double_layers(lf_, search_.double_scales, search_.doubles, block,
                                                 progress.part(0.5, 1));
    clear_invalid(lf_, doubles.confidence, block.first_row);
    made.maps.layered = {
        {std::move(doubles.near), {}}, {std::move(doubles.far), {}}, std::move(doubles.confidence)};
    return made;
  }

  // One after the other, beside the maps of those before.
  [[nodiscard]] double bytes(int rows) const {
    constexpr double kSingle = 9, kKept = 4, kLayers = 12;
    const double row = static_cast<double>(maps_.grid.count()) * maps_.width;
    const double doubles =
        threads_ * static_cast<double>(needs_.bytes) + row * rows * (kSingle + kKept + kLayers) +
        sample_bytes(lf_, lf_.height()) * std::min(rows + 2 * needs_.reach, lf_.height());
    return std::max({single_.bytes(rows), fit_.bytes(rows) + row * rows * kSingle, doubles});
  }

 private:
  const LightField& lf_;
  LayerSearch search_;
  BlockPass single_, fit_;
  MapGeometry maps_;
  DoubleNeeds needs_;
  int threads_;
};

// Some views of a row of the grid.
class LayeredViews {
 public:
  LayeredViews(const LightField& lf, const EpiTwoLayerParameters& parameters, Interval range)
      : lf_(lf), parameters_(parameters), range_(range) {}

  [[nodiscard]] std::vector<double> prepare(const ReadBlock& read, const Progress& progress) const {
    const MapBlock center{{lf_.center(), {1, 1}}, 0, lf_.height()};
    std::vector<double> facts =
        line_check_noise(lf_, parameters_.line_check, read(center), progress);
    facts.push_back(0);
    return facts;
  }

  [[nodiscard]] FinishedBlock compute(const MapBlock& block, const ReadBlock& read,
                                      const std::vector<double>& facts,
                                      const Progress& progress) const {
    FinishedBlock made{read(block)};
    BlockMaps& maps = made.maps;
    const ViewStack<float> fit = read.kept(block, 0);
    const LayeredMaps layered{fit, maps.field.disparity, maps.confidence, maps.layered};
    const PackedViews packed = pack_around(lf_, block.views, kMaxArmViews, progress.part(0, 0.05));
    check_lines(packed, parameters_.line_check, facts, maps, progress.part(0.05, 0.2));
    made.finding = smooth_layers(lf_, packed, parameters_, layered, progress.part(0.2, 0.98));
    made.facts = facts;
    made.facts[kDoubles] += static_cast<double>(count_doubles(maps.layered.layers));
    clamp_layers(layered, range_, progress.part(0.98, 1));
    return made;
  }

  [[nodiscard]] double bytes(int count, int threads) const {
    constexpr double kPacked = 4, kMaps = 24, kSmoothed = 140, kChecked = 24;
    const double pixels = static_cast<double>(lf_.height()) * lf_.width();
    const int views = packed_around(count, kMaxArmViews);
    return views * (kPacked * pixels + sample_bytes(lf_, lf_.grid().count())) +
           pixels * (kMaps * count + kChecked + kSmoothed * std::min(count, threads));
  }

 private:
  const LightField& lf_;
  EpiTwoLayerParameters parameters_;
  Interval range_;
};

BlockPass bands_of(const std::shared_ptr<const LayerBands>& bands) {
  BlockPass pass;
  pass.step = "one and two orientations";
  pass.bytes = [bands](int rows) { return bands->bytes(rows); };
  pass.compute = [bands](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                         const Progress& part) { return bands->compute(block, read, part); };
  return pass;
}

BlockPass views_of(const std::shared_ptr<const LayeredViews>& views, int threads) {
  BlockPass pass;
  pass.step = "layers";
  pass.unit = BlockUnit::Views;
  pass.bytes = [views, threads](int count) { return views->bytes(count, threads); };
  pass.prepare = [views](const ReadBlock& read, const std::vector<double>&, const Progress& part) {
    return views->prepare(read, part);
  };
  pass.compute = [views](const MapBlock& block, const ReadBlock& read,
                         const std::vector<double>& facts,
                         const Progress& part) { return views->compute(block, read, facts, part); };
  return pass;
}

}  // namespace

BlockwiseRun two_layers_in_blocks(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                  ViewSelection views, const Progress& progress) {
  const LayerSearch search = begin_layer_search(lf, parameters, progress.part(0, 0.9), Device::Cpu);
  BlockwiseRun run = orientations_in_blocks(lf, search.single, views, progress.part(0.9, 0.95));
  const BlockwiseRun fit = orientations_in_blocks(lf, search.fit, views, progress.part(0.95, 1));
  const int threads = progress.threads();
  const auto bands = std::make_shared<const LayerBands>(lf, search, run, fit, threads);
  const auto layered = std::make_shared<const LayeredViews>(lf, parameters, run.provenance.range);
  run.has_layers = true;
  run.kept = 1;
  run.passes = {bands_of(bands), views_of(layered, threads)};
  const std::size_t pixels =
      static_cast<std::size_t>(run.maps.grid.count()) * run.maps.height * run.maps.width;
  run.notes = [pixels](const BlockProgress& end) {
    return layer_notes(static_cast<std::size_t>(end.facts[kDoubles]), pixels, end.finding);
  };
  return run;
}

}  // namespace episcope
