// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_repack.h"

#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_open.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <string>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlockBytes = std::size_t{64} << 20;

/// Copies one file into another that is open for writing.
class Repack {
 public:
  Repack(const fs::path& from, const fs::path& to, const Progress& progress)
      : from_(from), to_(to), progress_(progress) {}

  void copy_group(hid_t from, hid_t to) {
    copy_attributes(from, to);
    std::vector<std::string> names;
    (void)list_links(from, names);
    for (const std::string& name : names) copy_link(from, to, name);
  }

 private:
  void copy_link(hid_t from, hid_t to, const std::string& name) {
    progress_.check();
    H5L_info_t link;
    require_read(H5Lget_info(from, name.c_str(), &link, H5P_DEFAULT) >= 0, name);
    if (link.type != H5L_TYPE_HARD) {
      require(H5Lcopy(from, name.c_str(), to, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
      return;
    }
    const Hdf5Handle object(H5Oopen(from, name.c_str(), H5P_DEFAULT), H5Oclose);
    require_read(object.ok(), name);
    const H5I_type_t kind = H5Iget_type(object);
    if (kind == H5I_GROUP) {
      const Hdf5Handle group(H5Gcreate2(to, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Gclose);
      require(group.ok());
      copy_group(object, group);
    } else if (kind == H5I_DATASET && !is_plain(object)) {
      copy_dataset(object, to, name);
    } else {
      require(H5Ocopy(from, name.c_str(), to, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
    }
  }

  /// Whether a dataset can be copied as it is: stored here in one piece, or not of numbers.
  static bool is_plain(hid_t dataset) {
    const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    const bool is_number = kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
    const H5D_layout_t layout = H5Pget_layout(creation);
    const bool is_here =
        (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT) && H5Pget_external_count(creation) <= 0;
    return !is_number || is_here;
  }

  /// The library takes samples of missing files for zeros.
  void require_sources(hid_t dataset, const std::string& name) {
    for (const std::string& source : virtual_files(dataset)) {
      std::error_code error;
      const bool is_there = source == "." || fs::exists(from_.parent_path() / source, error) ||
                            fs::exists(source, error);
      if (is_there) continue;
      throw IoError(from_, "the dataset " + name + " has samples in the file " + source +
                               ", which is not there; put it beside this file");
    }
  }

  void copy_dataset(hid_t from, hid_t to, const std::string& name) {
    require_sources(from, name);
    const Hdf5Handle type(H5Dget_type(from), H5Tclose);
    const Hdf5Handle space(H5Dget_space(from), H5Sclose);
    const Hdf5Shape shape = describe_dataset(from, name).shape;
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    const Hdf5Handle fixed(
        extent.empty() ? H5Scopy(space)
                       : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
        H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    const Hdf5Handle copy(
        H5Dcreate2(to, name.c_str(), type, fixed, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    require(copy.ok());
    copy_attributes(from, copy);
    if (H5Sget_simple_extent_npoints(space) > 0) copy_samples(from, copy, type, shape, name);
  }

  /// A few places of the first axes at a time.
  void copy_samples(hid_t from, hid_t to, hid_t type, const Hdf5Shape& shape,
                    const std::string& name) {
    Hdf5Block block{Hdf5Shape(shape.size(), 0), shape};
    std::size_t bytes = H5Tget_size(type);
    std::size_t axis = shape.size();  // from here on, all is copied at once
    while (axis > 0 && bytes * shape[axis - 1] <= kBlockBytes) bytes *= shape[--axis];
    for (std::size_t i = 0; i < axis; ++i) block.count[i] = 1;
    std::vector<std::byte> samples(bytes);
    do {
      progress_.check();
      const Hdf5Handle stored(H5Dget_space(from), H5Sclose);
      const Hdf5Handle place(H5Dget_space(to), H5Sclose);
      const Hdf5Handle memory(memory_space(block), H5Sclose);
      require_read(select_block(stored, block) && select_block(place, block) &&
                       H5Dread(from, type, memory, stored, H5P_DEFAULT, samples.data()) >= 0,
                   name);
      require(H5Dwrite(to, type, memory, place, H5P_DEFAULT, samples.data()) >= 0);
    } while (step(block, shape, axis));
  }

  /// Moves the block along the first `axes`; whether it is not at the end.
  static bool step(Hdf5Block& block, const Hdf5Shape& shape, std::size_t axes) {
    for (std::size_t i = axes; i-- > 0;) {
      if (++block.start[i] < shape[i]) return true;
      block.start[i] = 0;
    }
    return false;
  }

  void copy_attributes(hid_t from, hid_t to) {
    std::vector<std::string> names;
    (void)list_attributes(from, names);
    for (const std::string& name : names) copy_attribute(from, to, name);
  }

  /// References lead to places of the other file: they are left out.
  void copy_attribute(hid_t from_object, hid_t to_object, const std::string& name) {
    const Hdf5Handle from(H5Aopen(from_object, name.c_str(), H5P_DEFAULT), H5Aclose);
    require_read(from.ok(), name);
    const Hdf5Handle type(H5Aget_type(from), H5Tclose);
    const Hdf5Handle space(H5Aget_space(from), H5Sclose);
    if (H5Tdetect_class(type, H5T_REFERENCE) > 0) return;
    const Hdf5Handle to(H5Acreate2(to_object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
    require(to.ok());
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::size_t bytes =
        static_cast<std::size_t>(std::max<hssize_t>(count, 0)) * H5Tget_size(type);
    if (bytes == 0 || !fits_file(from_, static_cast<double>(bytes))) return;
    std::vector<std::byte> value(bytes);
    require_read(H5Aread(from, type, value.data()) >= 0, name);
    const bool is_written = H5Awrite(to, type, value.data()) >= 0;
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
    require(is_written);
  }

  void require_read(bool is_done, const std::string& name) const {
    if (is_done) return;
    throw IoError(from_, name +
                             " cannot be read: the file is truncated or damaged, or one that it "
                             "names is; copy or download it again");
  }
  void require(bool is_done) const {
    if (!is_done) throw write_error(to_);
  }

  const fs::path& from_;
  const fs::path& to_;
  const Progress& progress_;
};

}  // namespace

void repack_hdf5(const fs::path& from, const fs::path& to, const Progress& progress) {
  progress.check();
  progress.step("writing " + to.filename().string());
  const Hdf5Lock session;
  const auto input = Hdf5OpenFile::of(from);
  AtomicFile target(to, fs::file_size(from));
  errno = 0;
  const hid_t output =
      H5Fcreate(target.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (output < 0) throw write_error(to);
  Hdf5Handle file(output, H5Fclose);
  {
    const Hdf5Handle root(H5Gopen2(input->id(), "/", H5P_DEFAULT), H5Gclose);
    Repack(from, to, progress).copy_group(root, file);
  }
  if (H5Fclose(file.release()) < 0) throw write_error(to);
  target.commit();
  progress.report(1);
}

}  // namespace episcope::io
