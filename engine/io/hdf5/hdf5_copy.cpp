// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/hdf5/hdf5_handle.h"

#include <algorithm>

namespace episcope::io {
namespace {

struct Copying {
  hid_t from;
  hid_t to;
  const std::vector<std::string>& without;
  [[nodiscard]] bool leaves_out(const char* name) const {
    return std::ranges::find(without, name) != without.end();
  }
};

herr_t copy_object(hid_t group, const char* name, const H5L_info_t*, void* data) {
  const auto& copying = *static_cast<const Copying*>(data);
  if (copying.leaves_out(name)) return 0;
  return H5Ocopy(group, name, copying.to, name, H5P_DEFAULT, H5P_DEFAULT);
}

herr_t copy_attribute(hid_t object, const char* name, const H5A_info_t*, void* data) {
  const auto& copying = *static_cast<const Copying*>(data);
  if (copying.leaves_out(name)) return 0;
  const Hdf5Handle from(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(from), H5Tclose);
  const Hdf5Handle space(H5Aget_space(from), H5Sclose);
  const Hdf5Handle to(H5Acreate2(copying.to, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (!to.ok() || count < 0) return -1;
  std::vector<std::uint8_t> value(static_cast<std::size_t>(count) * H5Tget_size(type));
  if (value.empty()) return 0;
  if (H5Aread(from, type, value.data()) < 0) return -1;
  const herr_t outcome = H5Awrite(to, type, value.data());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  return outcome;
}

}  // namespace

void Hdf5Output::copy_all(const Hdf5Input& from, const std::vector<std::string>& without) {
  const Hdf5Lock session;
  Copying copying{from.file_, file_, without};
  hsize_t next = 0;
  require(H5Literate(from.file_, H5_INDEX_NAME, H5_ITER_INC, &next, copy_object, &copying) >= 0);
  const Hdf5Handle root(H5Gopen2(from.file_, "/", H5P_DEFAULT), H5Gclose);
  next = 0;
  require(H5Aiterate2(root, H5_INDEX_NAME, H5_ITER_INC, &next, copy_attribute, &copying) >= 0);
}

}  // namespace episcope::io
