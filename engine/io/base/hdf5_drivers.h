// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope::io {

/// Makes files opened with the access property list `access`, for reading, be read without the
/// memory that HDF5 keeps of metadata: 1.10 crashes on some damaged files with it. Two openings of
/// a file have nothing in common. The caller must hold the lock of the library.
void use_read_driver(std::int64_t access);

/// What went wrong on the way to the disk.
struct Hdf5WriteLog {
  int first_error = 0;  ///< `errno` of the first failed system call; 0 = none.
};

/// Makes files created or opened with the access property list `access` tell HDF5 that every write
/// succeeded, and note the first failure in `log`, which must outlive the file; nothing is written
/// after that. HDF5 1.10 cannot close a file whose last writes fail and crashes at exit, as on a
/// full disk. The caller must hold the lock of the library.
void use_logging_write_driver(std::int64_t access, Hdf5WriteLog& log);

}  // namespace episcope::io
