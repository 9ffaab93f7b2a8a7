// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <filesystem>
#include <memory>

namespace episcope::test {

/// What programs do without a window, on small light fields and in a folder of its own.
class Chores {
 public:
  explicit Chores(const std::filesystem::path& folder);

  /// All of it: every form is written and opened; every method runs, its result is written, read
  /// and judged, one run is cancelled, one goes in blocks; views are labeled; a project is saved
  /// and opened; damaged files are refused. `round` changes what is computed. Throws if something
  /// does not go as it should.
  void do_all(int round) const;

 private:
  void exchange_forms() const;
  void estimate(int round) const;
  void estimate_in_blocks() const;
  void cancel_a_run() const;
  void label() const;
  void keep_a_project(int round) const;
  void refuse_damaged_files() const;

  std::filesystem::path folder_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace episcope::test
