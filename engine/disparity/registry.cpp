// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/registry.h"

#include "engine/core/error.h"
#include "engine/disparity/epi_c.h"
#include "engine/disparity/epi_g.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/epi_s.h"
#include "engine/disparity/epi_two_layer.h"
#include "engine/disparity/even_brightness.h"
#include "engine/disparity/kz02.h"
#include "engine/disparity/plane_pm.h"
#include "engine/disparity/stereo.h"

#include <utility>

namespace episcope {
namespace {

std::vector<Estimator> with_even_brightness(std::vector<Estimator> estimators) {
  for (Estimator& estimator : estimators) {
    estimator = seeing_even_brightness(std::move(estimator));
  }
  estimators.push_back(
      plane_pm_estimator());  // evens brightness itself, and again as it learns more
  return estimators;
}

}  // namespace

const std::vector<Estimator>& registered_estimators() {
  // clang-format off
  static const std::vector<Estimator> estimators = with_even_brightness({
      epi_l_estimator(),
      epi_s_estimator(),
      epi_c_estimator(),
      epi_g_estimator(),
      st_av_l_estimator(),
      st_av_s_estimator(),
      st_av_g_estimator(),
      st_ch_l_estimator(),
      st_ch_s_estimator(),
      st_ch_g_estimator(),
      epi_two_layer_estimator(),
      kz02_estimator(),
  });
  // clang-format on
  return estimators;
}

const Estimator& find_estimator(const std::string& id) {
  std::vector<std::string> ids;
  for (const Estimator& estimator : registered_estimators()) {
    if (estimator.info.id == id) return estimator;
    ids.push_back(estimator.info.id);
  }
  throw Unavailable(no_such_name("method", id, ids));
}

}  // namespace episcope
