// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/html_page.h"

#include "app/benchmark/scene_files.h"
#include "engine/core/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace episcope {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1b1d21; --faint: #5c6470; --page: #ffffff; --line: #d5d9e0;
  --band: #f3f5f8; --best: #0b6b3a; --bad: #a3201d; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8ec; --faint: #9aa3b0; --page: #16181c;
  --line: #343942; --band: #1f2329; --best: #6fd39b; --bad: #ff8f85; } }
body { font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--page);
  max-width: 1400px; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .4rem; }
p { margin: .3rem 0; max-width: 75ch; } .faint { color: var(--faint); }
.bad { color: var(--bad); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .5rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .7rem; text-align: right; white-space: nowrap;
  border-bottom: 1px solid var(--line); }
th:first-child, td:first-child, .text { text-align: left; }
th { font-weight: 600; border-bottom-width: 2px; cursor: pointer; }
tbody tr:nth-child(even) { background: var(--band); }
td.best { font-weight: 700; color: var(--best); }
.tiles { display: grid; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); gap: 14px; }
.entry { display: grid; grid-template-columns: 1fr 1fr; gap: 4px; align-content: start; }
tfoot tr:first-child td { border-top: 2px solid var(--line); }
.entry, .tile { break-inside: avoid; margin: 0; }
.entries { display: grid; grid-template-columns: repeat(auto-fill, minmax(330px, 1fr)); gap: 18px;
  margin-top: 14px; }
img { width: 100%; height: auto; display: block; border: 1px solid var(--line);
  box-sizing: border-box; }
figcaption { grid-column: 1 / -1; font-size: .9rem; margin-top: 3px; }
a { color: inherit; })";

// Sorts by the column clicked; summary rows stay below.
constexpr const char* kScript = R"(
document.querySelectorAll('th').forEach(function (head) {
  head.addEventListener('click', function () {
    var table = head.closest('table'), body = table.tBodies[0], column = head.cellIndex;
    var down = head.dataset.down !== 'yes', number = function (row) {
      return parseFloat(row.cells[column].textContent); };
    table.querySelectorAll('th').forEach(function (each) { delete each.dataset.down; });
    head.dataset.down = down ? 'yes' : 'no';
    Array.from(body.rows).sort(function (a, b) {
      var x = number(a), y = number(b), order = isNaN(x) || isNaN(y)
        ? (isNaN(x) ? 1 : 0) - (isNaN(y) ? 1 : 0) ||
          a.cells[column].textContent.localeCompare(b.cells[column].textContent) : x - y;
      return down ? order : -order;
    }).forEach(function (row) { body.appendChild(row); });
  });
});)";

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
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
      title + "</title>\n<style>" + std::string(kStyle) + "\n</style>\n</head>\n<body>\n<h1>" +
      title + "</h1>\n" +
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
  return html + "<script>" + kScript + "\n</script>\n</body>\n</html>\n";
}

}  // namespace episcope
