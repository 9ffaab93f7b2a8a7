// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/judge.h"
#include "app/session/open_scene.h"
#include "app/session/quantity_map.h"
#include "engine/render/quantity.h"

#include <QObject>

#include <optional>
#include <vector>

namespace episcope {

class StatisticsPanel;

/// Computes statistics of the visible part of the shown map in the background, and the automatic
/// color range.
class StatisticsController : public QObject {
  Q_OBJECT

 public:
  StatisticsController(const Workbench& bench, StatisticsPanel* panel);

  /// Stretches the colors over the visible values, as soon as they are known.
  void useAutomaticRange();
  /// Statistics of the visible part; none while unknown.
  [[nodiscard]] const std::optional<render::RegionStatistics>& statistics() const {
    return statistics_;
  }

 private:
  struct Counted {
    render::RegionStatistics statistics;
    std::optional<double> bad_percent;
  };
  void addCommands();
  void begin();
  [[nodiscard]] bool areLabelsDrawn() const;
  void count(const PixelRect& region);
  void show(const Counted& counted);
  void applyAutomaticRange();

  Workbench bench_;
  Overlay& overlay_;
  StatisticsPanel* panel_;
  LatestJob job_;
  QuantityMapPtr map_;  // what the statistics are of
  PixelRect region_;
  MapChoice choice_;
  std::optional<render::RegionStatistics> statistics_;
  bool wants_range_ = false;
};

}  // namespace episcope
