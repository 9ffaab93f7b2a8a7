// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/replace_file.h"

#include "app/session/command_line.h"
#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/open.h"
#include "engine/labeling/labeler.h"

#include <sys/stat.h>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

namespace episcope {
namespace {

namespace fs = std::filesystem;

}  // namespace

HiddenFolder::HiddenFolder(const fs::path& beside)
    : path_(io::folder_of(beside) / io::temporary_name(beside)) {
  if (::mkdir(path_.c_str(), S_IRWXU) != 0) throw io::write_error(beside);
}

HiddenFolder::~HiddenFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

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

namespace {

std::optional<double> as_number(const ParameterValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  if (const double* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

/// Equal in single precision, in which methods keep them; files do not tell all types apart.
bool is_same_value(const ParameterValue& a, const ParameterValue& b) {
  const auto is_same = [](double x, double y) {
    return static_cast<float>(x) == static_cast<float>(y);
  };
  const auto x = as_number(a);
  const auto y = as_number(b);
  if (x && y) return is_same(*x, *y);
  const auto* first = std::get_if<IntervalOrAuto>(&a);
  const auto* second = std::get_if<IntervalOrAuto>(&b);
  if (first && second && *first && *second) {
    return is_same((*first)->min, (*second)->min) && is_same((*first)->max, (*second)->max);
  }
  return to_text(a) == to_text(b);
}

/// "--inner-scale 0.7, --range auto": values of `stored` that `wanted` does not have.
std::vector<std::string> other_values(const std::vector<ParameterDescription>& descriptions,
                                      const ParameterSet& stored, const ParameterSet& wanted) {
  const auto defaults = described_under(descriptions, wanted);
  std::vector<std::string> others;
  for (const ParameterDescription& each : defaults) {
    const ParameterValue* before = find_value(stored, each.key);
    const ParameterValue* now = find_value(wanted, each.key);
    if (!before || is_same_value(*before, now ? *now : each.default_value)) continue;
    others.push_back("--" + option_name(each.key) + " " + to_text(*before));
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
  std::uint64_t sources_hash = 0;
  bool has_several_views = false;  ///< Of a result.
};

bool holds_several_views(const io::Hdf5Input& file) {
  return std::ranges::any_of(file.datasets(), [](const io::Hdf5Dataset& dataset) {
    return dataset.name.starts_with(io::kResultGroup) && dataset.shape.size() == 4 &&
           dataset.shape[0] * dataset.shape[1] > 1;
  });
}

StoredRun stored_run(const fs::path& path, const std::string& group) {
  const io::Hdf5Input file(path);
  const auto text = [&](const char* name) { return file.text(group, name).value_or(""); };
  return {text("method"),
          io::parameters_from_json(text("parameters")),
          text("source"),
          io::reading_in(file, group),
          hash_from_digits(text(io::kSourcesHash)),
          holds_several_views(file)};
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
  if (run.is_of_one_view && stored.has_several_views) return "of several views";
  if (run.sources_hash && stored.sources_hash == 0) return "that do not tell their strokes";
  if (run.sources_hash && stored.sources_hash != *run.sources_hash) {
    return "of other strokes, disparity or probabilities";
  }
  return {};
}

}  // namespace

void check_made_output(const fs::path& path, const IntendedRun& run, Overwrite overwrite,
                       const std::string& how) {
  if (!holds_something(path)) return;
  const bool are_labels = run.method.empty();
  if (!(are_labels ? is_sound_labeling(path) : is_sound_result(path))) {
    throw IoError(path, std::string("exists and is not a ") +
                            (are_labels ? "file of labels" : "result file") +
                            "; choose another name or remove it first");
  }
  if (overwrite == Overwrite::Yes) return;
  const std::string difference = difference_of(
      stored_run(path, are_labels ? "/" : io::kResultGroup), path, run,
      are_labels ? labeler_schema().descriptions() : find_estimator(run.method).parameters);
  if (difference.empty()) return;
  throw IoError(path, std::string("exists and holds ") + (are_labels ? "labels " : "a result ") +
                          difference + "; choose another name, or " + how);
}

namespace {

bool has_same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::file_size(a, error) != fs::file_size(b, error) || error) return false;
  std::ifstream first(a, std::ios::binary);
  std::ifstream second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

}  // namespace

namespace {

/// An array that holds no maps; those of a view have two axes, those of all views four.
bool is_other_array(const fs::path& path) {
  const auto form = map_form_of(path);
  if (form == MapForm::Npz || form == MapForm::Mat) return !names_result(path.string());
  try {
    return form == MapForm::Npy && io::NpyFile(path).shape().size() % 2 != 0;
  } catch (const IoError&) {
    return false;  // damaged
  }
}

}  // namespace

void protect_light_field(const fs::path& path) {
  if (!holds_something(path)) return;
  if (!is_other_array(path) && !io::is_part_of_light_field(path)) return;
  throw IoError(path, "is part of a light field, which is not replaced; choose another name");
}

void write_output(const fs::path& path, Overwrite overwrite,
                  const std::function<void(const fs::path&)>& write, const std::string& how) {
  if (overwrite == Overwrite::Yes) protect_light_field(path);
  if (overwrite == Overwrite::Yes || !holds_something(path)) return write(path);
  const HiddenFolder hidden(path);
  const fs::path fresh = hidden.path() / path.filename();
  write(fresh);
  if (has_same_bytes(path, fresh)) return;
  throw IoError(path, "exists and holds something else; choose another name, or " + how);
}

}  // namespace episcope
