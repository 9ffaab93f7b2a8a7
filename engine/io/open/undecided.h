// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <string>
#include <vector>

namespace episcope::io {

/// One of several ways in which a light field can be read.
struct ReadingChoice {
  std::string value;  ///< Of the option, as on a command line: "1x49".
  std::string label;  ///< In words: "49 views in a row".
};

/// A light field that can be read in several ways, none of which is certain: a reader never
/// guesses. The message names the option (`open_schema`) that decides; a window asks.
class Undecided : public IoError {
 public:
  /// `reason`: what is not certain, and why. The option and its values are added to it.
  Undecided(const std::filesystem::path& path, const std::string& reason, std::string option,
            std::vector<ReadingChoice> choices);

  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const std::string& option() const { return option_; }
  [[nodiscard]] const std::vector<ReadingChoice>& choices() const { return choices_; }

 private:
  std::string reason_;
  std::string option_;
  std::vector<ReadingChoice> choices_;
};

}  // namespace episcope::io
