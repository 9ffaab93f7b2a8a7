// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/usage_error.h"
#include "app/cli/exit_code.h"
#include "app/cli/interrupt.h"
#include "app/cli/verbs/verbs.h"
#include "engine/core/version.h"

#include <exception>
#include <iostream>
#include <new>

namespace {

using namespace episcope;
using namespace episcope::cli;

void print_help(std::ostream& out) {
  out << "Estimates and evaluates disparity in 4D light fields.\n"
         "Usage: episcope-cli VERB ...\n\n"
         "INPUT is an lf.h5, a scene folder of the 2013 archive, a folder of the 2016 benchmark,\n"
         "a folder of images on a grid, demo, or demo:<scene> for a built-in scene.\n\nVerbs:\n";
  for (const Verb& verb : verbs()) {
    out << "  " << verb.name << std::string(12 - std::string(verb.name).size(), ' ') << verb.summary
        << '\n';
  }
  out << "\nOptions:\n  -h,--help   Print this help, or after a verb its help, and exit\n"
         "  --version   Print the version and exit\n\n"
         "Example:\n  episcope-cli estimate epi_s demo -o demo.h5\n"
         "  episcope-cli evaluate demo.h5 --truth demo\n";
}

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
    print_help(std::cerr);
    throw UsageError("no verb was given; begin with 'episcope-cli info demo'");
  }
  const std::string& first = arguments.front();
  if (first == "--version") {
    std::cout << "episcope-cli " << kVersion << '\n';
  } else if (first == "-h" || first == "--help" || first == "help") {
    print_help(std::cout);
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
    run({argv + 1, argv + argc});
    if (!std::cout.flush()) throw Error("standard output cannot be written");
    return kSuccess;
  } catch (const UsageError& error) {
    return fail(error, kWrongUsage);
  } catch (const Cancelled&) {
    std::cerr << "episcope-cli: cancelled\n";
    return kCancelled;
  } catch (const std::bad_alloc&) {
    return fail(Error("not enough memory for this light field"), kFailed);
  } catch (const std::exception& error) {
    return fail(error, kFailed);
  }
}
