// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/ground_truth.h"

#include <utility>

namespace episcope {
namespace {

class ShiftedTruth : public HighResTruth {
 public:
  ShiftedTruth(HighResTruthPtr truth, float by_px) : truth_(std::move(truth)), by_px_(by_px) {}

  [[nodiscard]] Image<float> read_disparity() const override {
    Image<float> map = truth_->read_disparity();
    for (float& d : map) d += by_px_;
    return map;
  }
  [[nodiscard]] std::vector<std::string> regions() const override { return truth_->regions(); }
  [[nodiscard]] Image<std::uint8_t> read_region(const std::string& name) const override {
    return truth_->read_region(name);
  }
  [[nodiscard]] std::string identity() const override {
    return truth_->identity() + " " + std::to_string(by_px_);
  }

 private:
  HighResTruthPtr truth_;
  float by_px_;
};

}  // namespace

StratifiedScene stratified_scene(const std::string& name) {
  if (name == "backgammon") return StratifiedScene::Backgammon;
  if (name == "dots") return StratifiedScene::Dots;
  if (name == "pyramids") return StratifiedScene::Pyramids;
  return name == "stripes" ? StratifiedScene::Stripes : StratifiedScene::None;
}

std::string estimated_text(const Provenance& estimated) {
  const std::string method = estimated.method.empty() ? "a method unknown" : estimated.method;
  return "estimated by " + method +
         (estimated.source.empty() ? std::string() : " from " + estimated.source);
}

HighResTruthPtr shifted(HighResTruthPtr truth, float by_px) {
  return truth ? std::make_shared<const ShiftedTruth>(std::move(truth), by_px) : nullptr;
}

}  // namespace episcope
