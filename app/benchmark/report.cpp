// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/report.h"

#include "app/benchmark/scene_runs.h"
#include "engine/core/version.h"
#include "engine/evaluation/parameter_search.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <map>

namespace episcope {

std::vector<TitledTable> report_tables(const BenchmarkReport& report) {
  std::vector<TitledTable> tables = label_tables(report.results);
  if (!report.has_disparities) return tables;
  for (auto& table : benchmark_tables(report.results)) tables.push_back(std::move(table));
  TitledTable published = published_table(report);
  if (!published.table.rows.empty()) tables.push_back(std::move(published));
  for (auto& table : search_tables(report.searched)) tables.push_back(std::move(table));
  return tables;
}

std::string tables_to_csv(const std::vector<TitledTable>& tables) {
  std::string text;
  for (const TitledTable& titled : tables) {
    if (!text.empty()) text += "\n";
    text += table_to_csv({{titled.title}, {}}) + table_to_csv(titled.table);
  }
  return text;
}

std::string tables_to_latex(const std::vector<TitledTable>& tables) {
  std::string text;
  for (const TitledTable& titled : tables) {
    text += (text.empty() ? "% " : "\n% ") + titled.title + "\n";
    if (!titled.note.empty()) text += "% " + titled.note + "\n";
    text += table_to_latex(titled.table);
  }
  return text;
}

void write_report(const std::filesystem::path& folder, const BenchmarkReport& report) {
  const std::vector<TitledTable> tables = report_tables(report);
  io::write_atomically(folder / "tables.csv", tables_to_csv(tables));
  io::write_atomically(folder / "tables.tex", tables_to_latex(tables));
  io::write_atomically(folder / "results.csv", table_to_csv(results_table(report.results)));
  io::write_atomically(folder / "results.json", report_to_json(report));
  io::write_atomically(folder / "index.html", html_page(report, tables));
}

namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const BenchmarkScene& scene) {
  Json json{{"name", scene.name}, {"input", scene.input}};
  if (!scene.shape.empty()) json["shape"] = scene.shape;
  if (!scene.problem.empty()) json["problem"] = scene.problem;
  return json;
}

Json result_json(const BenchmarkResult& result) {
  Json json{{"entry", result.entry}, {"scene", result.scene}, {"foreign", result.is_foreign}};
  if (result.seconds > 0) json["seconds"] = result.seconds;
  json["all_views"] = result.has_all_views;
  for (const auto& [protocol, metrics] :
       {std::pair{Protocol::Vmv2013, &result.vmv2013},
        std::pair{Protocol::Benchmark2016, &result.benchmark2016}}) {
    for (const auto& [key, value] : *metrics) json[protocol_name(protocol)][key] = value;
  }
  for (const auto& [key, value] : result.labels) json["labels"][key] = value;
  const auto published = published_figures().mse_100(result.scene, result.entry);
  if (published) json["figure_7"] = *published;
  if (!result.problem.empty()) json["problem"] = result.problem;
  if (result.has_failed) json["failed"] = true;
  if (!result.notes.empty()) json["notes"] = result.notes;
  return json;
}

Json ranking_json(const ScoreMatrix& matrix, const char* key) {
  const Ranking ranking = rank_entries(matrix, kScoreDigits);
  Json scenes = Json::array();
  for (const std::size_t scene : ranking.scenes) scenes.push_back(matrix.scenes[scene]);
  Json entries = Json::array();
  for (const std::size_t entry : ranking.order) {
    Json json{{"entry", matrix.entries[entry]}};
    if (ranking.ranks[entry] > 0) json["rank"] = ranking.ranks[entry];
    if (ranking.averages[entry]) json[key] = *ranking.averages[entry];
    entries.push_back(json);
  }
  return {{"scenes", scenes}, {"entries", entries}};
}

Json choice_json(const MethodSearch& search, const std::optional<std::size_t>& point,
                 std::size_t scene) {
  if (!point) return nullptr;
  const auto& score = search.scores[*point][scene];
  return {{"point", *point}, {"mse_100", score ? Json(*score) : Json(nullptr)}};
}

Json search_json(const MethodSearch& search) {
  Json json{{"method", search.method}, {"points", Json::array()}, {"scenes", Json::array()}};
  for (const ParameterSet& point : search.points) {
    json["points"].push_back(io::parameters_json(point));
  }
  for (std::size_t scene = 0; scene < search.scenes.size(); ++scene) {
    Json scores = Json::array();
    for (const auto& point : search.scores) {
      scores.push_back(point[scene] ? Json(*point[scene]) : Json(nullptr));
    }
    json["scenes"].push_back(
        {{"scene", search.scenes[scene]},
         {"mse_100", scores},
         {"default", choice_json(search, std::size_t{0}, scene)},
         {"p_opt", choice_json(search, search.choice.per_scene[scene], scene)},
         {"p_fix", choice_json(search, search.choice.equal, scene)},
         {"loso", choice_json(search, search.choice.leave_one_out[scene], scene)}});
  }
  return json;
}

}  // namespace

std::string report_to_json(const BenchmarkReport& report) {
  Json json{{"program", "episcope"}, {"version", kVersion}};
  json["scenes"] = Json::array();
  for (const auto& scene : report.scenes) json["scenes"].push_back(scene_json(scene));
  if (report.has_disparities) {
    json["missing_values"] = "the farthest true disparity, and bad";
    json["ranking"] =
        ranking_json(score_matrix(report.results, Protocol::Vmv2013, "mse_100"), "mse_100");
  }
  if (report.has_labels) {
    ScoreMatrix matrix =
        score_matrix(report.results, &BenchmarkResult::labels, "accuracy_all_views");
    matrix.better = BetterScore::Larger;
    json["label_ranking"] = ranking_json(matrix, "accuracy_all_views");
  }
  json["results"] = Json::array();
  for (const auto& result : report.results) json["results"].push_back(result_json(result));
  if (!report.searched.empty()) {
    json["search"] = Json::array();
    for (const MethodSearch& search : gather_searches(report.searched)) {
      json["search"].push_back(search_json(search));
    }
  }
  json["failures"] = report.failures();
  // Names of files may be any bytes: those that are not UTF-8 become the replacement character.
  return io::json_text(json, 2) + "\n";
}

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
  const Json json = io::parse_json<Json>(kPublishedData);
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

namespace {

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> entities{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string html;
  for (const char c : text) {
    const auto entity = entities.find(c);
    html += entity == entities.end() ? std::string(1, c) : entity->second;
  }
  return html;
}

/// A path as a link: every byte that a name may not hold there is written in hexadecimal digits.
std::string link_to(const std::string& path) {
  std::string link;
  for (const char c : path) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 ||
        std::string("/._-").find(c) != std::string::npos) {
      link += c;
    } else {
      link += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return link;
}

std::string paragraph(const std::string& text, const char* style) {
  return text.empty() ? "" : std::string("<p class=\"") + style + "\">" + escaped(text) + "</p>\n";
}

bool is_summary(const std::vector<std::string>& row) {
  return row.front().starts_with("average") || row.front() == "rank";
}

// Of a column: whether words stand in it rather than numbers.
bool holds_words(const std::string& header) {
  return header.ends_with("parameters") || header == "algorithm" || header == "speed" ||
         header == "all views";
}

std::string row_html(const TitledTable& titled, std::size_t row) {
  std::string html = "<tr>";
  const auto& cells = titled.table.rows[row];
  for (std::size_t column = 0; column < cells.size(); ++column) {
    const bool is_best = std::find(titled.best.begin(), titled.best.end(),
                                   std::pair(row, column)) != titled.best.end();
    const bool has_words = holds_words(titled.table.header[column]);
    html += is_best ? "<td class=\"best\">" : has_words ? "<td class=\"text\">" : "<td>";
    html += escaped(cells[column]) + "</td>";
  }
  return html + "</tr>\n";
}

std::string table_html(const TitledTable& titled) {
  std::string html = "<h2>" + escaped(titled.title) + "</h2>\n" + paragraph(titled.note, "faint") +
                     "<div class=\"wide\"><table>\n<thead><tr>";
  for (const auto& cell : titled.table.header) {
    html += holds_words(cell) ? "<th class=\"text\">" : "<th>";
    html += escaped(cell) + "</th>";
  }
  html += "</tr></thead>\n<tbody>\n";
  std::string summary;
  for (std::size_t row = 0; row < titled.table.rows.size(); ++row) {
    (is_summary(titled.table.rows[row]) ? summary : html) += row_html(titled, row);
  }
  html += "</tbody>\n";
  if (!summary.empty()) html += "<tfoot>\n" + summary + "</tfoot>\n";
  return html + "</table></div>\n";
}

std::string picture_html(const std::string& path, const std::string& what) {
  const std::string link = link_to(path);
  return "<a href=\"" + link + "\"><img loading=\"lazy\" src=\"" + link + "\" alt=\"" +
         escaped(what) + "\" title=\"" + escaped(what) + "\"></a>";
}

std::string tile_html(const BenchmarkScene& scene, const std::string& what,
                      const std::string& caption) {
  return "<figure class=\"tile\">" + picture_html(scene_file(scene.name, what), caption) +
         "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

/// "MSE×100 0.222, bad > 0.07: 0.30 %, 1.93 s".
std::string numbers_text(const BenchmarkResult& result) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (const auto mse = find_metric(result.vmv2013, "mse_100")) {
    add("MSE×100 " + fixed_text(*mse, kScoreDigits));
  }
  for (const char* layer : {"foreground", "background"}) {
    const auto mse = find_metric(result.vmv2013, std::string("mse_100_") + layer);
    if (mse) add(std::string(layer) + " MSE×100 " + fixed_text(*mse, kScoreDigits));
  }
  if (const auto bad = find_metric(result.benchmark2016, "badpix_0070")) {
    add("bad > 0.07 px: " + fixed_text(*bad, 2) + " %");
  }
  if (result.seconds > 0) {
    add(fixed_text(result.seconds, 2) + " s" + (result.has_all_views ? " for all views" : ""));
  }
  return text;
}

/// "accuracy 97.4 %, mIoU 92.1 %, boundaries 93.0 %, 31.2 s for all views".
std::string label_numbers_text(const BenchmarkResult& result) {
  std::string text;
  for (const auto& [key, name] :
       {std::pair{"accuracy_all_views", "accuracy"}, std::pair{"miou", "mIoU"},
        std::pair{"boundary_accuracy", "boundaries"}}) {
    const auto share = find_metric(result.labels, key);
    if (share) text += fmt::format("{} {:.2f} %, ", name, 100 * *share);
  }
  return text + fixed_text(result.seconds, 2) + " s for all views";
}

std::string labels_html(const BenchmarkScene& scene, const BenchmarkResult& result) {
  const std::string& entry = result.entry;
  std::string html = "<figure class=\"entry\">" +
                     picture_html(picture_file(result.scene, entry, "labels"), entry + ", labels");
  if (scene.has_label_picture) {
    html += picture_html(picture_file(result.scene, entry, "wrong"), entry + ", what is wrong");
  }
  return html + "<figcaption><b>" + escaped(entry) + "</b> " + escaped(label_numbers_text(result)) +
         paragraph(result.problem, "faint") + "</figcaption></figure>\n";
}

std::string entry_html(const BenchmarkScene& scene, const BenchmarkResult& result) {
  if (!result.labels.empty()) return labels_html(scene, result);
  const std::string& entry = result.entry;
  std::string html = "<figure class=\"entry\">";
  const bool has_maps = !result.has_failed && (!result.is_foreign || !result.vmv2013.empty());
  if (has_maps) {
    html += picture_html(picture_file(result.scene, entry, "disparity"), entry + ", disparity");
    if (!result.vmv2013.empty()) {
      html += picture_html(picture_file(result.scene, entry, "error"), entry + ", error");
    }
  }
  std::string name = "<b>" + escaped(entry) + "</b>";
  if (has_maps && !result.is_foreign) {
    name = "<a href=\"" + link_to(map_file(result.scene, entry)) + "\">" + name + "</a>";
  }
  html += "<figcaption>" + name + (result.is_foreign ? " (submitted)" : "") + " " +
          escaped(numbers_text(result));
  html += paragraph(result.problem, result.has_failed ? "bad" : "faint");
  for (const auto& note : result.notes) html += paragraph(note, "faint");
  return html + "</figcaption></figure>\n";
}

std::string scene_html(const BenchmarkReport& report, const BenchmarkScene& scene) {
  std::string html = "<h2>" + escaped(scene.name) + "</h2>\n";
  if (!scene.problem.empty()) return html + paragraph(scene.problem, "bad");
  html += paragraph(scene.input + ": " + scene.shape +
                        (scene.range.length() > 0
                             ? "; disparity maps span " + fixed_text(scene.range.min, 2) + " … " +
                                   fixed_text(scene.range.max, 2) + " px"
                             : ""),
                    "faint") +
          "<div class=\"tiles\">\n" + tile_html(scene, "view", "center view");
  if (scene.has_truth_picture) html += tile_html(scene, "truth", "true disparity");
  if (scene.has_label_picture) html += tile_html(scene, "labels", "true labels");
  html += "</div>\n<div class=\"entries\">\n";
  for (const BenchmarkResult& result : report.results) {
    if (result.scene == scene.name) html += entry_html(scene, result);
  }
  return html + "</div>\n";
}

std::string failures_html(const BenchmarkReport& report) {
  const auto failures = report.failures();
  if (failures.empty()) return {};
  std::string html = "<h2>Failures</h2>\n<ul>\n";
  for (const auto& failure : failures) html += "<li class=\"bad\">" + escaped(failure) + "</li>\n";
  return html + "</ul>\n";
}

/// How scores and pictures are to be read.
std::string scores_text(const BenchmarkReport& report) {
  std::string text;
  if (report.has_disparities) {
    text +=
        " Disparities are evaluated in the center view: mean squared errors are in px² × 100, "
        "lower is better. Missing values count as the farthest true disparity, and as bad pixels.";
  }
  if (report.has_labels) text += " Labels are evaluated in all views, in %: higher is better.";
  return text;
}

std::string pictures_text(const BenchmarkReport& report) {
  std::string text;
  if (report.has_disparities) {
    text +=
        "Errors are truth − estimate from −0.2 (blue: too near) to 0.2 px (red: too far). The "
        "name of a method links to its result file. ";
  }
  if (report.has_labels) text += "Beside the labels of the center view stands what is wrong. ";
  return text + "Click a picture to see it in full size.";
}

}  // namespace

std::string html_page(const BenchmarkReport& report, const std::vector<TitledTable>& tables) {
  const std::string title = report.has_disparities ? "Disparity benchmark" : "Label benchmark";
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>" +
      title + "</title>\n<style>" + std::string(kReportStyle) +
      "\n</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n" +
      paragraph(
          fmt::format("{} scene{}", report.scenes.size(), report.scenes.size() == 1 ? "" : "s") +
              "." + scores_text(report) + " The best is in bold. Made by Episcope " + kVersion +
              "; the same numbers are in tables.csv, tables.tex, "
              "results.csv and results.json, every run in log.jsonl.",
          "faint") +
      failures_html(report);
  for (const TitledTable& table : tables) html += table_html(table);
  html += "<h2>Scenes</h2>\n" + paragraph(pictures_text(report), "faint");
  for (const BenchmarkScene& scene : report.scenes) html += scene_html(report, scene);
  return html + "<script>" + kReportScript + "\n</script>\n</body>\n</html>\n";
}

}  // namespace episcope
