// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/mat5_file.h"

#include "engine/core/error.h"
#include "engine/io/arrays/joined_arrays.h"
#include "engine/io/arrays/mat5_elements.h"
#include "engine/io/durable/system_error.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
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

constexpr std::size_t kMostAxes = 32;
constexpr std::size_t kMostVariables = 10000;
constexpr int kDeepest = 3;  ///< Of structs in structs.

struct CloseVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, CloseVariable>;

std::optional<NumberType> number_type(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return NumberType::Float64;
    case MAT_C_SINGLE:
      return NumberType::Float32;
    case MAT_C_INT8:
      return NumberType::Int8;
    case MAT_C_UINT8:
      return NumberType::UInt8;
    case MAT_C_INT16:
      return NumberType::Int16;
    case MAT_C_UINT16:
      return NumberType::UInt16;
    case MAT_C_INT32:
      return NumberType::Int32;
    case MAT_C_UINT32:
      return NumberType::UInt32;
    case MAT_C_INT64:
      return NumberType::Int64;
    case MAT_C_UINT64:
      return NumberType::UInt64;
    default:
      return std::nullopt;
  }
}

const char* kind_name(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_STRUCT:
      return "struct";
    case MAT_C_CELL:
      return "cell array";
    case MAT_C_CHAR:
      return "text";
    case MAT_C_SPARSE:
      return "sparse matrix";
    case MAT_C_FUNCTION:
      return "function";
    default:
      return variable.isComplex ? "complex numbers" : "object";
  }
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
  if (variable.rank < 0 || static_cast<std::size_t>(variable.rank) > kMostAxes || !variable.dims) {
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
  if (variable.class_type == MAT_C_CELL && add_cells(name, variable)) return;
  add(describe(path(), name, variable));
  content_->name(name, &variable);
  if (variable.class_type != MAT_C_STRUCT || !variable.data || depth == kDeepest) return;
  const unsigned fields = Mat_VarGetNumberOfFields(&variable);
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  for (unsigned i = 0; names && i < fields; ++i) {
    matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
    if (!field || field->class_type == MAT_C_EMPTY) continue;
    add_variable(name + "/" + names[i], *field, depth + 1);
  }
}

bool Mat5File::add_cells(const std::string& name, matvar_t& variable) {
  if (variable.rank != 2 || !variable.dims || !variable.data) return false;
  const ArrayShape grid = stored_shape(variable);
  std::vector<ArrayEntry> cells;
  for (std::size_t i = 0; i < std::min(element_count(grid), kMostVariables); ++i) {
    matvar_t* cell = Mat_VarGetCell(&variable, static_cast<int>(i));
    if (!cell) return false;
    cells.push_back(describe(path(), fmt::format("{}{{{}}}", name, i + 1), *cell));
    content_->name(cells.back().name, cell);
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

}  // namespace episcope::io
