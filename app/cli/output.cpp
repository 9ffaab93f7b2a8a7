// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output.h"

#include "app/cli/arguments.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "engine/core/parameter.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/json.h"
#include "engine/io/models/label_list.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/segmentation_file.h"
#include "engine/labeling/labeler.h"

#include <nlohmann/json.hpp>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <utility>

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
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Whether there is a file with something in it.
bool holds_something(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) > 0;
}

bool is_sound_result(const fs::path& path) {
  try {
    return io::is_result_file(path);
  } catch (const IoError&) {
    return false;  // damaged
  }
}

bool is_sound_labeling(const fs::path& path) {
  try {
    return io::is_segmentation_file(path);
  } catch (const IoError&) {
    return false;  // damaged
  }
}

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
  std::error_code ignored;
  const bool is_folder = fs::is_directory(input, ignored);
  if (is_light_field(file)) {
    return is_folder || (file.filename() == "lf.h5" && !is_light_field(input));
  }
  if (io::has_hdf5_signature(file)) return !is_sound_result(file) && !is_sound_labeling(file);
  // Images and maps belong to folders of images only.
  const bool is_archive = fs::exists((is_folder ? input : folder_of(input)) / "lf.h5", ignored) ||
                          io::has_hdf5_signature(input);
  return !is_archive && !names_result(input.string());
}

}  // namespace

void check_output_file(const fs::path& path) {
  std::error_code ignored;
  const fs::path folder = folder_of(path);
  if (fs::is_directory(path, ignored)) throw IoError(path, "is a folder; name a file to write");
  if (!fs::is_directory(folder, ignored)) {
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

namespace {

std::optional<double> number_of(const ParameterValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  if (const double* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

/// Equal in single precision, in which methods keep them; files do not tell all types apart.
bool is_same_value(const ParameterValue& a, const ParameterValue& b) {
  const auto is_same = [](double x, double y) {
    return static_cast<float>(x) == static_cast<float>(y);
  };
  const auto x = number_of(a);
  const auto y = number_of(b);
  if (x && y) return is_same(*x, *y);
  const auto* first = std::get_if<IntervalOrAuto>(&a);
  const auto* second = std::get_if<IntervalOrAuto>(&b);
  if (first && second && *first && *second) {
    return is_same((*first)->min, (*second)->min) && is_same((*first)->max, (*second)->max);
  }
  return to_text(a) == to_text(b);
}

/// "--inner_scale 0.7, --range auto": values of `stored` that `wanted` does not have.
std::vector<std::string> other_values(const std::vector<ParameterDescription>& descriptions,
                                      const ParameterSet& stored, const ParameterSet& wanted) {
  const auto defaults = described_under(descriptions, wanted);
  std::vector<std::string> others;
  for (const ParameterDescription& each : defaults) {
    const ParameterValue* before = find_value(stored, each.key);
    const ParameterValue* now = find_value(wanted, each.key);
    if (!before || is_same_value(*before, now ? *now : each.default_value)) continue;
    others.push_back("--" + each.key + " " + to_text(*before));
  }
  return others;
}

/// A place without "lf.h5", which a folder may stand for.
fs::path scene_place(const fs::path& path) {
  std::error_code ignored;
  fs::path place = fs::weakly_canonical(path, ignored);
  if (!place.has_filename() || place.filename() == "lf.h5") place = place.parent_path();
  return place;
}

bool is_same_scene(const std::string& source, const fs::path& file, const std::string& input) {
  if (source.empty() || source == source_text(input, file)) return true;
  if (!builtin_scene_id(source).empty() || !builtin_scene_id(input).empty()) return false;
  return scene_place(file.parent_path() / source) == scene_place(input);
}

/// As it would be typed.
std::string shown_source(const std::string& source, const fs::path& file) {
  if (!builtin_scene_id(source).empty()) return source;
  std::string text = (file.parent_path() / source).lexically_normal().string();
  while (text.size() > 1 && text.ends_with('/')) text.pop_back();
  return text;
}

bool is_same_reading(const Reading& stored, const ParameterSet& wanted) {
  if (stored.reader.empty()) return true;
  const auto has_all = [](const ParameterSet& some, const ParameterSet& all) {
    return std::ranges::all_of(some, [&all](const auto& option) {
      const ParameterValue* other = find_value(all, option.first);
      return other && is_same_value(option.second, *other);
    });
  };
  return has_all(stored.options, wanted) && has_all(wanted, stored.options);
}

/// What a file says of its making: attributes of a group.
struct StoredRun {
  std::string method;
  ParameterSet parameters;
  std::string source;
  Reading reading;
};

StoredRun stored_run(const fs::path& path, const std::string& group) {
  const io::Hdf5Input file(path);
  const auto text = [&](const char* name) { return file.text(group, name).value_or(""); };
  return {text("method"), io::parameters_from_json(text("parameters")), text("source"),
          io::reading_in(file, group)};
}

/// How a file differs from what would replace it: "a result of epi_l"; empty if it does not.
std::string difference_of(const StoredRun& stored, const fs::path& path, const IntendedRun& run,
                          const std::vector<ParameterDescription>& descriptions) {
  if (stored.method != run.method) return "of " + stored.method;
  const auto others = other_values(descriptions, stored.parameters, run.parameters);
  if (!others.empty()) return "with " + joined(others, ", ");
  if (!is_same_scene(stored.source, path, run.input)) {
    return "of another light field, " + shown_source(stored.source, path);
  }
  if (!is_same_reading(stored.reading, run.reading)) return "of another reading of its views";
  return {};
}

void refuse_difference(const fs::path& path, const std::string& what,
                       const std::string& difference) {
  if (difference.empty()) return;
  throw IoError(path, "exists and holds " + what + " " + difference +
                          "; choose another name, or replace it with --overwrite");
}

}  // namespace

void check_result_output(const fs::path& path, const IntendedRun& run, Overwrite overwrite) {
  if (!holds_something(path)) return;
  if (!is_sound_result(path)) {
    throw IoError(path, "exists and is not a result file; choose another name or remove it first");
  }
  if (overwrite == Overwrite::Yes) return;
  const StoredRun stored = stored_run(path, io::kResultGroup);
  refuse_difference(path, "a result",
                    difference_of(stored, path, run, find_estimator(run.method).parameters));
}

void check_labeling_output(const fs::path& path, const IntendedRun& run, Overwrite overwrite) {
  if (!holds_something(path)) return;
  if (!is_sound_labeling(path)) {
    throw IoError(path,
                  "exists and is not a file of labels; choose another name or remove it first");
  }
  if (overwrite == Overwrite::Yes) return;
  const StoredRun stored = stored_run(path, "/");
  refuse_difference(path, "labels",
                    difference_of(stored, path, run, labeler_schema().descriptions()));
}

namespace {

/// A hidden folder beside a file, for another one of its name.
class HiddenFolder {
 public:
  explicit HiddenFolder(const fs::path& beside)
      : path_(folder_of(beside) / io::temporary_name(beside)) {
    std::error_code error;
    if (fs::create_directory(path_, error)) return;
    errno = error.value();
    throw io::write_error(beside);
  }
  ~HiddenFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool has_same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::file_size(a, error) != fs::file_size(b, error) || error) return false;
  std::ifstream first(a, std::ios::binary);
  std::ifstream second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

}  // namespace

void write_output(const fs::path& path, Overwrite overwrite,
                  const std::function<void(const fs::path&)>& write) {
  if (overwrite == Overwrite::Yes || !holds_something(path)) return write(path);
  const HiddenFolder hidden(path);
  const fs::path fresh = hidden.path() / path.filename();
  write(fresh);
  if (has_same_bytes(path, fresh)) return;
  throw IoError(path,
                "exists and holds something else; choose another name, or replace it with "
                "--overwrite");
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
