// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/picture.h"
#include "app/session/quantity_map.h"
#include "app/session/session.h"
#include "engine/core/progress.h"
#include "widgets/controls/theme.h"

#include <QImage>
#include <QObject>

#include <vector>

namespace episcope {

class CompareBar;
class TileWall;
class ViewCanvas;

struct TileRequest {
  LightFieldPtr light_field;
  ViewIndex view;
  std::optional<MapSource> source;
  render::Shading shading;
  OverlayLook look{};  ///< Of the map.
  render::Tone tone{};
};
/// Whether two requests give the same picture.
[[nodiscard]] bool is_same(const TileRequest& a, const TileRequest& b);

struct TilePicture {
  QImage picture;      ///< View and map in one, RGB32: quickly drawn.
  QuantityMapPtr map;  ///< Null without a map.
};

/// Arranges results for comparison: wipe, side by side, or a wall of all results.
class CompareController : public QObject {
  Q_OBJECT

 public:
  CompareController(const Workbench& bench, CompareBar* bar);

  /// Ignored if there is nothing to compare. Choosing the current mode again ends it.
  void toggleMode(CompareMode mode) { setMode(mode_ == mode ? CompareMode::Single : mode); }
  void setMode(CompareMode mode);
  [[nodiscard]] CompareMode mode() const { return mode_; }
  /// Whether a mode has something to show now.
  [[nodiscard]] bool isAvailable(CompareMode mode) const;
  /// Returns to the single picture; false if it is shown already.
  bool leave();

 private:
  struct Entry {
    quint64 id;
    QString caption;
    Side side;
    TileRequest request;
    TilePicture picture;
    bool is_view = false;  ///< And no map.
  };

  void showComparison(CompareMode mode);
  void keep();
  void restore();
  void addCommands();
  void addOverlayCommands();
  void addChoiceCommands();
  void addPairCommands();
  void addModeCommands();
  void connectWall();
  void update(Parts parts);
  void listChoices();
  void showMode();
  void showWipe();
  void showTiles();
  void fillWall();
  [[nodiscard]] TileRequest request(const std::optional<MapChoice>& choice) const;
  [[nodiscard]] std::vector<Entry> sides() const;
  [[nodiscard]] std::vector<Entry> everything() const;
  [[nodiscard]] QString withRange(const QString& caption, render::Quantity quantity) const;
  [[nodiscard]] QString captionOf(const EstimateEntry& entry, const MapChoice& choice) const;
  void open(quint64 tile);

  Workbench bench_;
  Session& session_;
  Overlay& overlay_;
  ViewCanvas* canvas_;
  TileWall* wall_;
  CompareBar* bar_;
  CompareMode mode_ = CompareMode::Single;
  double wipe_position_ = 0.5;
  QImage wipe_picture_;  // of B, until the next one is made
  std::vector<Entry> entries_;
  LatestJob tile_job_;
};

}  // namespace episcope

namespace episcope::compare_section {

// Sections of the menu Compare, in their order.
inline constexpr int kChoice = 0;
inline constexpr int kRange = 1;
inline constexpr int kModes = 2;

}  // namespace episcope::compare_section
