// SPDX-License-Identifier: BSD-3-Clause
#include "app/about/version_text.h"
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/job.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/run_estimator.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/base/files.h"

#include <exception>
#include <iostream>
#include <new>

namespace {

using namespace episcope;
using namespace episcope::cli;

void run_verb(const std::string& name, const VerbArguments& arguments, std::stop_token stop) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) {
    if (name == verb.name) return verb.run(arguments, std::move(stop));
    names.emplace_back(verb.name);
  }
  throw unknown_name("verb", name, names);
}

void run(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::cerr << program_help();
    throw UsageError("no verb was given; begin with 'episcope-cli info demo'");
  }
  const std::string& first = arguments.front();
  if (first == "--version") {
    std::cout << version_text("episcope-cli", {});
  } else if (first == "help" && arguments.size() == 2 && arguments[1] == "reading") {
    print_reading_help();
  } else if (first == "help" && arguments.size() > 1) {
    run_verb(arguments[1], {"--help"}, {});
  } else if (first == "-h" || first == "--help" || first == "help") {
    std::cout << program_help();
  } else {
    const Interrupt interrupt;
    run_verb(first, {arguments.begin() + 1, arguments.end()}, interrupt.token());
  }
}

int fail(const std::exception& error, int code) {
  std::cerr << "episcope-cli: " << error.what() << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    episcope::io::report_file_size_limit();
    episcope::use_cache_for_scratch();
    episcope::state_built_commit(episcope::kCommit);
    run({argv + 1, argv + argc});
    if (!std::cout.flush()) throw Error("standard output cannot be written");
    return kSuccess;
  } catch (const UsageError& error) {
    return fail(error, kWrongUsage);
  } catch (const Cancelled&) {
    std::cerr << "episcope-cli: cancelled\n";
    return kCancelled;
  } catch (const std::bad_alloc&) {
    return fail(Error(kNotEnoughMemory), kFailed);
  } catch (const std::exception& error) {
    return fail(error, kFailed);
  }
}
