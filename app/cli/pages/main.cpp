// SPDX-License-Identifier: BSD-3-Clause
// episcope_pages DIR [HELP]: writes man/*.1 and the completions of bash, zsh and fish below DIR;
// with HELP, a file of what the window prints for --help, its page too.
#include "app/cli/pages/verb_pages.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace {

using namespace episcope::cli;

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  if (!(file << text).flush()) throw std::runtime_error(path.string() + " cannot be written");
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  if (!(text << std::ifstream(path).rdbuf())) {
    throw std::runtime_error(path.string() + " cannot be read or is empty");
  }
  return text.str();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2 || argc > 3) throw std::runtime_error("usage: episcope_pages DIR [HELP]");
    const std::filesystem::path folder = argv[1];
    const std::vector<VerbPage> verbs = verb_pages();
    write(folder / "man/episcope-cli.1", program_man_page(verbs));
    for (const VerbPage& verb : verbs) {
      write(folder / ("man/episcope-cli-" + verb.name + ".1"), verb_man_page(verb));
    }
    if (argc == 3) write(folder / "man/episcope.1", window_man_page(text_of(argv[2])));
    write(folder / "bash/episcope-cli", bash_completion(verbs));
    write(folder / "zsh/_episcope-cli", zsh_completion(verbs));
    write(folder / "fish/episcope-cli.fish", fish_completion(verbs));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "episcope_pages: " << error.what() << '\n';
    return 1;
  }
}
