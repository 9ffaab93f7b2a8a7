// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/undecided.h"

#include <fmt/format.h>

#include <utility>

namespace episcope::io {
namespace {

std::string alternatives(const std::string& option, const std::vector<ReadingChoice>& choices) {
  std::string text;
  for (const ReadingChoice& choice : choices) {
    text += fmt::format("{}--{} {} ({})", text.empty() ? "" : ", or ", option, choice.value,
                        choice.label);
  }
  return text;
}

}  // namespace

Undecided::Undecided(const std::filesystem::path& path, const std::string& reason,
                     std::string option, std::vector<ReadingChoice> choices)
    : IoError(path, reason + "; give " + alternatives(option, choices)),
      reason_(reason),
      option_(std::move(option)),
      choices_(std::move(choices)) {}

}  // namespace episcope::io
