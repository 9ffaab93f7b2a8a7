// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_open.h"

#include "engine/core/error.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_drivers.h"
#include "engine/io/base/lzf_filter.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

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

/// Adds datasets of a group ("" for the root), then datasets of its groups.
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

namespace {

/// As `Hdf5Input::datasets`, of an open file or group.
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
    if (std::filesystem::file_size(path) == 0) throw IoError(path, kEmptyFile);
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

namespace {

/// Deflate, the most common filter, reaches 1032 for samples that are all the same.
constexpr double kLargestCompression = 1100;
/// What an unwritten dataset may claim, in bytes.
constexpr double kSmallDataset = 64 << 20;

double file_bytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : static_cast<double>(bytes);
}

/// Samples times their size; in floating point, since a file may claim any number.
double claimed_bytes(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  auto bytes = static_cast<double>(H5Tget_size(type));
  // One that is empty along an axis must not claim too much along the others, either.
  for (const std::size_t length : shape_of(space)) {
    bytes *= static_cast<double>(std::max<std::size_t>(length, 1));
  }
  return bytes;
}

// Chunks that are looked at: filters that can be skipped rarely are, and never for long.
constexpr hsize_t kChunksSeen = 64;

/// The filters that the first chunks were all stored without, a bit each. A writer may skip those
/// that it marks as optional.
unsigned skipped_filters(hid_t dataset) {
  std::array<hsize_t, H5S_MAX_RANK> offset{};
  haddr_t place = 0;
  hsize_t size = 0, count = 0;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Dget_num_chunks(dataset, space, &count) < 0) return ~0U;
  unsigned all = ~0U;
  for (hsize_t i = 0; i < std::min(count, kChunksSeen) && all != 0; ++i) {
    unsigned skipped = ~0U;
    H5Dget_chunk_info(dataset, space, i, offset.data(), &skipped, &place, &size);
    all &= skipped;
  }
  return all;
}

/// Where Debian has the plug-in of a filter.
const char* package_of(H5Z_filter_t filter) {
  constexpr H5Z_filter_t kBzip2 = 307, kBlosc = 32001, kLz4 = 32004, kBitshuffle = 32008,
                         kZfp = 32013;
  switch (filter) {
    case kBlosc:
      return "the package hdf5-filter-plugin-blosc-serial";
    case kZfp:
      return "the package hdf5-filter-plugin-zfp-serial";
    case kBzip2:
    case kLz4:
      return "the package hdf5-filter-plugin";
    case kBitshuffle:
      return "the package bitshuffle";
    default:
      return "hdf5plugin of Python";
  }
}

/// The first filter of the samples that the library lacks, and where it is to be had; empty if it
/// has all.
std::string missing_filter(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  for (int i = 0; i < std::max(0, H5Pget_nfilters(creation)); ++i) {
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t count = 0;
    std::array<char, 100> name{};
    const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &count,
                                           nullptr, name.size() - 1, name.data(), &config);
    if (id < 0 || H5Zfilter_avail(id) > 0) continue;
    const bool is_optional = (flags & H5Z_FLAG_OPTIONAL) != 0;
    if (is_optional && (skipped_filters(dataset) >> i & 1U) != 0) continue;
    return fmt::format("{}{}{}); install {}", id, name[0] == 0 ? "" : ", ", name.data(),
                       package_of(id));
  }
  return {};
}

void require_filters(const std::filesystem::path& path, const std::string& name, hid_t dataset) {
  const std::string filter = missing_filter(dataset);
  if (filter.empty()) return;
  throw IoError(
      path, fmt::format("the dataset {} is compressed by a filter that is not known here ({}, name "
                        "the folder of plug-ins in HDF5_PLUGIN_PATH, and open it again; or store "
                        "it without, for example by h5repack -f NONE",
                        name, filter));
}

/// A name that a list of properties holds at a place, as HDF5 gives it.
template <class Getter>
std::string name_in(Getter getter, hid_t creation, std::size_t at) {
  const ssize_t length = getter(creation, at, nullptr, 0);
  if (length <= 0) return {};
  std::string name(static_cast<std::size_t>(length) + 1, '\0');
  getter(creation, at, name.data(), name.size());
  name.pop_back();
  return name;
}

bool is_stored_here(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(creation) <= 0 && H5Pget_layout(creation) != H5D_VIRTUAL;
}

/// Calls `visit` with each dataset that a virtual one is made of, while they are in the same file;
/// returns whether all are.
template <class Visit>
bool for_each_source(hid_t dataset, const Visit& visit) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  std::size_t count = 0;
  if (H5Pget_layout(creation) != H5D_VIRTUAL) return true;
  if (H5Pget_virtual_count(creation, &count) < 0) return false;
  const Hdf5Handle file(H5Iget_file_id(dataset), H5Fclose);
  for (std::size_t i = 0; i < count; ++i) {
    if (name_in(H5Pget_virtual_filename, creation, i) != ".") return false;
    const std::string name = name_in(H5Pget_virtual_dsetname, creation, i);
    const Hdf5Handle source(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!source.ok() || !is_stored_here(source)) return false;
    visit(source);
  }
  return true;
}

}  // namespace

bool fits_file(const std::filesystem::path& path, double bytes) {
  return bytes <= file_bytes(path);
}

bool holds_own_samples(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(creation) <= 0 && for_each_source(dataset, [](hid_t) {});
}

std::vector<std::string> virtual_files(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  std::vector<std::string> files;
  std::size_t count = 0;
  if (H5Pget_layout(creation) != H5D_VIRTUAL || H5Pget_virtual_count(creation, &count) < 0) {
    return files;
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::string file = name_in(H5Pget_virtual_filename, creation, i);
    if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
  }
  return files;
}

bool are_sources_sound(hid_t dataset) {
  bool are_sound = true;
  const bool are_here = for_each_source(dataset, [&](hid_t source) {
    const Hdf5Shape shape = describe_dataset(source, {}).shape;
    are_sound = are_sound && has_sound_numbers(source) && !is_short_in_header(source) &&
                has_sound_chunks(source) &&
                ChunkLengths(source).are_whole({Hdf5Shape(shape.size(), 0), shape});
  });
  return are_here && are_sound;
}

void require_own_samples(const std::filesystem::path& path, const std::string& name,
                         hid_t dataset) {
  if (holds_own_samples(dataset)) return;
  throw IoError(path, "the samples of the dataset " + name +
                          " are in other files, which are not read; store them in one file by "
                          "episcope-cli convert --repack, and open that");
}

bool is_short_in_header(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_COMPACT) return false;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const bool is_empty = H5Sget_simple_extent_npoints(space) == 0;
  return !is_empty && claimed_bytes(dataset) > static_cast<double>(H5Dget_storage_size(dataset));
}

bool has_sound_numbers(hid_t dataset) {
  constexpr std::size_t kMostBytes = 16;
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  return (kind != H5T_INTEGER && kind != H5T_FLOAT) || H5Tget_size(type) <= kMostBytes;
}

void require_sound_dataset(const std::filesystem::path& path, const std::string& name,
                           hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  require_filters(path, name, dataset);
  for_each_source(dataset, [&](hid_t source) { require_filters(path, name, source); });
  const double claimed = claimed_bytes(dataset);
  if (claimed <= kSmallDataset) return;
  const bool is_virtual = H5Pget_layout(creation) == H5D_VIRTUAL;
  const bool is_compressed = H5Pget_nfilters(creation) > 0 || is_virtual;
  const double stored =
      is_virtual ? file_bytes(path)
                 : std::min(static_cast<double>(H5Dget_storage_size(dataset)), file_bytes(path));
  if (claimed <= stored * (is_compressed ? kLargestCompression : 1)) return;
  throw IoError(path,
                fmt::format("the dataset {} claims {:.3g} bytes, of which the file can hold "
                            "no more than {:.3g}; it is damaged: copy or download it again",
                            name, claimed, stored * (is_compressed ? kLargestCompression : 1)));
}

namespace {

using ChunkPlaces = std::vector<hsize_t>;

/// Sides of a chunk; empty if they do not fit the dataset.
ChunkPlaces sides_of(hid_t creation, std::size_t rank) {
  ChunkPlaces sides(rank);
  const int count = H5Pget_chunk(creation, static_cast<int>(rank), sides.data());
  const bool is_sound = count == static_cast<int>(rank) && std::ranges::count(sides, 0U) == 0;
  return is_sound ? sides : ChunkPlaces();
}

ChunkPlaces first_chunk(const Hdf5Block& block, const ChunkPlaces& sides) {
  ChunkPlaces at(sides.size());
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = block.start[i] / sides[i] * sides[i];
  return at;
}

}  // namespace

bool next_chunk(const Hdf5Block& block, const std::vector<hsize_t>& sides,
                std::vector<hsize_t>& at) {
  for (std::size_t i = at.size(); i-- > 0;) {
    at[i] += sides[i];
    if (at[i] < block.start[i] + block.count[i]) return true;
    at[i] = block.start[i] / sides[i] * sides[i];
  }
  return false;
}

bool list_links(hid_t group, std::vector<std::string>& names) {
  hsize_t next = 0;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* all) -> herr_t {
    static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  const bool is_whole = H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, &next, add, &names) >= 0;
  std::ranges::sort(names);
  return is_whole;
}

bool list_attributes(hid_t object, std::vector<std::string>& names) {
  hsize_t next = 0;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* all) -> herr_t {
    static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  const bool is_whole = H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, &next, add, &names) >= 0;
  std::ranges::sort(names);
  return is_whole;
}

namespace {

hsize_t bytes_of_chunk(hid_t dataset, const ChunkPlaces& sides) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  hsize_t bytes = H5Tget_size(type);
  for (const hsize_t side : sides) bytes *= side;
  return bytes;
}

/// Whether the dataset may become as large; of axes without an end it may.
bool fit_dataset(hid_t dataset, const ChunkPlaces& sides) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  ChunkPlaces extent(sides.size()), most(sides.size());
  H5Sget_simple_extent_dims(space, extent.data(), most.data());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (most[i] != H5S_UNLIMITED && sides[i] > most[i]) return false;
  }
  return true;
}

/// Whether the samples are deflated, perhaps shuffled before, and nothing else.
bool is_deflated(hid_t creation) {
  bool is_found = false;
  for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
    unsigned flags = 0, config = 0;
    std::size_t count = 0;
    const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &count,
                                           nullptr, 0, nullptr, &config);
    if (id != H5Z_FILTER_DEFLATE && id != H5Z_FILTER_SHUFFLE) return false;
    is_found = is_found || id == H5Z_FILTER_DEFLATE;
  }
  return is_found;
}

bool states_packed_size(hid_t creation, hsize_t bytes) {
  unsigned flags = 0, config = 0;
  std::array<unsigned, kLzfSizeAt + 1> values{};
  std::size_t count = values.size();
  const bool is_lzf = H5Pget_filter_by_id2(creation, kLzfFilter, &flags, &count, values.data(), 0,
                                           nullptr, &config) >= 0;
  return !is_lzf || (count > kLzfSizeAt && values[kLzfSizeAt] == bytes);
}

/// Up to `most`.
hsize_t inflated_size(std::vector<std::uint8_t>& packed, hsize_t most) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::vector<std::uint8_t> piece(kPiece);
  z_stream state{};
  if (inflateInit(&state) != Z_OK) return 0;
  state.next_in = packed.data();
  state.avail_in = static_cast<uInt>(packed.size());
  hsize_t size = 0;
  int result = Z_OK;
  while (result == Z_OK && size < most) {
    state.next_out = piece.data();
    state.avail_out = static_cast<uInt>(piece.size());
    result = inflate(&state, Z_NO_FLUSH);
    size += piece.size() - state.avail_out;
  }
  inflateEnd(&state);
  return size;
}

/// Of what damages the shape of chunks, all of them suffer.
bool is_first_whole(hid_t dataset, hsize_t bytes) {
  const ChunkPlaces offset(H5S_MAX_RANK, 0);
  unsigned skipped = 0;
  haddr_t place = HADDR_UNDEF;
  hsize_t stored = 0;
  if (H5Dget_chunk_info_by_coord(dataset, offset.data(), &skipped, &place, &stored) < 0 ||
      place == HADDR_UNDEF || skipped != 0) {
    return true;
  }
  const Hdf5Handle file(H5Iget_file_id(dataset), H5Fclose);
  hsize_t size = 0;
  if (H5Fget_filesize(file, &size) < 0 || stored > size) return false;
  std::vector<std::uint8_t> packed(stored);
  if (H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &skipped, packed.data()) < 0) return true;
  return inflated_size(packed, bytes) >= bytes;
}

}  // namespace

bool has_sound_chunks(hid_t dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED) return true;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  const ChunkPlaces sides = sides_of(creation, static_cast<std::size_t>(std::max(0, rank)));
  if (sides.empty() || !fit_dataset(dataset, sides)) return false;
  const hsize_t bytes = bytes_of_chunk(dataset, sides);
  if (!states_packed_size(creation, bytes)) return false;
  if (H5Pget_nfilters(creation) > 0)
    return !is_deflated(creation) || is_first_whole(dataset, bytes);
  hsize_t count = 0;
  return H5Dget_num_chunks(dataset, space, &count) < 0 ||
         H5Dget_storage_size(dataset) == count * bytes;
}

ChunkLengths::ChunkLengths(hid_t dataset) : dataset_(dataset) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const int filters = H5Pget_nfilters(creation);
  if (H5Pget_layout(creation) != H5D_CHUNKED || filters <= 0) return;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const Hdf5Shape shape = shape_of(space);
  sides_ = sides_of(creation, shape.size());
  bytes_ = bytes_of_chunk(dataset, sides_);
  filters_ = (1U << filters) - 1;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    counts_.push_back((shape[i] + sides_[i] - 1) / sides_[i]);
  }
}

bool ChunkLengths::is_short(const ChunkPlaces& at) {
  hsize_t stored = 0;
  if (H5Dget_chunk_storage_size(dataset_, at.data(), &stored) < 0) return true;
  if (stored == 0 || stored >= bytes_) return false;
  packed_.resize(stored);
  std::uint32_t skipped = 0;
  return H5Dread_chunk(dataset_, H5P_DEFAULT, at.data(), &skipped, packed_.data()) < 0 ||
         (skipped & filters_) == filters_;
}

bool ChunkLengths::are_whole(const Hdf5Block& block) {
  if (sides_.empty() || std::ranges::count(block.count, 0U) > 0) return true;
  ChunkPlaces at = first_chunk(block, sides_);
  do {
    hsize_t index = 0;
    for (std::size_t i = 0; i < at.size(); ++i) index = index * counts_[i] + at[i] / sides_[i];
    if (index >= seen_.size()) seen_.resize(index + 1);
    if (seen_[index]) continue;
    if (is_short(at)) return false;
    seen_[index] = true;
  } while (next_chunk(block, sides_, at));
  return true;
}

}  // namespace episcope::io
