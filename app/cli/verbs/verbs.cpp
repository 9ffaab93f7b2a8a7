// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/verbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace episcope::cli {
namespace {

constexpr Verb kVerbs[] = {
    {"info", "Describe a light field and how it was read", run_info},
    {"list", "List every light field below a folder", run_list},
    {"methods", "List every estimator with its parameters", run_methods},
    {"estimate", "Estimate disparity and write a result file", run_estimate},
    {"evaluate", "Compare results with the ground truth", run_evaluate},
    {"show", "Write a picture of a light field or a result", run_show},
    {"convert", "Convert a light field or a result to another format", run_convert},
    {"synthesize", "Render a built-in scene with exact ground truth", run_synthesize},
    {"label", "Segment a light field from scribbles", run_label},
    {"benchmark", "Rank methods over scenes: tables, pictures, parameter search", run_benchmark},
    {"decode", "Make a light field of a raw picture of a plenoptic camera", run_decode},
    {"calibrate", "Calibrate a camera from photographs of a pattern", run_calibrate},
    {"rectify", "Make a light field of photographs taken on a grid", run_rectify},
    {"pose", "Find where a mesh lies before the camera", run_pose},
    {"ground-truth", "Add the exact depth of meshes to a light field", run_ground_truth},
    {"validate", "Check a submission to the 2016 benchmark", run_validate},
};

}  // namespace

std::span<const Verb> verbs() {
  return kVerbs;
}

std::string program_help() {
  std::string text =
      fmt::format("{}\nUsage: episcope-cli VERB ...\n\n{}\nVerbs:\n", kProgramSummary, kInputHelp);
  std::size_t longest = 0;
  for (const Verb& verb : verbs()) longest = std::max(longest, std::string_view(verb.name).size());
  for (const Verb& verb : verbs()) {
    text += fmt::format("  {:<{}}  {}\n", verb.name, longest, verb.summary);
  }
  text +=
      "\nOptions:\n  -h,--help   Print this help, or after a verb its help, and exit\n"
      "  --version   Print version, commit and libraries, and exit\n\nMore help:\n"
      "  help VERB     Tell the options of a verb\n"
      "  help reading  Tell how INPUT can be read otherwise\n\nExample:\n";
  return text + kProgramExample;
}

}  // namespace episcope::cli
