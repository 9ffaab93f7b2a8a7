// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::io {

/// From now on a file that grows beyond what the process may write (`ulimit -f`, limits of a batch
/// system) is an error of the write (EFBIG, which `write_error` puts in words). By default the
/// signal SIGXFSZ ends the program and leaves what is unfinished behind. For `main`.
void report_file_size_limit();

}  // namespace episcope::io
