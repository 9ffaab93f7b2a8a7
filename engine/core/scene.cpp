// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/scene.h"

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

}  // namespace episcope
