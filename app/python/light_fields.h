// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::python {

namespace py = pybind11;

/// What arrays in Python borrow their memory from.
using Owner = std::shared_ptr<const void>;

/// Whether an array of views has an axis of channels.
enum class Channels { No, Yes };

/// The samples of a stack as a read-only array `[v][u][y][x][c]`, or `[v][u][y][x]` without
/// channels, and of a single view then `[y][x]`. Never a copy: views that lie in memory in another
/// order have other strides. The array keeps `owner` alive. T: uint8, uint16, int32, float.
template <class T>
[[nodiscard]] py::array array_of(const ViewStack<T>& stack, Owner owner, Channels channels);

/// Disparities, likewise; where there is no value, NaN, which takes a copy. None if empty.
[[nodiscard]] py::object disparity_array(const DisparityField& field, Owner owner);

/// An image as an array `[y][x][c]` of its own.
[[nodiscard]] py::array array_of(const Image<float>& image);

/// An array in C order, converted where it must be.
template <class T>
using OrderedArray = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// An array, a list of lists, or whatever NumPy takes for one. T: int32, float. Throws
/// InvalidInput, naming `what`, if it holds no numbers, or fractions where whole numbers are
/// expected.
template <class T>
[[nodiscard]] OrderedArray<T> numbers_from(const py::object& array, const std::string& what);

/// Maps of a light field of this grid: `[y][x]` of the center view, or `[v][u][y][x]` of all,
/// perhaps with a last axis of length 1. T: int32, float. Throws InvalidInput, naming `what`, for
/// another shape.
template <class T>
[[nodiscard]] ViewStack<T> maps_from(const OrderedArray<T>& array, GridShape grid,
                                     const std::string& what);

/// Values of the parameters that are described, from keyword arguments: numbers, texts, pairs. None
/// leaves one at its default. A name may have `_` for `-`, and one more at its end (`lambda_`).
/// Throws InvalidInput for an unknown name, a wrong type or a value outside the domain.
[[nodiscard]] ParameterSet parameters_from(const py::kwargs& given,
                                           const std::vector<ParameterDescription>& described);

/// A sentence of the command line with arguments of Python in the place of options: map_scale=2 for
/// --map-scale=2.
[[nodiscard]] std::string in_python(const std::string& sentence);
[[nodiscard]] std::vector<std::string> in_python(std::vector<std::string> sentences);

/// Lists, dicts, numbers and texts.
[[nodiscard]] py::object object_from(const nlohmann::ordered_json& json);

/// (v, u).
[[nodiscard]] py::tuple view_tuple(ViewIndex view);
/// A view given as (v, u); nothing for None. Throws InvalidInput unless the grid contains it.
[[nodiscard]] std::optional<ViewIndex> view_from(const py::object& view, GridShape grid);
/// (min, max).
[[nodiscard]] py::tuple interval_tuple(const Interval& interval);

/// Whether this is a path, as text or as os.PathLike.
[[nodiscard]] bool names_path(const py::object& object);
/// A path given as text or as os.PathLike.
[[nodiscard]] std::string path_from(const py::object& path);

/// A light field as Python sees it, with what was read beside it. Immutable but for what is kept of
/// arrays that took a copy.
struct OpenedScene {
  std::shared_ptr<const Scene> scene;
  std::string input{};  ///< What opens it again; empty for an array.
  py::object truth{};   ///< The array of the true disparity, once it was asked for.

  [[nodiscard]] const LightField& light_field() const { return *scene->light_field; }
  /// What a user should know of how it was read, a sentence each.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Throws TypeError, saying how to make one, for another object than a LightField.
[[nodiscard]] const OpenedScene& scene_from(const py::object& light_field);

/// Adds the class LightField, and `open`, `demo`, `decode`, `epi`.
void add_light_fields(py::module_& module);

}  // namespace episcope::python
