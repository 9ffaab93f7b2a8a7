// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/scene.h"

#include <utility>
#include <variant>

namespace episcope {
namespace {

std::string with_author(const std::string& text, bool was_chosen) {
  return was_chosen ? text + ", as chosen by hand" : text;
}

}  // namespace

std::string order_text(const ConventionReport& report) {
  return with_author(report.order, report.order_was_chosen);
}

std::string sign_text(const ConventionReport& report) {
  return report.sign.empty() ? "not known" : report.sign;
}

std::string units_text(const ConventionReport& report) {
  const std::string text = with_author(report.units, report.units_were_chosen);
  return report.units_check.empty() ? text : text + "; " + report.units_check;
}

std::string stored_samples_text(const LightField::Samples& samples) {
  if (std::holds_alternative<ViewStack<std::uint8_t>>(samples)) {
    return "uint8 as stored, taken as gamma-encoded; estimators see value/255";
  }
  if (std::holds_alternative<ViewStack<std::uint16_t>>(samples)) {
    return "uint16 as stored, taken as gamma-encoded; estimators see value/65535";
  }
  return "float32 as stored, taken as linear; estimators see the values";
}

const char* companion_name(CompanionKind kind) {
  switch (kind) {
    case CompanionKind::EdgeProbabilities:
      return "edge weights";
    case CompanionKind::ImageProbabilities:
      return "probabilities (image)";
    case CompanionKind::DepthProbabilities:
      return "probabilities (depth)";
    case CompanionKind::TrueDepthProbabilities:
      return "probabilities (true depth)";
  }
  return "";
}

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
