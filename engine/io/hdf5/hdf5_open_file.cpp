// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_open_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/hdf5/hdf5_drivers.h"
#include "engine/io/hdf5/hdf5_handle.h"
#include "engine/io/hdf5/hdf5_listing.h"
#include "engine/io/hdf5/lzf_filter.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

/// A file must not name others that are read in its stead, wherever they are.
void follow_no_external_links() {
  static const H5L_class_t refused = [] {
    H5L_class_t links{};
    links.version = H5L_LINK_CLASS_T_VERS;
    links.id = H5L_TYPE_EXTERNAL;
    links.comment = "external, not followed";
    links.trav_func = [](const char*, hid_t, const void*, std::size_t, hid_t, hid_t) -> hid_t {
      return -1;
    };
    return links;
  }();
  static const herr_t is_set = H5Lregister(&refused);
  static_cast<void>(is_set);
}

}  // namespace

std::shared_ptr<Hdf5OpenFile> Hdf5OpenFile::of(const std::filesystem::path& path) {
  static std::map<std::filesystem::path, std::weak_ptr<Hdf5OpenFile>> all;
  std::erase_if(all, [](const auto& each) { return each.second.expired(); });
  if (const auto known = all.find(path); known != all.end()) {
    const std::shared_ptr<Hdf5OpenFile> file = known->second.lock();
    if (file && file->is_still(path)) return file;
  }
  auto file = std::make_shared<Hdf5OpenFile>(path);
  all[path] = file;
  return file;
}

Hdf5OpenFile::Hdf5OpenFile(const std::filesystem::path& path) {
  require_readable_file(path);
  if (!has_hdf5_signature(path)) {
    throw IoError(path, "this is not an HDF5 file, despite its name; choose another file");
  }
  follow_no_external_links();
  register_lzf_filter();
  ::stat(path.c_str(), &stamp_);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  use_read_driver(access);
  id_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (id_ < 0) {
    throw IoError(path, fmt::format("the HDF5 file is truncated or damaged ({} bytes are present); "
                                    "copy or download it again",
                                    std::filesystem::file_size(path)));
  }
}

Hdf5OpenFile::~Hdf5OpenFile() {
  if (id_ >= 0) H5Fclose(id_);
}

const std::vector<Hdf5Dataset>& Hdf5OpenFile::datasets(const std::string& group, hid_t root) {
  const auto known = listed_.find(group);
  return known != listed_.end() ? known->second : listed_[group] = list_datasets(root);
}

bool Hdf5OpenFile::is_still(const std::filesystem::path& path) const {
  struct stat now {};
  return ::stat(path.c_str(), &now) == 0 && now.st_dev == stamp_.st_dev &&
         now.st_ino == stamp_.st_ino && now.st_size == stamp_.st_size &&
         now.st_mtim.tv_sec == stamp_.st_mtim.tv_sec &&
         now.st_mtim.tv_nsec == stamp_.st_mtim.tv_nsec;
}

}  // namespace episcope::io
