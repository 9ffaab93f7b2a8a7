// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_claims.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/hdf5/hdf5_handle.h"

#include <algorithm>

namespace episcope::io {
namespace {

constexpr hssize_t kMostReferences = 100000;

/// Without the leading slash; empty if it leads to nothing that has a name.
std::string name_of(hid_t file, const hobj_ref_t& reference) {
  std::string name(256, '\0');
  const ssize_t length = H5Rget_name(file, H5R_OBJECT, &reference, name.data(), name.size());
  if (length < 2 || static_cast<std::size_t>(length) >= name.size()) return {};
  name.resize(static_cast<std::size_t>(length));
  return name.substr(1);
}

}  // namespace

std::vector<std::string> Hdf5Input::referenced(const std::string& name) const {
  const Hdf5Lock session;
  const Hdf5Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.ok() || !holds_own_samples(dataset) || is_short_in_header(dataset)) return {};
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tequal(type, H5T_STD_REF_OBJ) <= 0 || count < 1 || count > kMostReferences) return {};
  std::vector<hobj_ref_t> references(static_cast<std::size_t>(count));
  if (H5Dread(dataset, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0) {
    return {};
  }
  std::vector<std::string> names;
  for (const hobj_ref_t& reference : references) names.push_back(name_of(file_, reference));
  return names;
}

}  // namespace episcope::io
