// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/verbs.h"

namespace episcope::cli {
namespace {

constexpr Verb kVerbs[] = {
    {"info", "What a light field holds, and how it was read", run_info},
    {"methods", "Every estimator with its parameters", run_methods},
    {"estimate", "Estimate disparity and write a result file", run_estimate},
    {"evaluate", "Judge results against the truth", run_evaluate},
    {"show", "Write a picture of a light field or a result", run_show},
    {"convert", "Write a light field or a result in another format", run_convert},
    {"synthesize", "Render a built-in scene with exact truth", run_synthesize},
    {"label", "Segment a light field by what is painted on it", run_label},
    {"benchmark", "Rank methods over scenes: tables, pictures, parameter search", run_benchmark},
};

}  // namespace

std::span<const Verb> verbs() {
  return kVerbs;
}

}  // namespace episcope::cli
