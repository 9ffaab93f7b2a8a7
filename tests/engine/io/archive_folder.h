// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/scene.h"
#include "engine/io/open.h"

#include <QString>
#include <QTemporaryDir>

#include <memory>
#include <string>

namespace episcope::test {

/// Depth is stored as float: with d + shift about 5 a relative error of 6e-8 moves d by 3e-7 px.
constexpr double kDepthRounding = 2e-6;

/// A folder for the archive files of one test, new after each `renew`.
class ArchiveFolder {
 public:
  void renew() { folder_ = std::make_unique<QTemporaryDir>(); }
  [[nodiscard]] std::filesystem::path path() const { return folder_->path().toStdString(); }
  [[nodiscard]] std::filesystem::path path(const char* name) const { return path() / name; }
  [[nodiscard]] static Scene open(const std::filesystem::path& file,
                                  const io::OpenOptions& options = {}) {
    return io::open_scene(file, options, Progress(2));
  }

 private:
  std::unique_ptr<QTemporaryDir> folder_;
};

/// What test classes of files that are pictures derive from: files by name in a folder that is new
/// after each `renew`.
class PictureFolder {
 protected:
  void renew() { folder_.renew(); }
  [[nodiscard]] std::filesystem::path path(const std::string& name = "") const {
    return folder_.path() / name;
  }
  [[nodiscard]] Scene open(const std::string& name, const io::OpenOptions& options = {}) const {
    return ArchiveFolder::open(path(name), options);
  }
  /// Why it is not opened; empty if it is.
  [[nodiscard]] QString refusal_of(const std::string& name,
                                   const io::OpenOptions& options = {}) const {
    try {
      (void)open(name, options);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  }

 private:
  ArchiveFolder folder_;
};

}  // namespace episcope::test
