// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace episcope::test {

/// One of the two things that are saved in turn: they differ in every file.
enum class Variant { A, B };

/// Something that the program saves.
struct Saver {
  std::string name;
  std::string file;        ///< What is written is called so,
  bool is_folder = false;  ///< and if it is a folder, it must not be there before.
  std::function<void(const std::filesystem::path&, Variant)> save;
};

/// All there are: every form of light fields, results, labels, strokes, maps, clouds, movies, logs,
/// projects, and the files of a capture.
[[nodiscard]] std::vector<Saver> savers();

}  // namespace episcope::test
