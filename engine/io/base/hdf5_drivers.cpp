// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_drivers.h"

#include <H5FDpublic.h>
#include <hdf5.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace episcope::io {
namespace {

struct DriverInfo {
  Hdf5WriteLog* log;
};

/// An open file; HDF5 sees its first member only.
struct DriverFile {
  H5FD_t base;
  int descriptor;
  haddr_t end_of_space;  ///< Of what HDF5 has given out,
  haddr_t end_of_file;   ///< and of what is there.
  Hdf5WriteLog* log;     ///< Null of a file that is only read.
};

DriverFile& own(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& own(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

void note_failure(DriverFile& file) {
  if (file.log->first_error == 0) file.log->first_error = errno == 0 ? EIO : errno;
}

H5FD_t* new_file(int descriptor, haddr_t size, Hdf5WriteLog* log) {
  auto file = std::make_unique<DriverFile>();
  file->descriptor = descriptor;
  file->end_of_file = size;
  file->log = log;
  return &file.release()->base;
}

H5FD_t* open_to_read(const char* name, unsigned flags, hid_t, haddr_t) {
  if ((flags & (H5F_ACC_RDWR | H5F_ACC_TRUNC)) != 0) return nullptr;
  const int descriptor = ::open(name, O_RDONLY | O_CLOEXEC);
  struct stat facts {};
  if (descriptor < 0) return nullptr;
  if (::fstat(descriptor, &facts) != 0) {
    ::close(descriptor);
    return nullptr;
  }
  return new_file(descriptor, static_cast<haddr_t>(facts.st_size), nullptr);
}

H5FD_t* open_to_write(const char* name, unsigned flags, hid_t access, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr || (flags & H5F_ACC_RDWR) == 0) return nullptr;
  const bool is_new = (flags & H5F_ACC_TRUNC) != 0;
  const int descriptor = ::open(name, O_RDWR | O_CLOEXEC | (is_new ? O_CREAT | O_TRUNC : 0), 0666);
  struct stat facts {};
  if (descriptor < 0 || ::fstat(descriptor, &facts) != 0) {
    info->log->first_error = errno;
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  return new_file(descriptor, static_cast<haddr_t>(facts.st_size), info->log);
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<DriverFile> file(&own(base));
  if (::close(file->descriptor) != 0 && file->log != nullptr) note_failure(*file);
  return 0;
}

int compare_files(const H5FD_t* a, const H5FD_t* b) {
  return own(a).descriptor - own(b).descriptor;
}

herr_t query_features(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

/// Not to keep what was read of metadata: in damaged files HDF5 1.10 reads beyond that.
herr_t query_features_of_reading(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_space(const H5FD_t* base, H5FD_mem_t) {
  return own(base).end_of_space;
}

herr_t set_end_of_space(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  own(base).end_of_space = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* base, H5FD_mem_t) {
  return own(base).end_of_file;
}

std::uint64_t little_endian(const unsigned char* bytes, int count) {
  std::uint64_t value = 0;
  while (count-- > 0) value = value << 8 | bytes[count];
  return value;
}

/// Whether the objects of a collection of texts of variable length ("global heap"), as far as
/// `bytes` shows it, lie within the collection: HDF5 1.10 copies beyond it otherwise. With sizes of
/// 8 bytes, as all but the oddest files have them.
bool is_sound_heap(const unsigned char* bytes, std::size_t count) {
  constexpr std::uint64_t head = 16;
  if (count < head || std::memcmp(bytes, "GCOL\1\0\0\0", 8) != 0) return true;  // none
  const std::uint64_t end = little_endian(bytes + 8, 8);
  for (std::uint64_t at = head; at + head <= std::min<std::uint64_t>(end, count);) {
    const bool is_free = little_endian(bytes + at, 2) == 0;
    const std::uint64_t size = little_endian(bytes + at + 8, 8);
    if (size > end - at - (is_free ? 0 : head)) return false;
    if (is_free) return true;
    at += head + (size + 7) / 8 * 8;
  }
  return true;
}

/// Beyond what reached the disk everything reads as zero.
herr_t read_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
  auto* out = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t count = ::pread(own(base).descriptor, out, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && own(base).log == nullptr) return -1;
    if (count <= 0) {
      if (count < 0) note_failure(own(base));
      std::memset(out, 0, size);
      return 0;
    }
    out += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<size_t>(count);
  }
  return 0;
}

/// Refuses what damage made of texts.
herr_t read_sound_bytes(H5FD_t* base, H5FD_mem_t kind, hid_t transfer, haddr_t address, size_t size,
                        void* buffer) {
  if (read_bytes(base, kind, transfer, address, size, buffer) < 0) return -1;
  // HDF5 reads these collections as samples.
  const bool may_be_heap = kind == H5FD_MEM_GHEAP || kind == H5FD_MEM_DRAW;
  return may_be_heap && !is_sound_heap(static_cast<const unsigned char*>(buffer), size) ? -1 : 0;
}

herr_t write_bytes(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, size_t size,
                   const void* buffer) {
  DriverFile& file = own(base);
  const auto* in = static_cast<const char*>(buffer);
  file.end_of_file = std::max<haddr_t>(file.end_of_file, address + size);
  while (size > 0 && file.log->first_error == 0) {
    const ssize_t count = ::pwrite(file.descriptor, in, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      note_failure(file);
      break;
    }
    in += count;
    address += static_cast<haddr_t>(count);
    size -= static_cast<size_t>(count);
  }
  return 0;
}

/// HDF5 wants to have one.
herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, size_t, const void*) {
  return -1;
}

herr_t truncate_file(H5FD_t* base, hid_t, hbool_t) {
  DriverFile& file = own(base);
  if (file.end_of_space == file.end_of_file || file.log->first_error != 0) return 0;
  if (::ftruncate(file.descriptor, static_cast<off_t>(file.end_of_space)) != 0) note_failure(file);
  file.end_of_file = file.end_of_space;
  return 0;
}

H5FD_class_t make_read_driver() {
  H5FD_class_t driver{};
  driver.name = "episcope_read";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.open = open_to_read;
  driver.close = close_file;
  driver.cmp = compare_files;
  driver.query = query_features_of_reading;
  driver.get_eoa = end_of_space;
  driver.set_eoa = set_end_of_space;
  driver.get_eof = end_of_file;
  driver.read = read_sound_bytes;
  driver.write = refuse_to_write;
  constexpr H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), driver.fl_map);
  return driver;
}

H5FD_class_t make_write_driver() {
  H5FD_class_t driver = make_read_driver();
  driver.name = "episcope_logging_write";
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_to_write;
  driver.query = query_features;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = truncate_file;
  return driver;
}

}  // namespace

void use_read_driver(std::int64_t access) {
  static const H5FD_class_t driver = make_read_driver();
  static const hid_t id = H5FDregister(&driver);
  H5Pset_driver(access, id, nullptr);
}

void use_logging_write_driver(std::int64_t access, Hdf5WriteLog& log) {
  static const H5FD_class_t driver = make_write_driver();
  static const hid_t id = H5FDregister(&driver);
  const DriverInfo info{&log};
  H5Pset_driver(access, id, &info);
}

}  // namespace episcope::io
