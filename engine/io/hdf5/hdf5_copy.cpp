// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/hdf5/hdf5_handle.h"

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

herr_t add_link(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t add_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Those of `names` that are not in `without`, in alphabetical order. They are listed as stored: in
/// order of names the library makes a table first, which it releases unfilled where a damaged file
/// ends it.
std::vector<std::string> left_of(std::vector<std::string> names,
                                 const std::vector<std::string>& without) {
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::find(without, name) != without.end();
  });
  std::ranges::sort(names);
  return names;
}

bool copy_attribute(hid_t from_object, hid_t to_object, const std::string& name) {
  const Hdf5Handle from(H5Aopen(from_object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(from), H5Tclose);
  const Hdf5Handle space(H5Aget_space(from), H5Sclose);
  const Hdf5Handle to(H5Acreate2(to_object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (!to.ok() || count < 0) return false;
  std::vector<std::uint8_t> value(static_cast<std::size_t>(count) * H5Tget_size(type));
  if (value.empty()) return true;
  if (H5Aread(from, type, value.data()) < 0) return false;
  const herr_t outcome = H5Awrite(to, type, value.data());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  return outcome >= 0;
}

}  // namespace

void Hdf5Output::copy_all(const Hdf5Input& from, const std::vector<std::string>& without) {
  const Hdf5Lock session;
  const Hdf5Handle root(H5Gopen2(from.file_, "/", H5P_DEFAULT), H5Gclose);
  std::vector<std::string> links, attributes;
  hsize_t next = 0;
  require(H5Literate(root, H5_INDEX_NAME, H5_ITER_NATIVE, &next, add_link, &links) >= 0);
  for (const std::string& name : left_of(std::move(links), without)) {
    require(H5Ocopy(root, name.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
  }
  next = 0;
  require(H5Aiterate2(root, H5_INDEX_NAME, H5_ITER_NATIVE, &next, add_attribute, &attributes) >= 0);
  for (const std::string& name : left_of(std::move(attributes), without)) {
    require(copy_attribute(root, file_, name));
  }
}

}  // namespace episcope::io
