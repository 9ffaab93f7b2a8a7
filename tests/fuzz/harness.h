// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/progress.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace episcope::fuzz {

/// A form of files that is fuzzed. Each fuzzer defines one, `kHarness`; the rest is harness.cpp.
struct Harness {
  /// The name of the file that holds the input; where a form has several suffixes, the bytes tell.
  std::string (*name_of)(std::string_view bytes);
  /// Reads the file by the functions that programs call. Errors of the project may be thrown.
  void (*read)(const std::filesystem::path& file);
  /// Writes good files, from which the fuzzer begins, into an empty folder.
  void (*write_seeds)(const std::filesystem::path& folder);
  /// Writes what lies beside the file, once; null = nothing.
  void (*prepare)(const std::filesystem::path& folder) = nullptr;
};
extern const Harness kHarness;

/// Whether this input goes all the way, as one of 64, told by their hash, does: where a light field
/// is opened by files that stay the same, most inputs are only read.
[[nodiscard]] bool is_read_whole();

/// For reading a light field out of this input, on one thread. Of most inputs it stops when all
/// samples are read: whether their order is right is asked of the pixels and takes ten times as
/// long, in code that no byte of a header reaches. Those that are read whole go on.
[[nodiscard]] Progress progress_of_reading();

/// Calls `read`, which may refuse the input or be stopped.
template <class Read>
void tolerate(const Read& read) {
  try {
    read();
  } catch (const Error&) {
    return;  // a sentence is a good answer
  } catch (const Cancelled&) {
    return;
  }
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes);

}  // namespace episcope::fuzz
