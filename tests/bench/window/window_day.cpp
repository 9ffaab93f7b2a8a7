// SPDX-License-Identifier: BSD-3-Clause
// The window in a day's work, measured: `window_day use SECONDS [STROKES]`, `window_day rest
// SECONDS [STROKES]`, `window_day soak ROUNDS`, `window_day large LF.h5` (made by big_light_field),
// `window_day idle SECONDS`. STROKES are painted on each light field before. Needs a display, or
// QT_QPA_PLATFORM=offscreen. Measures and does not judge.
#include "tests/bench/window/timed_application.h"
#include "tests/bench/window/use.h"

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
  using namespace episcope;
  bench::TimedApplication application(argc, argv);
  const std::string what = argc >= 3 ? argv[1] : "";
  if (what == "use" || what == "rest") {
    const int strokes = argc > 3 ? std::atoi(argv[3]) : 0;
    bench::measure_use(application, std::atof(argv[2]), strokes, what == "use");
  } else if (what == "soak") {
    bench::measure_soak(std::atoi(argv[2]));
  } else if (what == "large") {
    bench::measure_large(argv[2]);
  } else if (what == "idle") {
    bench::measure_idle(std::atof(argv[2]));
  } else {
    std::fputs(
        "usage: window_day use SECONDS [STROKES] | rest SECONDS [STROKES] | soak ROUNDS | "
        "large LF.h5 | idle SECONDS\n",
        stderr);
    return 2;
  }
  return 0;
}
