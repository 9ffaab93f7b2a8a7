// SPDX-License-Identifier: BSD-3-Clause
// The window in a day's work, measured: `window_day use SECONDS`, `window_day rest SECONDS`,
// `window_day soak ROUNDS`, `window_day large LF.h5` (made by big_light_field), `window_day idle
// SECONDS`. Needs a display, or QT_QPA_PLATFORM=offscreen. Measures and does not judge.
#include "tests/bench/window/timed_application.h"
#include "tests/bench/window/use.h"

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
  using namespace episcope;
  bench::TimedApplication application(argc, argv);
  const std::string what = argc == 3 ? argv[1] : "";
  if (what == "use") {
    bench::measure_use(application, std::atof(argv[2]), true);
  } else if (what == "rest") {
    bench::measure_use(application, std::atof(argv[2]), false);
  } else if (what == "soak") {
    bench::measure_soak(std::atoi(argv[2]));
  } else if (what == "large") {
    bench::measure_large(argv[2]);
  } else if (what == "idle") {
    bench::measure_idle(std::atof(argv[2]));
  } else {
    std::fputs(
        "usage: window_day use SECONDS | rest SECONDS | soak ROUNDS | large LF.h5 | idle SECONDS\n",
        stderr);
    return 2;
  }
  return 0;
}
