// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/hdf5_arrays.h"

#include "engine/io/arrays/joined_arrays.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

NumberType number_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::UInt8:
      return NumberType::UInt8;
    case Hdf5Type::UInt16:
      return NumberType::UInt16;
    case Hdf5Type::Integer:
      return NumberType::Int32;
    default:
      return NumberType::Float32;
  }
}

ArrayEntry describe(const Hdf5Input& file, const Hdf5Dataset& dataset, bool is_matlab) {
  ArrayEntry entry;
  entry.name = dataset.name;
  entry.order = is_matlab ? IndexOrder::Fortran : IndexOrder::C;
  const auto matlab_class = file.text(dataset.name, "MATLAB_class");
  if (dataset.type == Hdf5Type::Other || matlab_class == "char" || matlab_class == "cell") {
    entry.other_kind = matlab_class == "char"   ? "text"
                       : matlab_class == "cell" ? "cell array"
                                                : "dataset without numbers";
    return entry;
  }
  entry.shape = dataset.shape;
  entry.type = number_type(dataset.type);
  // The attribute names axes in the order of HDF5.
  entry.stated_axes = in_index_order(file.text(dataset.name, "axes").value_or(""), entry.order);
  return entry;
}

/// One dataset, read by blocks.
class Hdf5Array : public ArrayInput {
 public:
  Hdf5Array(std::shared_ptr<const Hdf5Input> file, const ArrayEntry& entry)
      : ArrayInput(file->path(), entry.shape, entry.type),
        file_(std::move(file)),
        name_(entry.name),
        chunk_(file_->dataset(name_).chunk) {}
  [[nodiscard]] ArrayShape unit() const override {
    return chunk_.empty() ? ArrayInput::unit() : chunk_;
  }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const Hdf5Block block{start, count};
    switch (type()) {
      case NumberType::UInt8:
        return file_->read(name_, block, out);
      case NumberType::UInt16:
        return file_->read(name_, block, reinterpret_cast<std::uint16_t*>(out));
      case NumberType::Int32:
        return file_->read(name_, block, reinterpret_cast<std::int32_t*>(out));
      default:
        return file_->read(name_, block, reinterpret_cast<float*>(out));
    }
  }

  std::shared_ptr<const Hdf5Input> file_;
  std::string name_;
  ArrayShape chunk_;
};

}  // namespace

bool is_matlab_hdf5(const Hdf5Input& file) {
  std::ifstream in(file.path(), std::ios::binary);
  std::string begin(10, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin == "MATLAB 7.3") return true;
  return std::ranges::any_of(file.datasets(), [&](const Hdf5Dataset& dataset) {
    return file.has_attribute(dataset.name, "MATLAB_class");
  });
}

Hdf5Arrays::Hdf5Arrays(std::shared_ptr<const Hdf5Input> file)
    : ArrayFile(file->path(), is_matlab_hdf5(*file) ? "MATLAB 7.3 file" : kPlainForm),
      file_(std::move(file)) {
  const std::vector<Hdf5Dataset> datasets = file_->datasets();
  for (const Hdf5Dataset& dataset : datasets) {
    // The contents of MATLAB's cells and tables lie in groups of this name.
    if (dataset.name.starts_with('#') || add_cells(dataset, datasets)) continue;
    add(describe(*file_, dataset, is_matlab()));
  }
  join_parts();
}

bool Hdf5Arrays::add_cells(const Hdf5Dataset& dataset, const std::vector<Hdf5Dataset>& datasets) {
  if (dataset.shape.size() != 2) return false;
  if (file_->text(dataset.name, "MATLAB_class") != "cell") return false;
  std::vector<ArrayEntry> cells;
  for (const std::string& name : file_->referenced(dataset.name)) {
    const auto cell = std::ranges::find(datasets, name, &Hdf5Dataset::name);
    if (cell == datasets.end()) return false;
    cells.push_back(describe(*file_, *cell, is_matlab()));
  }
  auto whole = joined_cells(dataset.name, cells, dataset.shape);
  if (whole) add(std::move(*whole));
  return whole.has_value();
}

std::unique_ptr<ArrayInput> Hdf5Arrays::open_stored(const ArrayEntry& entry) const {
  require_plausible_size(path(), entry.shape, entry.type, fs::file_size(path()));
  return std::make_unique<Hdf5Array>(file_, entry);
}

}  // namespace episcope::io
