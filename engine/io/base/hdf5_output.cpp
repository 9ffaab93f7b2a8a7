// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_output.h"

#include "engine/core/error.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_open.h"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cerrno>
#include <numeric>
#include <utility>

namespace episcope::io {
namespace {

std::vector<std::string> left_of(std::vector<std::string> names,
                                 const std::vector<std::string>& without) {
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::find(without, name) != without.end();
  });
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

// How an object of class `type` is created, to be closed: without its time, so that the same
// content is the same bytes.
hid_t creation_of(hid_t type) {
  const hid_t creation = H5Pcreate(type);
  H5Pset_obj_track_times(creation, false);
  return creation;
}

hid_t access_of(Hdf5WriteLog& log) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  use_logging_write_driver(access, log);
  return access;
}

}  // namespace

void Hdf5Output::copy_all(const Hdf5Input& from, const std::vector<std::string>& without) {
  const Hdf5Lock session;
  const Hdf5Handle root(H5Gopen2(from.file_, "/", H5P_DEFAULT), H5Gclose);
  std::vector<std::string> links, attributes;
  require(list_links(root, links));
  for (const std::string& name : left_of(std::move(links), without)) {
    require(H5Ocopy(root, name.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
  }
  require(list_attributes(root, attributes));
  for (const std::string& name : left_of(std::move(attributes), without)) {
    require(copy_attribute(root, file_, name));
  }
}

Hdf5Output::Hdf5Output(const AtomicFile& file, std::size_t user_bytes) : path_(file.target()) {
  const Hdf5Lock session;
  const Hdf5Handle access(access_of(log_), H5Pclose);
  const Hdf5Handle creation(creation_of(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation, user_bytes);
  file_ = H5Fcreate(file.temporary().c_str(), H5F_ACC_TRUNC, creation, access);
  require(file_ >= 0);
}

Hdf5Output::Hdf5Output(const std::filesystem::path& file, const std::filesystem::path& target)
    : path_(target) {
  const Hdf5Lock session;
  const Hdf5Handle access(access_of(log_), H5Pclose);
  file_ = H5Fopen(file.c_str(), H5F_ACC_RDWR, access);
  require(file_ >= 0);
}

Hdf5Output::~Hdf5Output() {
  const Hdf5Lock session;
  for (const auto& [name, id] : datasets_) H5Dclose(id);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Output::add_group(const std::string& name) {
  const Hdf5Lock session;
  const Hdf5Handle creation(creation_of(H5P_GROUP_CREATE), H5Pclose);
  const Hdf5Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT),
                         H5Gclose);
  require(group.ok());
}

namespace {

/// In chunks of a view, by the least effort: more takes far longer and saves little.
void deflate_views(hid_t creation, std::vector<hsize_t> extent) {
  std::fill(extent.begin(), extent.end() - 2, 1);
  H5Pset_chunk(creation, static_cast<int>(extent.size()), extent.data());
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 1);
}

}  // namespace

template <class T>
void Hdf5Output::add_dataset(const std::string& name, const Hdf5Shape& shape,
                             const std::string& axes, const std::string& units, bool is_reserved) {
  const Hdf5Lock session;
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                         H5Sclose);
  const Hdf5Handle creation(creation_of(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  if (is_reserved) H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  const bool is_deflated = storage_ == Hdf5Storage::Deflated && !is_reserved && extent.size() > 1;
  if (is_deflated) deflate_views(creation, extent);
  const hid_t id =
      H5Dcreate2(file_, name.c_str(), native_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT);
  require(id >= 0);
  datasets_[name] = id;
  set_text(name, "axes", axes);
  if (!units.empty()) set_text(name, "units", units);
}

template <class T>
void Hdf5Output::write(const std::string& name, const Hdf5Block& block, const T* in) {
  const Hdf5Lock session;
  const hid_t id = datasets_.at(name);
  const Hdf5Handle space(H5Dget_space(id), H5Sclose);
  const Hdf5Handle memory(memory_space(block), H5Sclose);
  require(select_block(space, block) &&
          H5Dwrite(id, native_type<T>(), memory, space, H5P_DEFAULT, in) >= 0);
}

template void Hdf5Output::add_dataset<std::uint8_t>(const std::string&, const Hdf5Shape&,
                                                    const std::string&, const std::string&, bool);
template void Hdf5Output::add_dataset<std::uint16_t>(const std::string&, const Hdf5Shape&,
                                                     const std::string&, const std::string&, bool);
template void Hdf5Output::add_dataset<std::int32_t>(const std::string&, const Hdf5Shape&,
                                                    const std::string&, const std::string&, bool);
template void Hdf5Output::add_dataset<float>(const std::string&, const Hdf5Shape&,
                                             const std::string&, const std::string&, bool);
template void Hdf5Output::write(const std::string&, const Hdf5Block&, const std::uint8_t*);
template void Hdf5Output::write(const std::string&, const Hdf5Block&, const std::uint16_t*);
template void Hdf5Output::write(const std::string&, const Hdf5Block&, const std::int32_t*);
template void Hdf5Output::write(const std::string&, const Hdf5Block&, const float*);

void Hdf5Output::add_axes(const std::string& group, const std::vector<Hdf5Axis>& axes) {
  const Hdf5Lock session;
  const std::map<std::string, std::int64_t> datasets = datasets_;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Hdf5Axis& axis = axes[i];
    const std::string name = group + "/" + axis.name;
    std::vector<std::int32_t> places(static_cast<std::size_t>(axis.count));
    std::iota(places.begin(), places.end(), axis.first);
    add_dataset<std::int32_t>(name, {places.size()}, axis.name, axis.units);
    write(name, {{0}, {places.size()}}, places.data());
    set_text(name, "long_name", axis.meaning);
    const hid_t scale = datasets_.at(name);
    bool is_done = H5DSset_scale(scale, axis.name.c_str()) >= 0;
    const auto dimension = static_cast<unsigned>(i);
    for (const auto& [of, id] : datasets) {
      is_done = is_done && H5DSattach_scale(id, scale, dimension) >= 0 &&
                H5DSset_label(id, dimension, axis.name.c_str()) >= 0;
    }
    require(is_done);
  }
}

void Hdf5Output::set_number(const std::string& object, const std::string& name, double value) {
  set_attribute(object, name, H5T_NATIVE_DOUBLE, {}, &value);
}

void Hdf5Output::set_integers(const std::string& object, const std::string& name,
                              const std::vector<int>& values) {
  const bool is_scalar = values.size() == 1;
  set_attribute(object, name, H5T_NATIVE_INT, is_scalar ? Hdf5Shape{} : Hdf5Shape{values.size()},
                values.data());
}

void Hdf5Output::set_numbers(const std::string& object, const std::string& name,
                             const std::vector<double>& values) {
  set_attribute(object, name, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void Hdf5Output::set_text(const std::string& object, const std::string& name,
                          const std::string& value) {
  const Hdf5Lock session;
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const char* const begin = value.c_str();
  set_attribute(object, name, type, {}, &begin);
}

void Hdf5Output::set_ascii(const std::string& object, const std::string& name,
                           const std::string& value) {
  const Hdf5Lock session;
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  set_attribute(object, name, type, {}, value.data());
}

void Hdf5Output::set_attribute(const std::string& object, const std::string& name,
                               std::int64_t type, const Hdf5Shape& shape, const void* value) {
  const Hdf5Lock session;
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Hdf5Handle space(
      extent.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, extent.data(), nullptr),
      H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space,
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  require(attribute.ok() && H5Awrite(attribute, type, value) >= 0);
}

void Hdf5Output::close() {
  const Hdf5Lock session;
  bool is_done = true;
  for (const auto& [name, id] : datasets_) is_done &= H5Dclose(id) >= 0;
  datasets_.clear();
  is_done &= H5Fclose(std::exchange(file_, -1)) >= 0;
  require(is_done);
}

void Hdf5Output::require(bool is_done) const {
  if (is_done && log_.first_error == 0) return;
  errno = log_.first_error;
  throw write_error(path_);
}

}  // namespace episcope::io
