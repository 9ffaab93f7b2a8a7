// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/hdf5_listing.h"

#include "engine/io/hdf5/hdf5_claims.h"
#include "engine/io/hdf5/hdf5_handle.h"

#include <algorithm>

namespace episcope::io {
namespace {

constexpr int kDeepestGroup = 3;

Hdf5Type type_of(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  if (kind == H5T_FLOAT) return Hdf5Type::Float;
  if (kind == H5T_ENUM && size == 1) return Hdf5Type::UInt8;
  if (kind != H5T_INTEGER) return Hdf5Type::Other;
  if (H5Tget_sign(type) == H5T_SGN_NONE && size == 1) return Hdf5Type::UInt8;
  if (H5Tget_sign(type) == H5T_SGN_NONE && size == 2) return Hdf5Type::UInt16;
  return Hdf5Type::Integer;
}

Hdf5Shape shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

Hdf5Shape chunk_of(hid_t dataset, std::size_t rank) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (rank == 0 || !creation.ok() || H5Pget_layout(creation) != H5D_CHUNKED) return {};
  std::vector<hsize_t> chunk(rank);
  if (H5Pget_chunk(creation, static_cast<int>(rank), chunk.data()) < 0) return {};
  return {chunk.begin(), chunk.end()};
}

struct Listing {
  std::vector<std::string> groups;
  std::vector<std::string> datasets;
};

herr_t list_object(hid_t group, const char* name, const H5L_info_t*, void* listing) {
  H5O_info_t info;
  if (H5Oget_info_by_name2(group, name, &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0) return 0;
  auto& found = *static_cast<Listing*>(listing);
  if (info.type == H5O_TYPE_GROUP) found.groups.emplace_back(name);
  if (info.type == H5O_TYPE_DATASET) found.datasets.emplace_back(name);
  return 0;
}

Listing list_group(hid_t file, const std::string& name) {
  Listing listing;
  hsize_t next = 0;
  const Hdf5Handle group(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
  // In order of names the library makes a table of links first, which it releases unfilled where a
  // damaged file ends it.
  if (group.ok()) H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, &next, list_object, &listing);
  std::ranges::sort(listing.groups);
  std::ranges::sort(listing.datasets);
  return listing;
}

/// Datasets of a group ("" for the root), then those of its groups.
void add_datasets(hid_t file, const std::string& group, int depth,
                  std::vector<std::string>& names) {
  const Listing listing = list_group(file, group.empty() ? "." : group);
  const std::string prefix = group.empty() ? "" : group + "/";
  for (const std::string& name : listing.datasets) names.push_back(prefix + name);
  if (depth == 0) return;
  for (const std::string& name : listing.groups) {
    add_datasets(file, prefix + name, depth - 1, names);
  }
}

}  // namespace

Hdf5Dataset describe_dataset(hid_t dataset, const std::string& name) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Shape shape = shape_of(space);
  return {name, shape, type_of(type), chunk_of(dataset, shape.size())};
}

std::vector<Hdf5Dataset> list_datasets(hid_t root) {
  std::vector<std::string> names;
  add_datasets(root, "", kDeepestGroup, names);
  std::vector<Hdf5Dataset> found;
  for (const std::string& name : names) {
    const Hdf5Handle dataset(H5Dopen2(root, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset.ok() && holds_own_samples(dataset)) {
      found.push_back(describe_dataset(dataset, name));
    }
  }
  return found;
}

}  // namespace episcope::io
