// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace episcope::cli {

/// An option as it is declared.
struct OptionPage {
  std::vector<std::string> names;    ///< "-o", "--output".
  std::string value;                 ///< "OUT.h5"; empty for a flag.
  std::vector<std::string> choices;  ///< Where only certain words are values.
  std::string help;
  std::string heading;
};

struct PositionalPage {
  std::string name;
  std::string help;
  bool several = false;
};

/// A method of `estimate`, with the options that are its parameters.
struct MethodPage {
  std::string id;
  std::string name;
  std::string summary;
  std::string reference;
  std::vector<OptionPage> parameters;
};

/// A verb as it declares itself.
struct VerbPage {
  std::string name;
  std::string summary;      ///< Of the table of verbs, one line.
  std::string description;  ///< Of the verb's help, several lines.
  std::string example;      ///< One or more lines.
  std::vector<PositionalPage> positionals;
  std::vector<OptionPage> options;
  std::vector<MethodPage> methods{};  ///< Of `estimate`.
};

/// Every verb, in the order of the help, asked for its `--help-json`.
[[nodiscard]] std::vector<VerbPage> verb_pages();

/// Completion of verbs, options, methods with their parameters, and the words that options take;
/// where none of these is asked for, of files.
[[nodiscard]] std::string bash_completion(const std::vector<VerbPage>& verbs);
[[nodiscard]] std::string zsh_completion(const std::vector<VerbPage>& verbs);
[[nodiscard]] std::string fish_completion(const std::vector<VerbPage>& verbs);

/// The page of the manual of `episcope-cli`, in troff.
[[nodiscard]] std::string program_man_page(const std::vector<VerbPage>& verbs);
/// Page of one verb, `episcope-cli-estimate`.
[[nodiscard]] std::string verb_man_page(const VerbPage& verb);
/// Page of the window, around what its `--help` prints.
[[nodiscard]] std::string window_man_page(const std::string& help);

}  // namespace episcope::cli
