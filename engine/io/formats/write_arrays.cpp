// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/write_arrays.h"

#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/zip.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/stored_maps.h"

#include <fcntl.h>
#include <limits>
#include <string>
#include <vector>

namespace episcope::io {
namespace {

/// A stack whose samples lie in memory in the order of views: the given one, which must outlive
/// this, or a copy.
template <class T>
class OrderedStack {
 public:
  explicit OrderedStack(const ViewStack<T>& stack)
      : given_(stack), copy_(stack.is_in_order() ? ViewStack<T>() : stack.clone()) {}
  [[nodiscard]] const ViewStack<T>& get() const { return copy_.empty() ? given_ : copy_; }

 private:
  const ViewStack<T>& given_;
  ViewStack<T> copy_;
};

/// `[v][u][y][x]`, or `[y][x]` of a single view, followed by channels if there are several or
/// `has_channels`.
template <class T>
ArrayShape shape_of(const ViewStack<T>& stack, bool has_channels) {
  ArrayShape shape = map_shape(stack.grid(), stack.height(), stack.width());
  if (!has_channels) return shape;
  if (stack.grid().count() == 1) shape.insert(shape.begin(), {1, 1});
  shape.push_back(static_cast<std::size_t>(stack.channels()));
  return shape;
}

template <class T>
void add_stack(ZipWriter& zip, const std::string& name, const ViewStack<T>& stack,
               bool has_channels) {
  if (stack.empty()) return;
  const std::string header = npy_header(shape_of(stack, has_channels), number_type_of<T>());
  const OrderedStack<T> ordered(stack);
  zip.add(name + ".npy", {{reinterpret_cast<const std::uint8_t*>(header.data()), header.size()},
                          {reinterpret_cast<const std::uint8_t*>(ordered.get().data()),
                           stack.size() * sizeof(T)}});
}

}  // namespace

ViewStack<float> disparity_with_nan(const DisparityField& field) {
  if (field.empty()) return {};
  ViewStack<float> disparity = field.disparity.clone();
  for (std::size_t i = 0; i < field.valid.size(); ++i) {
    if (field.valid.data()[i] == 0) disparity.data()[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return disparity;
}

void write_npy(const std::filesystem::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        const OrderedStack<T> ordered(stack);
        write_npy<T>(path, shape_of(stack, true), {ordered.get().data(), stack.size()});
      },
      scene.light_field->samples());
  progress.report(1);
}

void write_npz(const std::filesystem::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  AtomicFile file(path, scene.light_field->byte_size());
  ZipWriter zip(file);
  std::visit([&](const auto& stack) { add_stack(zip, "lf", stack, true); },
             scene.light_field->samples());
  progress.check();
  progress.report(0.8);
  add_stack(zip, "disparity", disparity_with_nan(scene.truth->field), false);
  add_stack(zip, "labels", scene.truth->labels, false);
  add_stack(zip, "valid", scene.light_field->valid(), false);
  std::string text;
  if (const auto& estimated = scene.truth->estimated) text = estimated_json(*estimated);
  if (!text.empty()) {
    zip.add(kEstimatedFile, {{reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}});
  }
  zip.close();
  progress.check();
  file.commit();
}

namespace {

constexpr std::size_t kUserBytes = 512;
constexpr std::size_t kSlabBytes = std::size_t{64} << 20;

/// The first 128 bytes of a MATLAB file: text, no offset of subsystem data, version 2.0, "IM" for
/// little-endian.
std::vector<std::uint8_t> matlab_header() {
  std::string text = "MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 .";
  text.resize(116, ' ');
  text.resize(124, '\0');
  text += std::string{'\0', '\2', 'I', 'M'};
  return {text.begin(), text.end()};
}

template <class T>
const char* matlab_class() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16";
  if constexpr (std::is_same_v<T, std::int32_t>) return "int32";
  if constexpr (std::is_same_v<T, float>) return "single";
}

template <class T>
constexpr T full_weight() {
  if constexpr (std::is_floating_point_v<T>) return 1;
  return std::numeric_limits<T>::max();
}

/// Writes `from` as channel `channel` of a dataset [c][x][y][u][v], or as a dataset without `c`
/// where `channel` is negative.
template <class T, class Sample, class Convert>
void write_plane(Hdf5Output& file, const std::string& name, const ViewStack<Sample>& stack,
                 int from_channel, int channel, const Convert& convert) {
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  const std::size_t v = length(stack.grid().v);
  const std::size_t u = length(stack.grid().u);
  const std::size_t y = length(stack.height());
  const std::size_t width = length(stack.width());
  const std::size_t column = y * u * v;
  const std::size_t step = std::max<std::size_t>(kSlabBytes / sizeof(T) / column, 1);
  LargeArray<T> slab = make_large<T>(std::min(step, width) * column);
  for (std::size_t x = 0; x < width; x += step) {
    const std::size_t columns = std::min(step, width - x);
    PlacedSamples<const Sample> from{stack.data() + from_channel, strides_of(stack)};
    from.data += x * from.stride[3];
    move_block<Sample, T>(from, {slab.get(), {1, v, u * v, column, 0}}, {v, u, y, columns, 1}, true,
                          convert);
    Hdf5Block block{{x, 0, 0, 0}, {columns, y, u, v}};
    if (stack.grid().count() == 1 && channel < 0) block = {{x, 0}, {columns, y}};
    if (channel >= 0) {
      block.start.insert(block.start.begin(), length(channel));
      block.count.insert(block.count.begin(), 1);
    }
    file.write(name, block, slab.get());
  }
}

template <class T>
void write_map(Hdf5Output& file, const std::string& name, const ViewStack<T>& stack) {
  if (stack.empty()) return;
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  Hdf5Shape shape{length(stack.width()), length(stack.height())};
  const bool has_views = stack.grid().count() > 1;
  if (has_views) {
    shape.push_back(length(stack.grid().u));
    shape.push_back(length(stack.grid().v));
  }
  file.add_dataset<T>(name, shape, has_views ? "x,y,u,v" : "x,y", "");
  file.set_ascii(name, "MATLAB_class", matlab_class<T>());
  write_plane<T>(file, name, stack, 0, -1, [](T sample) { return sample; });
}

template <class T>
void write_light_field(Hdf5Output& file, const ViewStack<T>& stack,
                       const ViewStack<std::uint8_t>& valid, const Progress& progress) {
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  const bool has_weight = !valid.empty() && stack.channels() == 3;
  const std::size_t channels = length(stack.channels()) + (has_weight ? 1 : 0);
  file.add_dataset<T>("LF",
                      {channels, length(stack.width()), length(stack.height()),
                       length(stack.grid().u), length(stack.grid().v)},
                      "c,x,y,u,v", "");
  file.set_ascii("LF", "MATLAB_class", matlab_class<T>());
  for (int c = 0; c < stack.channels(); ++c) {
    progress.check();
    write_plane<T>(file, "LF", stack, c, c, [](T sample) { return sample; });
    progress.report((c + 1.0) / static_cast<double>(channels));
  }
  if (!has_weight) return;
  write_plane<T>(file, "LF", valid, 0, stack.channels(),
                 [](std::uint8_t is_valid) { return is_valid ? full_weight<T>() : T{0}; });
}

/// Closes a MATLAB file, marks it as one, and puts it in its place.
void finish_mat(Hdf5Output& file, AtomicFile& target, const Progress& progress) {
  file.close();
  {
    const FileDescriptor front(target.temporary(), O_WRONLY);
    if (!front.ok() || !write_all(front.id(), matlab_header())) throw write_error(target.target());
  }
  progress.check();
  target.commit();
}

}  // namespace

void write_mat(const std::filesystem::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  const LightField& light_field = *scene.light_field;
  AtomicFile target(path, light_field.byte_size());
  Hdf5Output file(target, kUserBytes);
  std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        write_light_field(file, OrderedStack<T>(stack).get(), light_field.valid(),
                          progress.part(0, 0.8));
      },
      light_field.samples());
  write_map(file, "disparity", disparity_with_nan(scene.truth->field));
  if (scene.truth->estimated && !scene.truth->field.empty()) {
    write_estimated(file, "disparity", *scene.truth->estimated);
  }
  progress.check();
  write_map(file, "labels", scene.truth->labels);
  if (light_field.channels() == 1) write_map(file, "valid", light_field.valid());
  finish_mat(file, target, progress);
}

void write_npy_maps(const std::filesystem::path& path, const ViewStack<float>& maps) {
  const OrderedStack<float> ordered(maps);
  write_npy<float>(path, shape_of(maps, false), {ordered.get().data(), maps.size()});
}

namespace {

/// Calls `write` for each map of a result with its name.
template <class Write>
void for_each_map(const Estimate& estimate, const Write& write) {
  write("disparity", disparity_with_nan(estimate.field));
  write("confidence", estimate.confidence);
  write("valid", estimate.field.valid);
  write("disparity_second", disparity_with_nan(estimate.second));
}

/// An upper bound of the bytes of all maps.
std::uintmax_t bytes_of_maps(const Estimate& estimate) {
  constexpr std::uintmax_t kFloatMaps = 3;
  return estimate.field.disparity.size() * (kFloatMaps * sizeof(float) + 1);
}

}  // namespace

void write_npz_maps(const std::filesystem::path& path, const Estimate& estimate) {
  AtomicFile file(path, bytes_of_maps(estimate));
  ZipWriter zip(file);
  for_each_map(estimate,
               [&zip](const char* name, const auto& maps) { add_stack(zip, name, maps, false); });
  zip.close();
  file.commit();
}

void write_mat_maps(const std::filesystem::path& path, const Estimate& estimate) {
  AtomicFile target(path, bytes_of_maps(estimate));
  Hdf5Output file(target, kUserBytes);
  for_each_map(estimate,
               [&file](const char* name, const auto& maps) { write_map(file, name, maps); });
  finish_mat(file, target, Progress());
}

}  // namespace episcope::io
