// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/mat5.h"

#include "engine/core/error.h"
#include "engine/io/base/files.h"
#include "engine/io/base/zip.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMat5Header = 128;
constexpr std::uint64_t kTag = 8;
constexpr std::uint32_t kMatrix = 14;
constexpr std::uint32_t kCompressed = 15;
constexpr int kHeadOfMatrix = 3;      ///< Elements: flags, dimensions, name.
constexpr std::uint32_t kStruct = 3;  ///< Kinds of matrices up to this hold others.
constexpr std::uint32_t kFirstNumeric = 6, kLastNumeric = 15;
constexpr std::uint64_t kWhollyChecked = 64 << 20;  ///< Bytes of a variable, unpacked.
constexpr int kDeepestElement = 32;                 ///< The library calls itself for each.

/// What is said of a MATLAB 5 file that is not whole.
IoError damaged_mat5(const fs::path& path) {
  return {path, "the MATLAB file is truncated or damaged; copy or save it again"};
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, bool is_little) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number = number << 8 | static_cast<unsigned char>(bytes[at + (is_little ? 3 - i : i)]);
  }
  return number;
}

struct Element {
  std::uint32_t type = 0;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::uint64_t next = 0;
};

/// Elements of a file or of a part that was unpacked.
class Elements {
 public:
  using Read = std::function<std::string(std::uint64_t at, std::uint64_t count)>;
  Elements(const fs::path& path, bool is_little, Read read)
      : path_(path), is_little_(is_little), read_(std::move(read)) {}

  [[nodiscard]] IoError damaged() const { return damaged_mat5(path_); }

  /// That at `at`, which must end before `end`.
  [[nodiscard]] Element at(std::uint64_t at, std::uint64_t end) const {
    if (end - at < kTag) throw damaged();
    const std::string tag = read_(at, kTag);
    if (tag.size() != kTag) throw damaged();
    const std::uint32_t first = number_at(tag, 0, is_little_);
    Element element{first, at + kTag, 0, 0};
    std::uint64_t bytes = number_at(tag, 4, is_little_);
    if (first >> 16 != 0) {  // four bytes at most, within the tag
      element.type = first & 0xFFFF;
      element.begin = at + 4;
      bytes = first >> 16;
    }
    if (bytes > end - element.begin) throw damaged();
    element.end = element.begin + bytes;
    element.next = first >> 16 != 0 ? at + kTag : element.end + (kTag - bytes % kTag) % kTag;
    return element;
  }

  /// All of a matrix, and of those in it.
  void check(std::uint64_t begin, std::uint64_t end, int depth) const {
    if (depth == kDeepestElement) throw damaged();
    for (std::uint64_t place = begin; place < end;) {
      const Element element = at(place, end);
      if (element.type == kMatrix) check(element.begin, element.end, depth + 1);
      place = element.next;
    }
  }

 private:
  const fs::path& path_;
  bool is_little_;
  Read read_;
};

/// The dimensions and the name of a compressed variable must be there as a whole; of one that holds
/// others, all of it; of samples that are not large, they too.
void check_compressed(const fs::path& path, bool is_little, const Element& packed) {
  InflateStream stream(path, packed.begin, packed.end - packed.begin);
  const auto read = [&stream](std::uint64_t at, std::uint64_t count) {
    std::string bytes(count, '\0');
    if (!stream.skip_to(at)) return std::string();
    bytes.resize(stream.read(count, reinterpret_cast<std::uint8_t*>(bytes.data())));
    return bytes;
  };
  const Elements elements(path, is_little, read);
  const std::string tag = read(0, kTag);
  if (tag.size() != kTag || number_at(tag, 0, is_little) != kMatrix) throw elements.damaged();
  const std::uint64_t end = kTag + number_at(tag, 4, is_little);
  const Element flags = elements.at(kTag, end);
  const std::string kind = read(flags.begin, 4);
  if (kind.size() != 4) throw elements.damaged();
  const std::uint32_t kind_number = number_at(kind, 0, is_little) & 0xFF;
  if (kind_number <= kStruct) return elements.check(flags.next, end, 1);
  std::uint64_t place = flags.next;
  for (int i = 1; i < kHeadOfMatrix; ++i) place = elements.at(place, end).next;
  const bool is_numeric = kind_number >= kFirstNumeric && kind_number <= kLastNumeric;
  if (!is_numeric || end > kWhollyChecked || place == end) return;
  // `end` may be too far: matio adds to it.
  const bool is_there = stream.skip_to(elements.at(place, end).end);
  if (!is_there || !stream.ends_well()) throw elements.damaged();
}

/// Follows the lengths of all elements of a MATLAB 5 file: each must end within what holds it. The
/// library believes them: it reads what is missing in a truncated file as if it were there, and
/// takes gigabytes for dimensions of that length. Of compressed variables of more than 64 MiB
/// that hold no others only the beginning is looked at; of smaller ones the library would leave
/// what it cannot unpack as it was in memory. Throws IoError. Source: The MathWorks, MAT-File
/// Format, R2015b, chapter 1.
void require_sound_elements(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const auto read = [&in](std::uint64_t at, std::uint64_t count) {
    std::string bytes(count, '\0');
    in.clear();
    in.seekg(static_cast<std::streamoff>(at))
        .read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
  };
  const bool is_little = read(126, 1) == "I";
  const Elements elements(path, is_little, read);
  const std::uint64_t size = fs::file_size(path);
  for (std::uint64_t place = kMat5Header; place < size;) {
    const Element element = elements.at(place, size);
    if (element.type == kMatrix) elements.check(element.begin, element.end, 0);
    if (element.type == kCompressed) check_compressed(path, is_little, element);
    place = element.end;  // not padded here
  }
}

constexpr std::size_t kMostMat5Axes = 32;
constexpr std::size_t kMostVariables = 10000;
constexpr int kDeepestStruct = 3;  ///< Of structs in structs.

std::optional<NumberType> number_type(const matvar_t& variable) {
  static const std::map<int, NumberType> types{
      {MAT_C_DOUBLE, NumberType::Float64}, {MAT_C_SINGLE, NumberType::Float32},
      {MAT_C_INT8, NumberType::Int8},      {MAT_C_UINT8, NumberType::UInt8},
      {MAT_C_INT16, NumberType::Int16},    {MAT_C_UINT16, NumberType::UInt16},
      {MAT_C_INT32, NumberType::Int32},    {MAT_C_UINT32, NumberType::UInt32},
      {MAT_C_INT64, NumberType::Int64},    {MAT_C_UINT64, NumberType::UInt64}};
  const auto found = types.find(variable.class_type);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

const char* kind_name(const matvar_t& variable) {
  static const std::map<int, const char*> names{{MAT_C_STRUCT, "struct"},
                                                {MAT_C_CELL, "cell array"},
                                                {MAT_C_CHAR, "text"},
                                                {MAT_C_SPARSE, "sparse matrix"},
                                                {MAT_C_FUNCTION, "function"}};
  const auto found = names.find(variable.class_type);
  if (found != names.end()) return found->second;
  return variable.isComplex ? "complex numbers" : "object";
}

/// MATLAB's shape with its contiguous first axis last.
ArrayShape stored_shape(const matvar_t& variable) {
  ArrayShape shape(variable.dims, variable.dims + variable.rank);
  std::ranges::reverse(shape);
  return shape;
}

}  // namespace

/// The open file and what its header says of the variables.
class Mat5File::Content {
  struct CloseVariable {
    void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
  };
  using Variable = std::unique_ptr<matvar_t, CloseVariable>;

 public:
  explicit Content(const fs::path& path)
      : path_(path), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY)) {
    if (!file_) throw damaged_mat5(path);
  }
  ~Content() {
    variables_.clear();
    Mat_Close(file_);
  }
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  /// Null at the end.
  matvar_t* next() {
    if (variables_.size() == kMostVariables) throw damaged_mat5(path_);
    Variable variable(Mat_VarReadNextInfo(file_));
    if (!variable) return nullptr;
    return variables_.emplace_back(std::move(variable)).get();
  }
  void name(const std::string& name, matvar_t* variable) { named_[name] = variable; }

  [[nodiscard]] bool is_compressed(const std::string& name) const {
    return named_.at(name)->compression != MAT_COMPRESSION_NONE;
  }

  /// Elements of a variable as stored; of a compressed one, all are kept.
  void read(const std::string& name, std::size_t first, std::size_t count, std::uint8_t* out) {
    const std::lock_guard lock(mutex_);
    matvar_t& variable = *named_.at(name);
    if (variable.compression == MAT_COMPRESSION_NONE) {
      constexpr std::size_t kLast = std::numeric_limits<int>::max();
      if (first + count > kLast) {
        throw IoError(path_, "the variable " + name +
                                 " is too large for a MATLAB file of version "
                                 "5; save it with the option -v7.3");
      }
      if (Mat_VarReadDataLinear(file_, &variable, out, static_cast<int>(first), 1,
                                static_cast<int>(count)) == 0) {
        return;
      }
      throw damaged_mat5(path_);
    }
    if (!variable.data && Mat_VarReadDataAll(file_, &variable) != 0) throw damaged_mat5(path_);
    const auto width = static_cast<std::size_t>(variable.data_size);  // known by now only
    if (!variable.data || (first + count) * width > variable.nbytes) throw damaged_mat5(path_);
    const auto* bytes = static_cast<const std::uint8_t*>(variable.data);
    std::copy_n(bytes + first * width, count * width, out);
  }

 private:
  fs::path path_;
  mat_t* file_;
  std::vector<Variable> variables_;
  std::map<std::string, matvar_t*> named_;
  std::mutex mutex_;
};

namespace {

/// One variable, read through the file that it is in.
class Mat5Array : public LinearArray {
 public:
  using Read = std::function<void(std::size_t first, std::size_t count, std::uint8_t* out)>;
  Mat5Array(const fs::path& path, const ArrayEntry& entry, bool is_compressed, Read read)
      : LinearArray(path, entry.shape, entry.type),
        is_compressed_(is_compressed),
        read_(std::move(read)) {}
  [[nodiscard]] bool is_sequential() const override { return is_compressed_; }

 private:
  void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const override {
    read_(first, count, out);
  }

  bool is_compressed_;
  Read read_;
};

ArrayEntry describe(const fs::path& path, const std::string& name, const matvar_t& variable) {
  ArrayEntry entry{name, {}, {}, IndexOrder::Fortran, {}, {}};
  const auto type = number_type(variable);
  if (!type || variable.isComplex) {
    entry.other_kind = kind_name(variable);
    return entry;
  }
  if (variable.rank < 0 || static_cast<std::size_t>(variable.rank) > kMostMat5Axes ||
      !variable.dims) {
    throw damaged_mat5(path);
  }
  entry.type = *type;
  entry.shape = stored_shape(variable);
  return entry;
}

}  // namespace

bool is_mat5_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  char header[128] = {};
  if (!in.read(header, sizeof header)) return false;
  const std::string_view text(header, 116);
  const std::string_view order(header + 126, 2);
  const bool is_little = order == "IM" && header[125] == 1 && header[124] == 0;
  const bool is_big = order == "MI" && header[124] == 1 && header[125] == 0;
  return text.starts_with("MATLAB 5.0") && (is_little || is_big);
}

Mat5File::Mat5File(const fs::path& path) : ArrayFile(path, "MATLAB 5 file") {
  require_readable_file(path);
  require_sound_elements(path);
  content_ = std::make_unique<Content>(path);
  while (matvar_t* variable = content_->next()) {
    add_variable(variable->name ? variable->name : "", *variable, 0);
  }
  join_parts();
}

void Mat5File::add_variable(const std::string& name, matvar_t& variable, int depth) {
  const auto cell = [&](int i) { return Mat_VarGetCell(&variable, i); };
  if (variable.class_type == MAT_C_CELL && add_cells(name, variable, cell)) return;
  add(describe(path(), name, variable));
  content_->name(name, &variable);
  if (variable.class_type != MAT_C_STRUCT || !variable.data || depth == kDeepestStruct) return;
  const unsigned fields = Mat_VarGetNumberOfFields(&variable);
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  const bool are_many = element_count(stored_shape(variable)) > 1;
  for (unsigned i = 0; names && i < fields; ++i) {
    const auto of_struct = [&](int k) { return Mat_VarGetStructFieldByIndex(&variable, i, k); };
    const std::string whole = name + "/" + names[i];
    matvar_t* field = of_struct(0);
    if (!field || field->class_type == MAT_C_EMPTY) continue;
    if (!are_many) {
      add_variable(whole, *field, depth + 1);
    } else if (!add_cells(whole, variable, of_struct)) {
      add({whole, {}, {}, IndexOrder::Fortran, {}, "field of many structs"});
    }
  }
}

bool Mat5File::add_cells(const std::string& name, const matvar_t& variable,
                         const std::function<matvar_t*(int)>& cell) {
  if (variable.rank != 2 || !variable.dims || !variable.data) return false;
  const ArrayShape grid = stored_shape(variable);
  std::vector<ArrayEntry> cells;
  for (std::size_t i = 0; i < std::min(element_count(grid), kMostVariables); ++i) {
    matvar_t* one = cell(static_cast<int>(i));
    if (!one) return false;
    cells.push_back(describe(path(), fmt::format("{}{{{}}}", name, i + 1), *one));
    content_->name(cells.back().name, one);
  }
  auto whole = joined_cells(name, cells, grid);
  if (!whole) return false;
  add(std::move(*whole));
  return true;
}

Mat5File::~Mat5File() = default;

std::unique_ptr<ArrayInput> Mat5File::open_stored(const ArrayEntry& entry) const {
  require_plausible_size(path(), entry.shape, entry.type, fs::file_size(path()));
  const auto read = [this, name = entry.name](std::size_t first, std::size_t count,
                                              std::uint8_t* out) {
    content_->read(name, first, count, out);
  };
  return std::make_unique<Mat5Array>(path(), entry, content_->is_compressed(entry.name), read);
}

std::unique_ptr<const ArrayFile> open_matlab_file(const std::filesystem::path& path) {
  require_readable_file(path);
  if (is_mat5_file(path)) return std::make_unique<const Mat5File>(path);
  if (!has_hdf5_signature(path)) {
    throw IoError(path,
                  "this is not a MATLAB file of version 5 or later, despite its name; choose "
                  "another file");
  }
  return std::make_unique<const Hdf5Arrays>(std::make_shared<const Hdf5Input>(path));
}

}  // namespace episcope::io
