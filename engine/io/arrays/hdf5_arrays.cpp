// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/hdf5_arrays.h"

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

/// Three arrays of equal shape as one: channels, and what they have in common.
class Planes : public ArrayInput {
 public:
  Planes(const fs::path& path, const ArrayEntry& entry,
         std::vector<std::unique_ptr<ArrayInput>> planes)
      : ArrayInput(path, entry.shape, entry.type), planes_(std::move(planes)) {}
  [[nodiscard]] ArrayShape unit() const override {
    ArrayShape unit = planes_.front()->unit();
    unit.insert(unit.begin(), 1);
    return unit;
  }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const ArrayShape plane_start(start.begin() + 1, start.end());
    const ArrayShape plane_count(count.begin() + 1, count.end());
    const std::size_t bytes = element_count(plane_count) * byte_size(type());
    for (std::size_t i = start[0]; i < start[0] + count[0]; ++i, out += bytes) {
      planes_[i]->read_raw(plane_start, plane_count, out);
    }
  }

  std::vector<std::unique_ptr<ArrayInput>> planes_;
};

constexpr const char* kChannels[] = {"r", "g", "b"};

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
    // References of MATLAB to the contents of cells and tables lie in groups of this name.
    if (!dataset.name.starts_with('#')) add(describe(*file_, dataset, is_matlab()));
  }
  add_planes(datasets);
}

void Hdf5Arrays::add_planes(const std::vector<Hdf5Dataset>& datasets) {
  for (const Hdf5Dataset& dataset : datasets) {
    if (!dataset.name.ends_with("/r")) continue;
    const std::string group = dataset.name.substr(0, dataset.name.size() - 2);
    const auto fits = [&](const char* channel) {
      const auto found = std::ranges::find(datasets, group + "/" + channel, &Hdf5Dataset::name);
      return found != datasets.end() && found->shape == dataset.shape &&
             found->type == dataset.type;
    };
    if (!std::ranges::all_of(kChannels, fits)) continue;
    ArrayEntry entry = describe(*file_, dataset, is_matlab());
    entry.name = group;
    entry.shape.insert(entry.shape.begin(), 3);
    add(std::move(entry));
    planar_.push_back(group);
  }
}

std::unique_ptr<ArrayInput> Hdf5Arrays::open(const ArrayEntry& entry) const {
  require_plausible_size(path(), entry.shape, entry.type, fs::file_size(path()));
  if (std::ranges::find(planar_, entry.name) == planar_.end()) {
    return std::make_unique<Hdf5Array>(file_, entry);
  }
  std::vector<std::unique_ptr<ArrayInput>> planes;
  ArrayEntry plane = entry;
  plane.shape.erase(plane.shape.begin());
  for (const char* channel : kChannels) {
    plane.name = entry.name + "/" + channel;
    planes.push_back(std::make_unique<Hdf5Array>(file_, plane));
  }
  return std::make_unique<Planes>(path(), entry, std::move(planes));
}

}  // namespace episcope::io
