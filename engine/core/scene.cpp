// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/scene.h"

#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

namespace episcope {
namespace {

std::string with_author(const std::string& text, bool was_chosen) {
  return was_chosen ? text + ", as chosen by hand" : text;
}

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

/// Fully saturated color wheel, dimmed: `hue` in [0, 1).
Rgb hue_color(double hue, double brightness) {
  Rgb color{};
  for (int c = 0; c < 3; ++c) {
    const double place = std::fmod(hue * 6 + 6 - 2 * c, 6.0);
    const double level = std::clamp(std::abs(place - 3) - 1, 0.0, 1.0);
    color[c] = static_cast<std::uint8_t>(std::lround(255 * brightness * (0.15 + 0.85 * level)));
  }
  return color;
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

Rgb label_color(std::int32_t id) {
  // Greedily, from a grid of colors: the next one is farthest from all before under normal,
  // protan, deutan and tritan vision.
  constexpr Rgb palette[] = {{230, 25, 75},  {0, 0, 255},    {255, 150, 255}, {100, 255, 0},
                             {150, 0, 100},  {150, 50, 200}, {200, 200, 100}, {255, 100, 150},
                             {150, 0, 0},    {200, 150, 0},  {100, 200, 200}, {200, 0, 255},
                             {50, 100, 150}, {200, 50, 100}, {150, 100, 0},   {100, 150, 200},
                             {50, 255, 255}, {100, 0, 200},  {255, 50, 255},  {255, 200, 150}};
  constexpr std::int32_t fixed = std::size(palette);
  if (id <= 0) return {};
  if (id <= fixed) return palette[id - 1];
  constexpr double golden_share = 0.6180339887498949;  // spreads hues evenly, however many
  return hue_color(std::fmod(id * golden_share, 1.0), id % 2 == 0 ? 1.0 : 0.65);
}

LabelInfo default_label(std::int32_t id) {
  return {id, "label " + std::to_string(id), label_color(id)};
}

}  // namespace episcope
