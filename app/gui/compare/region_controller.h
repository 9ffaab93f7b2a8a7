// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/judge.h"
#include "app/session/open_scene.h"
#include "app/session/session.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "widgets/canvas/canvas_tool.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

class RegionBar;

/// Mask of evaluated pixels; null = all.
using RegionPtr = std::shared_ptr<const Image<std::uint8_t>>;

/// Chooses the region that metrics evaluate, per open light field: the whole view, a rectangle, the
/// current label, the pixels with a value in every result, a region mask of the ground truth, or a
/// mask file.
class RegionController : public QObject {
  Q_OBJECT

 public:
  RegionController(const Workbench& bench, RegionBar* bar);
  ~RegionController() override;

  /// Mask of the view's size; null = everywhere.
  [[nodiscard]] const RegionPtr& region() const { return region_; }
  /// "whole view", "rectangle x 10–49, y 20–59", "label sky": for tables.
  [[nodiscard]] QString name() const;

  /// Makes the next drag on the view draw a rectangle.
  void beginRectangle();
  void useMask(const QString& path);

 signals:
  void changed();

 private:
  struct Mask {
    std::string path;
    RegionPtr pixels;  ///< Null while it is being read.
  };

  void addCommands(RegionBar& bar);
  void connectTool();
  void listParts();
  void choosePart(int row);
  void choose(JudgedPixels pixels);
  void askForMask();
  void readMask(std::uint64_t scene, const std::string& path);
  void takeMask(std::uint64_t scene, const std::string& path, const RegionPtr& mask);
  void dropMask(std::uint64_t scene, const std::string& path);
  void endRectangle();
  void update(Parts parts);
  void refresh();
  void showOutline();
  [[nodiscard]] const JudgedPart& now() const { return bench_.session.place().judged; }
  void set(const JudgedPart& part) { bench_.session.set_judged(bench_.session.generation(), part); }
  [[nodiscard]] RegionPtr makeRegion();
  [[nodiscard]] RegionPtr maskRegion();
  [[nodiscard]] RegionPtr truthRegion() const;
  [[nodiscard]] int rowOfPart() const;
  [[nodiscard]] RegionPtr labelRegion() const;
  [[nodiscard]] RegionPtr commonRegion() const;
  [[nodiscard]] PixelRect clipped(PixelRect rectangle) const;

  Workbench bench_;
  RegionBar* bar_;
  RectangleTool* tool_;
  CanvasTool* former_tool_ = nullptr;
  std::map<std::uint64_t, Mask> masks_;  // by scene
  std::vector<std::string> regions_;     // of the ground truth, in the list behind the others
  RegionPtr region_;
};

}  // namespace episcope
