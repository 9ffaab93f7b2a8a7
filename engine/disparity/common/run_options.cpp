// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/run_options.h"

namespace episcope {
namespace {

constexpr int kMaxThreads = 1024;

}  // namespace

Names<ViewSelection> names_of(ViewSelection) {
  return {{ViewSelection::Center, "center"}, {ViewSelection::All, "all"}};
}

Names<Device> names_of(Device) {
  return {{Device::Auto, "auto"}, {Device::Cpu, "cpu"}, {Device::Cuda, "cuda"}};
}

Schema<RunOptions> run_schema() {
  Schema<RunOptions> schema;
  schema
      .choice("views", &RunOptions::views,
              {"Views", "Views to estimate; by default all views if the method supports it"})
      .choice("device", &RunOptions::device, {"Device", "Device to compute on"})
      .integer("threads", &RunOptions::threads,
               {"Threads", "Number of threads; 0 = one per processor"}, {0, kMaxThreads});
  return schema;
}

}  // namespace episcope
