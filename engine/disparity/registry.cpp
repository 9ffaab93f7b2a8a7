// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/registry.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/disparity/epi_c.h"
#include "engine/disparity/epi_g.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/epi_s.h"
#include "engine/disparity/epi_two_layer.h"
#include "engine/disparity/kz02.h"
#include "engine/disparity/net_method.h"
#include "engine/disparity/plane_pm.h"
#include "engine/disparity/stereo.h"

#include <algorithm>

namespace episcope {

const std::vector<Estimator>& registered_estimators() {
  // clang-format off
  static const std::vector<Estimator> estimators = {
      epi_l_estimator(),
      epi_s_estimator(),
      epi_c_estimator(),
      epi_g_estimator(),
      stereo_local_estimator(MatchedViews::All),
      stereo_smooth_estimator(MatchedViews::All),
      stereo_global_estimator(MatchedViews::All),
      stereo_local_estimator(MatchedViews::CrossHair),
      stereo_smooth_estimator(MatchedViews::CrossHair),
      stereo_global_estimator(MatchedViews::CrossHair),
      epi_two_layer_estimator(),
      kz02_estimator(),
      plane_pm_estimator(),
      net_estimator(),
  };
  // clang-format on
  return estimators;
}

const Estimator* known_estimator(const std::string& id) {
  const std::vector<Estimator>& all = registered_estimators();
  const auto found =
      std::ranges::find(all, lower_case(id),
                        [](const Estimator& each) -> const std::string& { return each.info.id; });
  return found != all.end() ? &*found : nullptr;
}

std::vector<std::string> estimator_ids() {
  std::vector<std::string> ids;
  for (const Estimator& each : registered_estimators()) ids.push_back(each.info.id);
  return ids;
}

const Estimator& find_estimator(const std::string& id) {
  if (const Estimator* const known = known_estimator(id)) return *known;
  throw Unavailable(no_such_name("method", id, estimator_ids()));
}

}  // namespace episcope
