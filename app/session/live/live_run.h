// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/live/live_source.h"
#include "app/session/run/run_estimator.h"

#include <functional>

namespace episcope {

/// What is looked at while parameters are tried: an immutable snapshot.
struct LiveRequest {
  LightFieldPtr light_field;
  std::string method;
  ParameterSet parameters;
  ViewIndex view;
  PixelRect in_sight{};  ///< Of the view; empty = all of it.
  friend bool operator==(const LiveRequest&, const LiveRequest&) = default;
};

/// An answer to it.
struct LiveMap {
  EstimatePtr estimate;      ///< Of the view of the request, or of all; parameters as asked for.
  Interval display_range{};  ///< Disparities that most pixels lie in.
  PixelRect part{};          ///< The pixels estimated; empty = all.
  bool is_coarse = false;    ///< Made from views of a quarter of the size.
  double seconds = 0;        ///< Wall-clock time since the request was taken up.
};

/// Estimates what is in sight in one view: a method with a parameter `view` that is auto is run for
/// it, one that estimates all views at once for all of them unless the view is the centre; others
/// give the view that they are of. `on_coarse` gets a map at a quarter of the size first, where
/// that leaves enough pixels and the method accepts it. On a GPU all pixels are estimated at once.
/// `source` is that of the request's light field. Throws what the method throws, Unavailable for an
/// unknown one.
[[nodiscard]] LiveMap estimate_live(LiveSource& source, const LiveRequest& request,
                                    const std::function<void(LiveMap)>& on_coarse,
                                    const Progress& progress);

}  // namespace episcope
