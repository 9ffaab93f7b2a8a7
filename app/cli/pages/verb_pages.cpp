// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/pages/verb_pages.h"

#include "app/cli/verbs/verbs.h"
#include "engine/disparity/registry.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <sstream>

namespace episcope::cli {
namespace {

using nlohmann::json;

/// What a verb prints.
json answer_of(const Verb& verb, VerbArguments arguments) {
  arguments.emplace_back("--help-json");
  std::ostringstream answer;
  std::streambuf* const output = std::cout.rdbuf(answer.rdbuf());
  verb.run(arguments, {});
  std::cout.rdbuf(output);
  return json::parse(answer.str());
}

std::vector<OptionPage> options_of(const json& answer) {
  std::vector<OptionPage> options;
  for (const json& each : answer.at("options")) {
    options.push_back({each.at("names"), each.at("value"), each.at("choices"), each.at("help"),
                       each.at("heading")});
  }
  return options;
}

VerbPage page_of(const Verb& verb) {
  const json answer = answer_of(verb, {});
  VerbPage page{verb.name, verb.summary,      answer.at("summary"), answer.at("example"),
                {},        options_of(answer)};
  for (const json& each : answer.at("positionals")) {
    page.positionals.push_back({each.at("name"), each.at("help"), each.at("several")});
  }
  return page;
}

/// The methods of `estimate`: what it declares beyond what it declares without a method.
std::vector<MethodPage> methods_of(const Verb& verb, std::size_t common) {
  std::vector<MethodPage> methods;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    std::vector<OptionPage> options = options_of(answer_of(verb, {info.id}));
    options.erase(options.begin(), options.begin() + static_cast<std::ptrdiff_t>(common));
    methods.push_back({info.id, info.name, info.summary, info.reference, std::move(options)});
  }
  return methods;
}

}  // namespace

std::vector<VerbPage> verb_pages() {
  std::vector<VerbPage> pages;
  for (const Verb& verb : verbs()) {
    VerbPage& page = pages.emplace_back(page_of(verb));
    if (verb.run == run_estimate) page.methods = methods_of(verb, page.options.size());
  }
  return pages;
}

}  // namespace episcope::cli
