// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/file_size_limit.h"

#include <csignal>

namespace episcope::io {

void report_file_size_limit() {
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace episcope::io
