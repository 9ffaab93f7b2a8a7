// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/ablation.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/accuracy/measure.h"
#include "tests/accuracy/variant.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

namespace episcope::accuracy {
namespace {

using Json = nlohmann::ordered_json;

// Keeps the logarithm of a perfect score finite.
constexpr double kMinError = 1e-6;

AblatedMethod method_from(const Json& json) {
  AblatedMethod method{json.at("method"), {}};
  for (const Json& each : json.at("variants")) {
    const Json values = each.value("parameters", Json::object());
    std::vector<std::string> settings;
    for (const auto& [key, text] : values.items()) {
      settings.push_back(key + "=" + text.get<std::string>());
    }
    method.variants.push_back(
        {each.at("name"), variants({method.method}, settings).front().values});
  }
  return method;
}

// One variant on all scenes.
struct Scores {
  std::vector<double> mse_100;
  double badpix = 0;  ///< Mean.
};

std::string row(const std::string& name, const Scores& scores, const Scores& first) {
  double logs = 0;
  int as_good = 0;
  std::string cells;
  for (std::size_t i = 0; i < scores.mse_100.size(); ++i) {
    const double own = std::max(scores.mse_100[i], kMinError);
    const double other = std::max(first.mse_100[i], kMinError);
    logs += std::log(own / other);
    as_good += own <= other ? 1 : 0;
    cells += fmt::format(" {:.3g} |", scores.mse_100[i]);
  }
  const std::size_t count = scores.mse_100.size();
  return fmt::format("| {} | {:.3f} | {}/{} | {:.2f} |{}\n", name,
                     std::exp(logs / static_cast<double>(count)), as_good, count, scores.badpix,
                     cells);
}

std::string table(const Ablation& ablation, const AblatedMethod& method,
                  const std::vector<Scores>& scores) {
  std::string text = fmt::format("\n| {} | ratio | as good | BadPix(0.07) % |", method.method);
  std::string rule = "\n|---|---:|---:|---:|";
  for (const std::string& scene : ablation.scenes) {
    text += " " + scene + " |";
    rule += "---:|";
  }
  text += rule + "\n";
  for (std::size_t i = 0; i < scores.size(); ++i) {
    text += row(method.variants[i].name, scores[i], scores.front());
  }
  return text;
}

}  // namespace

Ablation read_ablation(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw IoError(file, "cannot be read; name a file as tests/accuracy/ablation.json");
  try {
    const Json json = Json::parse(stream);
    Ablation ablation{json.at("set"), json.at("scenes"), {}};
    for (const Json& method : json.at("methods")) ablation.methods.push_back(method_from(method));
    return ablation;
  } catch (const Json::exception& error) {
    throw IoError(file, error.what());
  }
}

void run_ablation(const Ablation& ablation, const std::function<void(const std::string&)>& print,
                  const Progress& progress) {
  std::vector<Scene> rendered;
  for (const std::string& scene : ablation.scenes) {
    const scenes::BuiltinRequest request = scenes::read_request(scene);
    rendered.push_back(scenes::render_builtin(request.scene, request.options, progress));
  }
  print("Scenes: " + ablation.set + ".\n");
  for (const AblatedMethod& method : ablation.methods) {
    const Estimator estimator = find_estimator(method.method);
    std::vector<Scores> scores;
    for (const AblationVariant& variant : method.variants) {
      Scores& own = scores.emplace_back();
      for (std::size_t i = 0; i < rendered.size(); ++i) {
        const Measurement measured = measure(ablation.scenes[i], rendered[i], estimator,
                                             variant.values, ViewSelection::Center, progress);
        own.mse_100.push_back(measured.mse_100);
        own.badpix += measured.badpix_0070 / static_cast<double>(rendered.size());
      }
    }
    print(table(ablation, method, scores));
  }
}

}  // namespace episcope::accuracy
