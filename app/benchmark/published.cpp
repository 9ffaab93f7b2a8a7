// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/published.h"

#include "engine/evaluation/parameter_search.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace episcope {
namespace {

using Json = nlohmann::ordered_json;

std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (std::isalnum(code) != 0) text += static_cast<char>(std::tolower(code));
  }
  return text;
}

PublishedFigures read_figures() {
  const Json json = Json::parse(kPublishedData);
  PublishedFigures figures{json.at("algorithms"), {}, json.at("averages"), {}};
  for (const Json& line : json.at("figure_7")) {
    figures.scenes.push_back({line.at("scene"), line.value("also", ""), line.at("mse_100")});
  }
  for (const Json& line : json.at("figure_8")) {
    figures.ranking.push_back(
        {line.at("algorithm"), line.at("mse_100"), line.at("speed"), line.at("all_views")});
  }
  return figures;
}

/// The best score of a search on a scene.
std::optional<double> best_of(const std::vector<MethodSearch>& searches, const std::string& method,
                              const std::string& scene) {
  const auto search = std::ranges::find(searches, method, &MethodSearch::method);
  if (search == searches.end()) return std::nullopt;
  const auto place = std::ranges::find(search->scenes, scene) - search->scenes.begin();
  const auto index = static_cast<std::size_t>(place);
  if (index == search->scenes.size()) return std::nullopt;
  const auto point = search->choice.per_scene[index];
  return point ? search->scores[*point][index] : std::nullopt;
}

std::string ratio_text(const std::optional<double>& ours, double published) {
  constexpr int digits = 2;
  return ours ? fixed_text(*ours / published, digits) : "–";
}

std::string speed_text(const PublishedAlgorithm* algorithm) {
  if (!algorithm) return "–";
  return algorithm->speed + (algorithm->all_views ? ", all views" : "");
}

}  // namespace

std::optional<double> PublishedFigures::mse_100(const std::string& scene,
                                                const std::string& algorithm) const {
  const std::string wanted = plain(scene);
  const auto line = std::ranges::find_if(scenes, [&](const PublishedScene& each) {
    return wanted == plain(each.name) ||
           (!each.other_name.empty() && wanted == plain(each.other_name));
  });
  const auto column = std::ranges::find_if(
      algorithms, [&](const std::string& each) { return plain(each) == plain(algorithm); });
  if (line == scenes.end() || column == algorithms.end()) return std::nullopt;
  return line->mse_100.at(static_cast<std::size_t>(column - algorithms.begin()));
}

const PublishedAlgorithm* PublishedFigures::find(const std::string& algorithm) const {
  const auto found = std::ranges::find_if(ranking, [&](const PublishedAlgorithm& each) {
    return plain(each.name) == plain(algorithm);
  });
  return found == ranking.end() ? nullptr : &*found;
}

const PublishedFigures& published_figures() {
  static const PublishedFigures figures = read_figures();
  return figures;
}

TitledTable published_table(const BenchmarkReport& report) {
  const PublishedFigures& figures = published_figures();
  const std::vector<MethodSearch> searches = gather_searches(report.searched);
  TitledTable titled{
      "Beside figure 7 of the paper: mean squared error × 100 of the center view (vmv2013)",
      "The paper searched for the best parameters of each scene; ratios are to its figure. Speed "
      "is "
      "that of figure 8: fast, less than five seconds; medium, less than a minute.",
      {{"scene", "algorithm", "figure 7", "run", "run / figure 7"}, {}},
      {}};
  if (!searches.empty()) {
    titled.table.header.insert(titled.table.header.end(), {"P-opt", "P-opt / figure 7"});
  }
  titled.table.header.emplace_back("speed");
  for (const BenchmarkResult& result : report.results) {
    const auto published = figures.mse_100(result.scene, result.entry);
    if (!published) continue;
    const auto run = find_metric(result.vmv2013, "mse_100");
    std::vector<std::string> cells{result.scene, result.entry, score_text(published),
                                   score_text(run), ratio_text(run, *published)};
    if (!searches.empty()) {
      const auto best = best_of(searches, result.entry, result.scene);
      cells.push_back(score_text(best));
      cells.push_back(ratio_text(best, *published));
    }
    cells.push_back(speed_text(figures.find(result.entry)));
    titled.table.rows.push_back(std::move(cells));
  }
  return titled;
}

}  // namespace episcope
