// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/write_arrays.h"

#include "engine/io/arrays/npy_file.h"
#include "engine/io/arrays/ordered_stack.h"
#include "engine/io/arrays/zip_writer.h"

#include <limits>

namespace episcope::io {
namespace {

/// `[v][u][y][x]`, or `[y][x]` of a single view, followed by channels if there are several or
/// `has_channels`.
template <class T>
ArrayShape shape_of(const ViewStack<T>& stack, bool has_channels) {
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  ArrayShape shape;
  if (stack.grid().count() > 1 || has_channels) {
    shape = {length(stack.grid().v), length(stack.grid().u)};
  }
  shape.push_back(length(stack.height()));
  shape.push_back(length(stack.width()));
  if (has_channels) shape.push_back(length(stack.channels()));
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
  zip.close();
  progress.check();
  file.commit();
}

}  // namespace episcope::io
