// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/parameter_options.h"
#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/map_reading.h"
#include "engine/io/models/open_options.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope::cli {

/// The options by which every verb reads an INPUT (io::open_schema).
struct ReadOptions {
  ParameterOptions options;
  bool needs_truth = true;  ///< Whether truth and labels are wanted.
};

void declare_read_options(Arguments& arguments, ReadOptions& options);

/// Throws UsageError for a value that no light field can be read by, such as a grid of one number.
void check_read_options(const ReadOptions& options);
/// Throws UsageError if such an option is given for a file that is no light field.
void require_no_read_options(const ReadOptions& options, const std::string& input);

/// Prints the options of reading, which the help of verbs leaves out.
void print_reading_help();

/// Declares the options that every verb with an INPUT has, after its own, and parses. Returns and
/// throws as `Arguments::parse`.
[[nodiscard]] bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments,
                                 JobOptions& job, ReadOptions& read);

/// Declares how maps of a RESULT are read (io::map_schema), under a heading of their own.
void declare_map_options(Arguments& arguments, ParameterOptions& options);
/// Throws UsageError for a value that no map can be read by.
[[nodiscard]] io::MapReading map_reading(const ParameterOptions& options);
/// Throws UsageError if such an option is given to what is no RESULT.
void require_no_map_options(const ParameterOptions& options, const std::string& input);

/// Throws UsageError if `truth`, the light field of a RESULT, is given to what is a light field.
void require_result_for(const std::string& truth, const std::string& input);

/// Throws UsageError for an unknown id, naming the nearest.
void check_builtin_scene(const std::string& id);

/// Refuses an INPUT that cannot be there, before anything is done. Throws UsageError for an unknown
/// built-in scene, IoError for a path that does not exist.
void check_input(const std::string& input);

/// Opens an INPUT of the command line. Built-in scenes are kept in the user's cache folder.
/// Throws UsageError for an unknown built-in scene or a bad option, IoError, Cancelled.
[[nodiscard]] Scene load_input(const std::string& input, const ReadOptions& options,
                               const Progress& progress);
/// Opens it, and notes what there is to know of how it was read.
[[nodiscard]] Scene load_input(const std::string& input, const ReadOptions& options, Job& job,
                               const Progress& progress);
/// Opens an INPUT with options that do not come from the command line.
[[nodiscard]] Scene load_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                               const Progress& progress);

/// How the light field of a result or of labels was read.
struct NamedReading {
  std::string file;
  Reading reading;
};

/// What a result file says of its own. Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] NamedReading reading_of(const std::string& result);

/// Opens the light field that a result or labels are compared with, so that both are of the same
/// views: as the file says that its own was read (focus plane, order of views, …), where `options`
/// say nothing. Throws as `load_input`, and IoError, naming what to change, if `options` contradict
/// the file.
[[nodiscard]] Scene load_input_of(const NamedReading& result, const std::string& input,
                                  const ReadOptions& options, const Progress& progress);

/// For a file of a result or of labels without its light field: throws UsageError if it names none
/// (`named` is empty), else IoError, since that is not there.
[[noreturn]] void fail_without_source(const std::string& file, const std::string& named);

/// The view itself. Throws InvalidInput if the light field has no such view.
[[nodiscard]] ViewIndex view_of(const LightField& light_field, ViewIndex view);

/// The middle view of a stack, or its only one.
template <class T>
[[nodiscard]] ViewIndex middle_of(const ViewStack<T>& stack) {
  const ViewIndex middle = stack.grid().center();
  return {stack.first().v + middle.v, stack.first().u + middle.u};
}

/// Notes what a user must know of the file `result` in the place of this light field (fit_of).
/// `remedy` follows the options that fit better.
void note_fit(const std::string& result, const Estimate& estimate, const Scene& scene, Job& job,
              const std::string& remedy = {});

/// Notes reading options, except the focus plane, that one of two results has and the other lacks,
/// if both say how their light field was read.
void note_other_options(const NamedReading& first, const NamedReading& second, Job& job);

/// One light field of many.
struct SceneInput {
  std::string input;           ///< What opens it.
  std::string name;            ///< That no other of them has, for files.
  std::optional<int> frame{};  ///< Of a sequence, if its frames are taken one by one.
};

/// Whether a sequence stands for its frames, or for the one that the reading options name.
enum class Frames { One, All };

/// The light fields that the INPUTs stand for: a folder that is no light field itself stands for
/// those below it, and a sequence for its frames if that is wanted. Throws UsageError for an
/// unknown built-in scene, IoError for a path that does not exist, Cancelled.
[[nodiscard]] std::vector<SceneInput> scene_inputs(const std::vector<std::string>& inputs,
                                                   const ReadOptions& options, Frames frames,
                                                   const Progress& progress);

/// As `scene_inputs`, but an INPUT that cannot be read stands for itself: opening it then says why,
/// and does not stop the others.
[[nodiscard]] std::vector<SceneInput> scene_inputs_and_failed(
    const std::vector<std::string>& inputs, const ReadOptions& options, Frames frames,
    const Progress& progress);

/// Whether an INPUT is a folder that is no light field itself but holds some.
[[nodiscard]] bool is_collection(const std::string& input, const ReadOptions& options,
                                 const Progress& progress);

/// Answers of several light fields.
struct ManyAnswers {
  Json results = Json::array();  ///< What `work` returned, else "input" and "error".
  Failures failures;

  /// Prints all, if they are to be JSON; then throws Error if any failed.
  void finish(Job& job, bool is_json);
};
/// Does `work` for one after the other. One that fails is noted and does not stop the others.
[[nodiscard]] ManyAnswers answers_of_many(
    const std::vector<SceneInput>& scenes, Job& job,
    const std::function<Json(const SceneInput&, const Progress&)>& work);

}  // namespace episcope::cli
