// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/compare/tile_pictures.h"
#include "app/gui/frame/jobs.h"
#include "app/session/open_scene.h"
#include "app/session/session.h"
#include "widgets/style/side.h"

#include <QObject>

#include <vector>

namespace episcope {

class CompareBar;
class TileWall;
class ViewCanvas;

/// Arranges results for comparison: wipe, side by side, or a wall of all.
class CompareController : public QObject {
  Q_OBJECT

 public:
  CompareController(const Workbench& bench, CompareBar* bar);

  /// Ignored if there is nothing to compare. Choosing the current mode again leaves it.
  void toggleMode(CompareMode mode);
  void setMode(CompareMode mode);
  [[nodiscard]] CompareMode mode() const { return mode_; }
  /// Whether a mode has something to show now.
  [[nodiscard]] bool isAvailable(CompareMode mode) const;
  /// Back to the single picture; false if it is there already.
  bool leave();
  /// Shows A − B instead of the quantity, which ends a wipe.
  void toggleDifference();

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
  [[nodiscard]] QString captionOf(const EstimateEntry& entry) const;
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
