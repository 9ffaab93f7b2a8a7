// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/jobs.h"
#include "app/gui/overlay_controller.h"
#include "app/gui/panels.h"
#include "app/session/session.h"
#include "engine/render/region_statistics.h"

#include <QObject>

#include <optional>

namespace episcope {

/// Sums up in the background what is in sight of the shown map, and sets its colour range from it.
class StatisticsController : public QObject {
  Q_OBJECT

 public:
  StatisticsController(Session& session, OverlayController& overlay, const Panels& panels,
                       QObject* parent);

  /// Stretches the colours over the values in sight; at once, or as soon as they are known.
  void useAutomaticRange();
  /// Of what is in sight; none while it is not known.
  [[nodiscard]] const std::optional<render::RegionStatistics>& statistics() const {
    return statistics_;
  }

 signals:
  void updated();

 private:
  struct Counted {
    render::RegionStatistics statistics;
    std::optional<double> bad_percent;
  };
  void begin();
  void show(const Counted& counted);
  void applyAutomaticRange();

  Session& session_;
  OverlayController& overlay_;
  Panels panels_;
  LatestJob job_;
  QuantityMapPtr map_;  // what the statistics are of
  PixelRect region_;
  MapChoice choice_;
  std::optional<render::RegionStatistics> statistics_;
  bool wants_range_ = false;
};

}  // namespace episcope
