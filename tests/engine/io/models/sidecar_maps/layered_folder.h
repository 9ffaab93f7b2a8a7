// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"

#include <QTemporaryDir>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace episcope::test {

/// A textured square before a textured wall, exact in every view: what is seen of the wall, and
/// what is hidden, differs from view to view. Labels are 2 (square) and 5 (wall).
struct LayeredScene {
  static constexpr float kNear = 1.5F;  ///< Disparity of the square,
  static constexpr float kFar = -0.5F;  ///< and of the wall.
  static constexpr float kA = 60;       ///< Depth is kA/(d + kB).
  static constexpr float kB = 5;
  ViewStack<std::uint8_t> views;
  ViewStack<float> disparity;
  ViewStack<float> depth;
  ViewStack<std::int32_t> labels;

  explicit LayeredScene(GridShape grid = {5, 5}, int height = 60, int width = 72);
};

/// A new folder with files as a test wants them. `name` gives the path of a view's file in the
/// folder, by row and column from 1 on; folders on the way are made.
class LayeredFolder {
 public:
  using Name = std::function<std::string(int row, int column)>;
  /// "{}_{}.png" with row and column.
  [[nodiscard]] static Name named(const std::string& form);

  LayeredScene scene;

  explicit LayeredFolder(GridShape grid = {3, 3}) : scene(grid) {}
  [[nodiscard]] std::filesystem::path path(const std::string& name = {}) const;
  /// Makes the folder that `name` lies in.
  [[nodiscard]] std::filesystem::path place(const std::string& name) const;
  [[nodiscard]] Scene open(const std::string& name = {}, const io::OpenOptions& options = {}) const;

  void write_views(const Name& name) const;
  /// Calls `write(path, number of the view)` for all views.
  void for_views(const Name& name,
                 const std::function<void(const std::filesystem::path&, ViewIndex)>& write) const;

  void write_npy(const Name& name, const ViewStack<float>& maps, double factor = 1) const;
  void write_npy(const Name& name, const ViewStack<std::int32_t>& maps, int add = 0) const;
  /// The map of one view.
  void write_npy(const std::string& name, ImageView<const float> map, double factor = 1) const;
  void write_npy(const std::string& name, ImageView<const std::int32_t> map, int add = 0) const;
  /// Labels as pictures: `color(label)`.
  void write_colors(const std::string& name, ImageView<const std::int32_t> map,
                    const std::function<Rgb(int)>& color) const;

 private:
  std::unique_ptr<QTemporaryDir> folder_ = std::make_unique<QTemporaryDir>();
};

/// How many files the report counts as this kind, used or not; 0 if it does not know the kind.
[[nodiscard]] int count_used(const Scene& scene, const std::string& kind);
[[nodiscard]] int count_unused(const Scene& scene, const std::string& kind);
/// Whether a warning of the report contains this text.
[[nodiscard]] bool warns_of(const Scene& scene, const std::string& text);

}  // namespace episcope::test
