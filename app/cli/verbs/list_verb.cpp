// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/collections.h"
#include "app/session/scene_summary.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <utility>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

struct ListRequest {
  std::vector<std::string> folders;
  bool is_json = false;
  JobOptions job;
};

bool parse(const VerbArguments& arguments, ListRequest& request) {
  Arguments parser(
      "list",
      {"Lists all light fields in and below folders: form, views, size, truth, labels, and\n"
       "the results next to them. Reads headers only, and remembers them. Pictures that this\n"
       "program made are no light fields.",
       "episcope-cli list ~/light_fields\n"
       "  episcope-cli list training test --json"});
  parser.positionals("FOLDER", request.folders, "Folders to search");
  parser.flag("--json", request.is_json, "Print one JSON object instead of a table");
  declare_job_options(parser, request.job);
  return parser.parse(arguments);
}

std::vector<io::CollectionEntry> list_all(const ListRequest& request, const Job& job) {
  std::vector<io::CollectionEntry> all;
  std::set<fs::path> seen;
  for (std::size_t i = 0; i < request.folders.size(); ++i) {
    const auto count = static_cast<double>(request.folders.size());
    const double begin = static_cast<double>(i) / count;
    for (io::CollectionEntry& entry : io::find_light_fields(
             request.folders[i], {}, job.progress().part(begin, begin + 1 / count))) {
      if (seen.insert(fs::weakly_canonical(entry.path)).second) all.push_back(std::move(entry));
    }
  }
  return all;
}

std::string product(int a, int b) {
  return a > 0 && b > 0 ? std::to_string(a) + "×" + std::to_string(b) : "?";
}

std::string views_text(const io::SceneProbe& probe) {
  const bool is_list = probe.list > 0 && probe.grid.count() == 0;
  const std::string views =
      is_list ? std::to_string(probe.list) : product(probe.grid.v, probe.grid.u);
  return probe.frames > 0 ? std::to_string(probe.frames) + " × " + views : views;
}

std::string size_text(const io::SceneProbe& probe) {
  if (probe.width == 0) return "?";
  std::string text = product(probe.width, probe.height);
  if (probe.channels > 0) text += probe.channels == 3 ? " RGB" : " gray";
  if (probe.sample_type) text += std::string(" ") + sample_type_name(*probe.sample_type);
  return text;
}

std::vector<std::string> row_of(const io::CollectionEntry& entry) {
  const auto text_or_none = [](const std::string& text) { return text.empty() ? "-" : text; };
  if (!entry.problem.empty()) {
    return {text_or_none(entry.reader), "-", "-", "-", "-", "-", entry.path.string()};
  }
  return {entry.reader,
          views_text(entry.probe),
          size_text(entry.probe),
          text_or_none(entry.probe.truth),
          text_or_none(entry.probe.labels),
          text_or_none(joined(entry.results, ", ", &io::ListedResult::method)),
          entry.path.string()};
}

/// Every column to the left: they are words.
void print_rows(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], character_count(row[i]));
    }
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      std::cout << row[i] << std::string(widths[i] - character_count(row[i]) + 2, ' ');
    }
    std::cout << row.back() << '\n';
  }
}

void print_table(const std::vector<io::CollectionEntry>& entries) {
  std::vector<std::vector<std::string>> rows{
      {"form", "views", "size", "truth", "labels", "results", "path"}};
  for (const io::CollectionEntry& entry : entries) rows.push_back(row_of(entry));
  print_rows(rows);
  for (const io::CollectionEntry& entry : entries) {
    if (!entry.problem.empty()) std::cout << "cannot be opened: " << entry.problem << '\n';
  }
}

Json results_json(const std::vector<io::ListedResult>& results) {
  Json array = Json::array();
  for (const io::ListedResult& result : results) {
    array.push_back(Json::object({{"file", result.path.string()}, {"method", result.method}}));
  }
  return array;
}

/// Keys of what is not known are absent.
Json entry_json(const io::CollectionEntry& entry) {
  const io::SceneProbe& probe = entry.probe;
  Json json;
  json["path"] = entry.path.string();
  json["name"] = entry.name;
  if (!entry.reader.empty()) json["form"] = entry.reader;
  if (probe.grid.count() > 0) {
    json["views"] = Json::object({{"v", probe.grid.v}, {"u", probe.grid.u}});
  }
  if (probe.list > 0) json["view_count"] = probe.list;
  if (probe.width > 0) {
    json["height"] = probe.height;
    json["width"] = probe.width;
    json["channels"] = probe.channels;
  }
  if (probe.sample_type) json["sample_type"] = sample_type_name(*probe.sample_type);
  if (probe.frames > 0) json["frames"] = probe.frames;
  if (!probe.truth.empty()) json["truth"] = probe.truth;
  if (!probe.labels.empty()) json["labels"] = probe.labels;
  json["results"] = results_json(entry.results);
  json["bytes"] = static_cast<std::int64_t>(entry.bytes);
  if (entry.modified > 0) json["modified"] = time_text(entry.modified);
  if (!entry.problem.empty()) json["problem"] = entry.problem;
  return json;
}

}  // namespace

void run_list(const VerbArguments& arguments, std::stop_token stop) {
  ListRequest request;
  if (!parse(arguments, request)) return;
  for (const std::string& folder : request.folders) check_input(folder);
  Job job(std::move(stop), request.job);
  const std::vector<io::CollectionEntry> entries = list_all(request, job);
  job.finish();
  if (entries.empty()) {
    throw IoError(request.folders.front(),
                  "there is no light field in this folder or below; name another folder");
  }
  if (!request.is_json) return print_table(entries);
  Json scenes = Json::array();
  for (const io::CollectionEntry& entry : entries) scenes.push_back(entry_json(entry));
  print_answer(Json::object({{"scenes", scenes}, {"results", scenes}}), job.notes());
}

}  // namespace episcope::cli
