// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output.h"

#include "app/cli/arguments.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/json.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/scribble_file.h"

#include <nlohmann/json.hpp>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ctime>
#include <iostream>

namespace episcope::cli {
namespace {

// Of a single, the shortest text that reads back as the same; of a double, without what rounding
// left of sums.
double without_excess_digits(double value) {
  constexpr double kRounding = 1e-12;
  const auto single = static_cast<float>(value);
  std::array<char, 32> text{};
  const char* end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
  double shortest = value;
  std::from_chars(text.data(), end, shortest);
  const bool is_same = single == value || std::abs(shortest - value) < kRounding;
  return is_same ? shortest : value;
}

}  // namespace

Json interval_json(const Interval& interval) {
  return Json::array({without_excess_digits(interval.min), without_excess_digits(interval.max)});
}

Json view_json(ViewIndex view) {
  return Json::array({view.v, view.u});
}

Json findings_json(const std::vector<std::string>& sentences) {
  Json findings = Json::array();
  for (const std::string& sentence : sentences) {
    if (const auto finding = finding_of(sentence)) {
      findings.push_back(Json::object({{"code", finding->code}, {"values", finding->values}}));
    }
  }
  return findings;
}

std::string time_text(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

void print_json(const Json& json) {
  // Names of files may be any bytes: those that are not UTF-8 become the replacement character.
  std::cout << io::json_text(json, 2) << '\n';
}

void print_answer(Json answer, const std::vector<std::string>& notes,
                  const std::vector<std::string>& written) {
  if (!answer.contains("results")) answer["results"] = Json::array({answer});
  Json& told = answer["notes"];
  if (told.is_null()) told = Json::array();
  for (const std::string& note : notes) {
    if (std::ranges::find(told, Json(note)) == told.end()) told.push_back(note);
  }
  if (!answer.contains("written")) answer["written"] = written;
  print_json(answer);
}

namespace {

namespace fs = std::filesystem;

using io::folder_of;

bool is_light_field(const fs::path& path) {
  try {
    if (!fs::is_regular_file(path)) return false;
    if (io::has_hdf5_signature(path)) return io::Hdf5Input(path).has("LF");
    return io::find_reader(path, {}).path == path;
  } catch (const Error&) {
    return false;  // damaged
  }
}

/// Labels beside a light field that were written together with it; empty if there are none.
fs::path own_labels(const fs::path& path) {
  for (const fs::path& labels : io::label_files_of(path)) {
    try {
      if (io::has_hdf5_signature(labels) &&
          io::Hdf5Input(labels).text("/", "light_field") == path.filename().string()) {
        return labels;
      }
    } catch (const IoError&) {
      continue;  // damaged
    }
  }
  return {};
}

/// Whether an existing file in the folder of an input may be part of it.
bool may_be_part(const fs::path& file, const fs::path& input) {
  const bool is_folder = io::is_folder(input);
  if (is_light_field(file)) {
    return is_folder || (file.filename() == "lf.h5" && !is_light_field(input));
  }
  if (io::has_hdf5_signature(file)) return !is_sound_result(file) && !is_sound_labeling(file);
  // Images and maps belong to folders of images only.
  const bool is_archive = io::is_there((is_folder ? input : folder_of(input)) / "lf.h5") ||
                          io::has_hdf5_signature(input);
  return !is_archive && !names_result(input.string());
}

}  // namespace

void check_output_file(const fs::path& path) {
  const fs::path folder = folder_of(path);
  if (io::is_folder(path)) throw IoError(path, "is a folder; name a file to write");
  if (!io::is_folder(folder)) {
    throw IoError(path, "cannot be written, because the folder " + folder.string() +
                            " does not exist; create it first");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw IoError(path, "cannot be written, because the folder " + folder.string() +
                            " is read-only; choose another one");
  }
}

void check_hdf5_output(const std::string& verb, const fs::path& path) {
  check_output_file(path);
  const std::string suffix = suffix_of(path);
  if (suffix == ".h5" || suffix == ".hdf5") return;
  throw UsageError(verb + " writes HDF5, but the output is " + path.string() + "; name it OUT.h5");
}

std::vector<std::string> files_written(const fs::path& output, const fs::path& labels) {
  if (labels.empty() || labels == output) return {output.string()};
  return {output.string(), labels.string()};
}

void print_labels_written(const fs::path& labels, const fs::path& output) {
  if (labels.empty() || labels == output) return;
  std::cout << labels.string() << ": labels of " << output.filename().string() << '\n';
}

void check_light_field_output(const fs::path& path, Overwrite overwrite) {
  if (holds_something(path) && !is_light_field(path)) {
    throw IoError(path, "exists and is not a light field; choose another name or remove it first");
  }
  if (overwrite == Overwrite::Yes) return;
  if (holds_something(path)) {
    throw IoError(path, "exists; choose another name, or replace it with --overwrite");
  }
  if (const fs::path labels = own_labels(path); !labels.empty()) {
    throw IoError(labels, "exists; choose another folder, or replace it with --overwrite");
  }
}

void protect_input(const fs::path& output, const std::string& input) {
  std::error_code ignored;
  if (!builtin_scene_id(input).empty() || !fs::exists(output, ignored)) return;
  if (fs::equivalent(output, input, ignored)) {
    throw IoError(output, "is the input; choose another name for the output");
  }
  const fs::path folder = fs::is_directory(input, ignored) ? fs::path(input) : folder_of(input);
  if (!holds_something(output) || !fs::equivalent(folder_of(output), folder, ignored)) return;
  if (!may_be_part(output, input)) return;
  throw IoError(output, "exists and may be part of the input; choose another name for the output");
}

}  // namespace episcope::cli
