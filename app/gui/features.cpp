// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/features.h"

#include "app/gui/annotate/annotate.h"
#include "app/gui/browse/browse.h"
#include "app/gui/capture/capture.h"
#include "app/gui/cloud/cloud.h"
#include "app/gui/collection/collection.h"
#include "app/gui/compare/compare.h"
#include "app/gui/estimate/estimate.h"
#include "app/gui/files/files.h"
#include "app/gui/help/help.h"
#include "app/gui/measure/measure.h"
#include "app/gui/project/project.h"
#include "app/gui/review/review.h"
#include "app/gui/segment/segment.h"

namespace episcope {

std::span<const Feature> features() {
  static constexpr Feature kFeatures[] = {{"files", add_files},
                                          {"project", add_project},
                                          {"browse", add_browsing},
                                          {"estimate", add_estimating},
                                          {"compare", add_comparing},
                                          {"annotate", add_annotating},
                                          {"segment", add_segmenting},
                                          {"cloud", add_cloud},
                                          {"collection", add_collection},
                                          {"review", add_reviewing},
                                          {"capture", add_capture},
                                          {"measure", add_measuring},
                                          {"help", add_help}};
  return kFeatures;
}

}  // namespace episcope
