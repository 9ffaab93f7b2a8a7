// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_file.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_chunks.h"
#include "engine/io/base/hdf5_open.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <fstream>

namespace episcope::io {
namespace {

constexpr std::size_t kChunkCacheLimit = std::size_t{256} << 20;

/// Room for all chunks that the views of one row of chunks share: else a file whose chunks span
/// several views would be decompressed once for every view.
std::size_t chunk_cache_bytes(hid_t dataset) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  const auto [name, shape, kind, chunk] = describe_dataset(dataset, {});
  if (chunk.size() < 4 || (chunk[0] == 1 && chunk[1] == 1)) return 0;
  std::size_t bytes = H5Tget_size(type) * chunk[0];
  for (std::size_t axis = 1; axis < shape.size(); ++axis) {
    bytes *= (shape[axis] + chunk[axis] - 1) / chunk[axis] * chunk[axis];
  }
  return std::min(bytes, kChunkCacheLimit);
}

hid_t open_with_cache(const std::filesystem::path& path, hid_t file, const std::string& name) {
  std::size_t bytes = 0;
  {
    Hdf5Handle plain(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!plain.ok()) return -1;
    require_own_samples(path, name, plain);
    bytes = chunk_cache_bytes(plain);
    if (bytes == 0) return plain.release();
  }
  // The library keeps the cache of a dataset that is open: the first access must be closed.
  const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, 100003, bytes, 1.0);
  return H5Dopen2(file, name.c_str(), access);
}

bool is_group(hid_t file, const std::string& name) {
  H5O_info_t info;
  return H5Oget_info_by_name2(file, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) >= 0 &&
         info.type == H5O_TYPE_GROUP;
}

hid_t attribute_of(hid_t file, const std::string& object, const std::string& name) {
  if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0) return -1;
  return H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
}

bool path_exists(const std::filesystem::path& path, hid_t file, const std::string& name) {
  if (name == "/") return true;
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    H5L_info_t info;
    if (H5Lget_info(file, part.c_str(), &info, H5P_DEFAULT) >= 0 &&
        info.type == H5L_TYPE_EXTERNAL) {
      throw IoError(path, part +
                              " is a link to another file, which is not followed; store the "
                              "samples in this file");
    }
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

}  // namespace

std::string hdf5_version() {
  const Hdf5Lock session;
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

bool has_hdf5_name(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".h5" || suffix == ".hdf5";
}

bool has_hdf5_signature(const std::filesystem::path& path) {
  constexpr char signature[] = "\x89HDF\r\n\x1a\n";
  std::ifstream file(path, std::ios::binary);
  // A block of the user's may precede the HDF5 part, as in MATLAB files.
  for (const int offset : {0, 512, 1024, 2048}) {
    char begin[8] = {};
    if (!file.seekg(offset).read(begin, sizeof begin)) return false;
    if (std::equal(begin, begin + 8, signature)) return true;
  }
  return false;
}

Hdf5Input::Hdf5Input(const std::filesystem::path& path) : path_(path) {
  const Hdf5Lock session;
  shared_ = Hdf5OpenFile::of(path);
  file_ = shared_->id();
  root_ = file_;
}

Hdf5Input::Hdf5Input(const std::filesystem::path& path, const std::string& group)
    : Hdf5Input(path) {
  group_ = group;
  const Hdf5Lock session;
  if (!path_exists(path_, file_, group) || !is_group(file_, group)) {
    throw IoError(path, "there is no group " + group + " in this file; choose another file");
  }
  root_ = H5Gopen2(file_, group.c_str(), H5P_DEFAULT);
  if (root_ < 0) {
    throw IoError(path, "the group " + group +
                            " cannot be opened: the file is damaged; copy or download it again");
  }
}

Hdf5Input::~Hdf5Input() {
  const Hdf5Lock session;
  for (const auto& [name, opened] : datasets_) H5Dclose(opened.id);
  if (root_ >= 0 && root_ != file_) H5Gclose(root_);
  shared_.reset();
}

bool Hdf5Input::has(const std::string& name) const {
  const Hdf5Lock session;
  return path_exists(path_, root_, name);
}

std::string Hdf5Input::fault_of(const std::string& name) const {
  const Hdf5Lock session;
  H5L_info_t link;
  if (H5Lget_info(root_, name.c_str(), &link, H5P_DEFAULT) < 0) return {};
  if (link.type == H5L_TYPE_EXTERNAL) return std::string(finding_text("dataset.elsewhere"));
  if (H5Oexists_by_name(root_, name.c_str(), H5P_DEFAULT) <= 0) {
    return std::string(finding_text("dataset.nothing"));
  }
  if (is_group(root_, name)) return {};
  const Hdf5Handle dataset(H5Dopen2(root_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.ok()) return {};  // which reading it tells
  if (!holds_own_samples(dataset)) return std::string(finding_text("dataset.samples_elsewhere"));
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) == 0) return std::string(finding_text("dataset.empty"));
  if (describe_dataset(dataset, name).type != Hdf5Type::Other) return {};
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  return std::string(H5Tget_class(type) == H5T_COMPOUND ? finding_text("dataset.records")
                                                        : finding_text("dataset.no_numbers"));
}

bool Hdf5Input::has_numbers(const std::string& name) const {
  return fault_of(name).empty() && has(name);
}

std::vector<Hdf5Dataset> Hdf5Input::datasets() const {
  const Hdf5Lock session;
  return shared_->datasets(group_, root_);
}

Hdf5Dataset Hdf5Input::dataset(const std::string& name, const std::string& advice) const {
  if (!has(name)) {
    const std::string held = joined(datasets(), ", ", [this](const Hdf5Dataset& one) {
      return one.type == Hdf5Type::Other ? one.name + " (it " + fault_of(one.name) + ")" : one.name;
    });
    throw IoError(path_, "there is no dataset " + name + " in this file, which holds " +
                             (held.empty() ? "no dataset at all; choose another file"
                                           : held + "; " + advice));
  }
  const Hdf5Lock session;
  if (is_group(root_, name)) {
    throw IoError(path_, name +
                             " is a group in this file, but must be a dataset; store the samples "
                             "as the dataset " +
                             name + " or choose another file");
  }
  const hid_t id = open_dataset(name).id;
  require_sound_dataset(path_, name, id);
  return describe_dataset(id, name);
}

const Hdf5Input::Opened& Hdf5Input::open_dataset(const std::string& name) const {
  const auto known = datasets_.find(name);
  if (known != datasets_.end()) return known->second;
  const hid_t id = open_with_cache(path_, root_, name);
  const bool is_sound = id >= 0 && has_sound_numbers(id) && !is_short_in_header(id) &&
                        has_sound_chunks(id) && are_sources_sound(id);
  if (id >= 0 && !is_sound) H5Dclose(id);
  if (!is_sound) {
    throw IoError(path_, "the dataset " + name +
                             " cannot be opened: the file is damaged; copy or download it again");
  }
  return datasets_[name] = {id, std::make_shared<ChunkLengths>(id),
                            std::make_shared<DeflatedChunks>(id)};
}

template <class T>
void Hdf5Input::read(const std::string& name, const Hdf5Block& block, T* out) const {
  const Hdf5Lock session;
  const auto& [id, chunks, deflated] = open_dataset(name);
  if (deflated->read(block, native_type<T>(), out)) return;
  const Hdf5Handle space(H5Dget_space(id), H5Sclose);
  const Hdf5Handle memory(memory_space(block), H5Sclose);
  const Hdf5Handle stored(H5Dget_type(id), H5Tclose);
  // A boolean of other programs is an enumeration, which HDF5 does not convert.
  const bool is_flag = H5Tget_class(stored) == H5T_ENUM && H5Tget_size(stored) == sizeof(T);
  const hid_t type = is_flag ? static_cast<hid_t>(stored) : native_type<T>();
  const bool can_be_read = select_block(space, block) && chunks->are_whole(block);
  if (!can_be_read || H5Dread(id, type, memory, space, H5P_DEFAULT, out) < 0) {
    throw IoError(
        path_, "the dataset " + name +
                   " cannot be read: the file is truncated or damaged; copy or download it again");
  }
}

template void Hdf5Input::read(const std::string&, const Hdf5Block&, std::uint8_t*) const;
template void Hdf5Input::read(const std::string&, const Hdf5Block&, std::uint16_t*) const;
template void Hdf5Input::read(const std::string&, const Hdf5Block&, std::int32_t*) const;
template void Hdf5Input::read(const std::string&, const Hdf5Block&, float*) const;
template void Hdf5Input::read(const std::string&, const Hdf5Block&, double*) const;

template <class T>
std::optional<std::uintmax_t> Hdf5Input::place_in_file(const std::string& name) const {
  const Hdf5Lock session;
  const hid_t id = open_dataset(name).id;
  const Hdf5Handle creation(H5Dget_create_plist(id), H5Pclose);
  const Hdf5Handle type(H5Dget_type(id), H5Tclose);
  const Hdf5Handle space(H5Dget_space(id), H5Sclose);
  const bool is_array = H5Pget_layout(creation) == H5D_CONTIGUOUS &&
                        H5Pget_nfilters(creation) == 0 && H5Tequal(type, native_type<T>()) > 0;
  const haddr_t offset = H5Dget_offset(id);
  const auto samples = static_cast<hsize_t>(H5Sget_simple_extent_npoints(space));
  if (!is_array || offset == HADDR_UNDEF || offset % sizeof(T) != 0 ||
      H5Dget_storage_size(id) != samples * sizeof(T)) {
    return std::nullopt;
  }
  return offset;
}

template std::optional<std::uintmax_t> Hdf5Input::place_in_file<std::uint8_t>(
    const std::string&) const;
template std::optional<std::uintmax_t> Hdf5Input::place_in_file<std::uint16_t>(
    const std::string&) const;
template std::optional<std::uintmax_t> Hdf5Input::place_in_file<std::int32_t>(
    const std::string&) const;
template std::optional<std::uintmax_t> Hdf5Input::place_in_file<float>(const std::string&) const;

std::int64_t Hdf5Input::open_attribute(const std::string& object, const std::string& name) const {
  if (object != "/") return attribute_of(root_, object, name);
  const hid_t own = attribute_of(root_, ".", name);
  return own >= 0 || root_ == file_ ? own : attribute_of(file_, ".", name);
}

bool Hdf5Input::has_attribute(const std::string& object, const std::string& name) const {
  const Hdf5Lock session;
  return Hdf5Handle(open_attribute(object, name), H5Aclose).ok();
}

std::optional<double> Hdf5Input::number(const std::string& object, const std::string& name) const {
  const std::vector<double> all = numbers(object, name);
  if (all.size() == 1) return all.front();
  // Some writers store every attribute as text.
  const auto spelled = all.empty() ? text(object, name) : std::nullopt;
  return spelled ? parse_number(*spelled) : std::nullopt;
}

namespace {

/// An attribute with its type and how many values it has: none if there is no such attribute.
struct OpenedAttribute {
  explicit OpenedAttribute(hid_t opened)
      : id(opened, H5Aclose),
        type(id.ok() ? H5Aget_type(id) : H5I_INVALID_HID, H5Tclose),
        space(id.ok() ? H5Aget_space(id) : H5I_INVALID_HID, H5Sclose),
        count(space.ok() ? H5Sget_simple_extent_npoints(space) : 0) {}

  [[nodiscard]] double bytes() const {
    return static_cast<double>(count) * static_cast<double>(H5Tget_size(type));
  }

  Hdf5Handle id;
  Hdf5Handle type;
  Hdf5Handle space;
  hssize_t count;
};

}  // namespace

std::vector<double> Hdf5Input::numbers(const std::string& object, const std::string& name) const {
  const Hdf5Lock session;
  const OpenedAttribute attribute(open_attribute(object, name));
  if (attribute.count < 1) return {};
  const H5T_class_t kind = H5Tget_class(attribute.type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return {};
  if (!fits_file(path_, attribute.bytes())) return {};
  std::vector<double> values(static_cast<std::size_t>(attribute.count));
  if (H5Aread(attribute.id, H5T_NATIVE_DOUBLE, values.data()) < 0) return {};
  return values;
}

std::optional<std::string> Hdf5Input::text(const std::string& object,
                                           const std::string& name) const {
  const Hdf5Lock session;
  const OpenedAttribute attribute(open_attribute(object, name));
  if (attribute.count != 1 || H5Tget_class(attribute.type) != H5T_STRING) return {};
  if (H5Tis_variable_str(attribute.type) > 0) {
    char* value = nullptr;
    if (H5Aread(attribute.id, attribute.type, &value) < 0) return {};
    if (value == nullptr) return "";  // So the library stores an empty text.
    std::string copy(value);
    H5free_memory(value);
    return copy;
  }
  if (!fits_file(path_, attribute.bytes())) return {};
  std::string value(H5Tget_size(attribute.type), '\0');
  if (H5Aread(attribute.id, attribute.type, value.data()) < 0) return {};
  return value.substr(0, value.find('\0'));
}

std::vector<std::string> Hdf5Input::texts(const std::string& object,
                                          const std::string& name) const {
  const Hdf5Lock session;
  const OpenedAttribute attribute(open_attribute(object, name));
  if (attribute.count < 1 || H5Tis_variable_str(attribute.type) <= 0) return {};
  if (!fits_file(path_, attribute.bytes())) return {};
  std::vector<char*> stored(static_cast<std::size_t>(attribute.count), nullptr);
  if (H5Aread(attribute.id, attribute.type, stored.data()) < 0) return {};
  std::vector<std::string> texts;
  for (const char* text : stored) texts.emplace_back(text ? text : "");
  H5Dvlen_reclaim(attribute.type, attribute.space, H5P_DEFAULT, stored.data());
  return texts;
}

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

std::vector<std::string> Hdf5Input::scale_names(const std::string& dataset) const {
  constexpr hssize_t kMostAxes = 32;
  const Hdf5Lock session;
  const OpenedAttribute attribute(open_attribute(dataset, "DIMENSION_LIST"));
  if (attribute.count < 1 || attribute.count > kMostAxes) return {};
  const Hdf5Handle of_axis(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  if (H5Tequal(attribute.type, of_axis) <= 0) return {};
  std::vector<hvl_t> scales(static_cast<std::size_t>(attribute.count), hvl_t{});
  if (H5Aread(attribute.id, of_axis, scales.data()) < 0) return {};
  std::vector<std::string> names;
  for (const hvl_t& axis : scales) {
    std::string name;
    if (axis.len > 0) name = name_of(file_, *static_cast<const hobj_ref_t*>(axis.p));
    names.push_back(name.substr(name.rfind('/') + 1));
  }
  H5Dvlen_reclaim(of_axis, attribute.space, H5P_DEFAULT, scales.data());
  return names;
}

}  // namespace episcope::io
