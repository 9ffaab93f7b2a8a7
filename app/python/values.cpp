// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/values.h"

#include "engine/core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace episcope::python {
namespace {

using Lengths = std::vector<py::ssize_t>;

/// Keeps `owner` until the last array that has it as its base is gone.
py::capsule capsule_of(Owner owner) {
  return {new Owner(std::move(owner)), [](void* kept) { delete static_cast<Owner*>(kept); }};
}

void forbid_writing(const py::array& array) {
  array.attr("setflags")(py::arg("write") = false);
}

/// Bytes from one view of the stack to the next along v and u.
template <class T>
std::pair<py::ssize_t, py::ssize_t> view_strides(const ViewStack<T>& stack) {
  const auto bytes_to = [&](int v, int u) {
    const ViewIndex first = stack.first();
    if (v >= stack.grid().v || u >= stack.grid().u) return py::ssize_t{0};  // no second view
    return static_cast<py::ssize_t>(sizeof(T)) *
           (stack.view({first.v + v, first.u + u}).data - stack.view(first).data);
  };
  return {bytes_to(1, 0), bytes_to(0, 1)};
}

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += (i == 0 ? "" : "×") + std::to_string(array.shape(i));
  }
  return text.empty() ? "a single number" : text;
}

}  // namespace

template <class T>
py::array array_of(const ViewStack<T>& stack, Owner owner, Channels channels) {
  const auto size = static_cast<py::ssize_t>(sizeof(T));
  const auto [v, u] = view_strides(stack);
  Lengths shape{stack.grid().v, stack.grid().u, stack.height(), stack.width()};
  Lengths strides{v, u, size * stack.width() * stack.channels(), size * stack.channels()};
  if (channels == Channels::Yes) {
    shape.push_back(stack.channels());
    strides.push_back(size);
  } else if (stack.grid().count() == 1) {
    shape.erase(shape.begin(), shape.begin() + 2);
    strides.erase(strides.begin(), strides.begin() + 2);
  }
  py::array array(py::dtype::of<T>(), shape, strides, stack.view(stack.first()).data,
                  capsule_of(std::move(owner)));
  forbid_writing(array);
  return array;
}

template py::array array_of(const ViewStack<std::uint8_t>&, Owner, Channels);
template py::array array_of(const ViewStack<std::uint16_t>&, Owner, Channels);
template py::array array_of(const ViewStack<std::int32_t>&, Owner, Channels);
template py::array array_of(const ViewStack<float>&, Owner, Channels);

py::object disparity_array(const DisparityField& field, Owner owner) {
  if (field.empty()) return py::none();
  if (field.valid.empty()) return array_of(field.disparity, std::move(owner), Channels::No);
  auto known = std::make_shared<ViewStack<float>>(field.disparity.clone());
  for (int i = 0; i < known->grid().count(); ++i) {
    const ViewIndex view = known->view_at(i);
    const DisparityView map = field.view(view);
    float* out = known->view(view).data;
    for (int y = 0; y < known->height(); ++y) {
      for (int x = 0; x < known->width(); ++x, ++out) {
        if (!map.is_valid(y, x)) *out = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
  return array_of(*known, known, Channels::No);
}

py::array array_of(const Image<float>& image) {
  return py::array_t<float>(Lengths{image.height(), image.width(), image.channels()}, image.data());
}

template <class T>
OrderedArray<T> numbers_from(const py::object& array, const std::string& what) {
  constexpr bool is_whole = std::is_integral_v<T>;
  const std::string kinds = is_whole ? "biu" : "biuf";
  const auto given = py::array::ensure(array);
  if (given && kinds.find(given.dtype().kind()) != std::string::npos) {
    return OrderedArray<T>(given);
  }
  throw InvalidInput(what + " are no array of " + (is_whole ? "whole numbers" : "numbers") +
                     "; give one, such as of type " + (is_whole ? "int32" : "float32"));
}

template OrderedArray<std::int32_t> numbers_from(const py::object&, const std::string&);
template OrderedArray<float> numbers_from(const py::object&, const std::string&);

template <class T>
ViewStack<T> maps_from(const OrderedArray<T>& array, GridShape grid, const std::string& what) {
  const bool is_center = array.ndim() == 2;
  const bool is_all = array.ndim() == 4 && array.shape(0) == grid.v && array.shape(1) == grid.u;
  if ((!is_center && !is_all) || array.size() == 0) {
    throw InvalidInput(what + " have the shape " + shape_text(array) +
                       ", but must be [y][x] of the center view or [v][u][y][x] of the " +
                       std::to_string(grid.v) + "×" + std::to_string(grid.u) + " views");
  }
  const auto length = [&](py::ssize_t from_end) {
    return static_cast<int>(array.shape(array.ndim() - from_end));
  };
  ViewStack<T> maps(is_center ? GridShape{1, 1} : grid, length(2), length(1), 1,
                    is_center ? grid.center() : ViewIndex{});
  std::copy_n(array.data(), maps.size(), maps.data());
  return maps;
}

template ViewStack<std::int32_t> maps_from(const OrderedArray<std::int32_t>&, GridShape,
                                           const std::string&);
template ViewStack<float> maps_from(const OrderedArray<float>&, GridShape, const std::string&);

namespace {

/// Two numbers, of a pair of any kind; throws py::cast_error for another.
template <class Number>
std::pair<Number, Number> pair_from(const py::handle& value) {
  const auto sequence = py::cast<py::sequence>(value);
  if (sequence.size() != 2) throw py::cast_error("no pair");
  return {py::cast<Number>(sequence[0]), py::cast<Number>(sequence[1])};
}

/// The value as one of the type of the default. Throws py::cast_error if it is no such value.
struct TypedValue {
  py::handle given;

  ParameterValue operator()(bool) const {
    py::detail::make_caster<bool> flag;  // without what else Python takes for true
    if (!flag.load(given, false)) throw py::cast_error("no flag");
    return py::detail::cast_op<bool>(flag);
  }
  ParameterValue operator()(int) const { return py::cast<int>(given); }
  ParameterValue operator()(double) const { return py::cast<double>(given); }
  ParameterValue operator()(const std::string&) const { return py::cast<std::string>(given); }
  ParameterValue operator()(const IntervalOrAuto&) const {
    const auto [min, max] = pair_from<double>(given);
    return IntervalOrAuto(Interval{min, max});
  }
  ParameterValue operator()(const ViewOrAuto&) const {
    const auto [v, u] = pair_from<int>(given);
    return ViewOrAuto(ViewIndex{v, u});
  }
};

ParameterValue value_from(const py::handle& given, const ParameterDescription& description) {
  ParameterValue value;
  try {
    value = std::visit(TypedValue{given}, description.default_value);
  } catch (const py::cast_error&) {
    // A word such as "auto", or nothing that fits: then it says what does.
    return parse_parameter(description, py::cast<std::string>(py::str(given)));
  }
  check_parameter(description, value);
  return value;
}

const ParameterDescription& description_of(const std::string& name,
                                           const std::vector<ParameterDescription>& described) {
  std::string hyphenated = name;
  std::ranges::replace(hyphenated, '_', '-');
  const std::string shortened = name.ends_with('_') ? name.substr(0, name.size() - 1) : name;
  std::vector<std::string> keys;
  for (const ParameterDescription& each : described) {
    if (each.key == name || each.key == hyphenated || each.key == shortened) return each;
    keys.push_back(each.key);
  }
  throw InvalidInput(no_such_name("parameter", name, keys));
}

}  // namespace

ParameterSet parameters_from(const py::kwargs& given,
                             const std::vector<ParameterDescription>& described) {
  ParameterSet values;
  for (const auto& [name, value] : given) {
    const auto& description = description_of(py::cast<std::string>(name), described);
    if (!value.is_none()) values.emplace_back(description.key, value_from(value, description));
  }
  return values;
}

py::object object_from(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return py::module_::import("json").attr("loads")(text);
}

py::tuple view_tuple(ViewIndex view) {
  return py::make_tuple(view.v, view.u);
}

std::optional<ViewIndex> view_from(const py::object& view, GridShape grid) {
  if (view.is_none()) return std::nullopt;
  try {
    const auto [v, u] = pair_from<int>(view);
    if (grid.contains({v, u})) return ViewIndex{v, u};
  } catch (const py::cast_error&) {  // told below
  }
  throw InvalidInput("the view is " + py::cast<std::string>(py::str(view)) +
                     ", but must be (v, u), row and column, of the " + std::to_string(grid.v) +
                     "×" + std::to_string(grid.u) + " views");
}

py::tuple interval_tuple(const Interval& interval) {
  return py::make_tuple(interval.min, interval.max);
}

std::string path_from(const py::object& path) {
  return py::cast<std::string>(py::module_::import("os").attr("fsdecode")(path));
}

}  // namespace episcope::python
