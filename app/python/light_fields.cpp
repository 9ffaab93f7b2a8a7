// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/light_fields.h"

#include "app/python/job.h"
#include "app/session/load_scene.h"
#include "app/session/scene_summary.h"
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/core/camera_grid.h"
#include "engine/core/error.h"
#include "engine/core/light_field.h"
#include "engine/core/text.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/json.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/open_options.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <type_traits>
#include <utility>
#include <variant>

namespace episcope::python {

std::vector<std::string> OpenedScene::notes() const {
  std::vector<std::string> notes = scene->convention.warnings;
  std::ranges::move(order_warnings(scene->convention), std::back_inserter(notes));
  return in_python(std::move(notes));
}

namespace {

OpenedScene open_path(const std::string& input, bool needs_truth, const py::object& progress,
                      const py::kwargs& reading) {
  const auto schema = io::open_schema();
  const io::OpenOptions options = schema.parse(parameters_from(reading, schema.descriptions()));
  Scene scene = result_of_job(progress, 0, [&](const Progress& job) {
    return open_input(input, options, needs_truth, job);
  });
  return {std::make_shared<const Scene>(std::move(scene)), input};
}

io::NumberType number_type_of(const py::array& array) {
  using enum io::NumberType;
  static const std::map<std::string, io::NumberType> types = {
      {"b1", Bool},   {"i1", Int8},    {"u1", UInt8},   {"i2", Int16},
      {"u2", UInt16}, {"i4", Int32},   {"u4", UInt32},  {"i8", Int64},
      {"u8", UInt64}, {"f2", Float16}, {"f4", Float32}, {"f8", Float64}};
  const auto found = types.find(array.dtype().kind() + std::to_string(array.dtype().itemsize()));
  if (found != types.end()) return found->second;
  throw InvalidInput("the array holds " + py::cast<std::string>(py::str(array.dtype())) +
                     ", but a light field has whole numbers or floats; convert it first");
}

io::ArrayShape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

/// The numbers of an array in C order, which must outlive it.
class ArrayInMemory : public io::LinearArray {
 public:
  ArrayInMemory(const std::filesystem::path& name, const io::ArrayShape& shape, io::NumberType type,
                const void* numbers)
      : LinearArray(name, shape, type), numbers_(static_cast<const std::uint8_t*>(numbers)) {}

 private:
  void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const override {
    const std::size_t size = io::byte_size(type());
    std::memcpy(out, numbers_ + first * size, count * size);
  }

  const std::uint8_t* numbers_;
};

/// As a file would hold the array alone.
class FileInMemory : public io::ArrayFile {
 public:
  FileInMemory(const std::string& name, const py::array& array)
      : ArrayFile(name, "NumPy array"), numbers_(array.data()) {
    add({.name = {}, .shape = shape_of(array), .type = number_type_of(array)});
  }

 private:
  [[nodiscard]] std::unique_ptr<io::ArrayInput> open_stored(
      const io::ArrayEntry& entry) const override {
    return std::make_unique<ArrayInMemory>(path(), entry.shape, entry.type, numbers_);
  }

  const void* numbers_;
};

/// A masked array as floats with NaN where it is masked; others as they are.
py::object unmasked(const py::object& object) {
  const auto masked = py::module_::import("numpy").attr("ma");
  if (!py::isinstance(object, masked.attr("MaskedArray"))) return object;
  if (!py::cast<bool>(masked.attr("is_masked")(object))) return object.attr("data");
  const py::object floats = object.attr("astype")("float64");
  return floats.attr("filled")(std::numeric_limits<double>::quiet_NaN());
}

/// In C order, and in the byte order of this machine.
py::array in_order(const py::object& object) {
  const auto numpy = py::module_::import("numpy");
  const py::object array = numpy.attr("asarray")(unmasked(object));
  return numpy.attr("ascontiguousarray")(array, array.attr("dtype").attr("newbyteorder")("="));
}

/// Gray views of a square grid [v, u, y, x], whatever else their shape may mean.
bool are_gray_views(const py::array& array) {
  return array.ndim() == 4 && array.shape(0) == array.shape(1) &&
         array.shape(1) < std::min(array.shape(2), array.shape(3));
}

OpenedScene scene_of_array(const py::object& object, const std::string& name,
                           const py::kwargs& reading) {
  const py::array array = in_order(object);
  const auto schema = io::open_schema();
  io::OpenOptions options = schema.parse(parameters_from(reading, schema.descriptions()));
  if (options.axes.empty() && are_gray_views(array)) options.axes = "vuyx";
  const FileInMemory file(name, array);
  Scene scene = result_of_job(
      py::none(), 0, [&](const Progress& job) { return io::read_arrays(file, options, job); });
  return {std::make_shared<const Scene>(std::move(scene))};
}

py::array views_of(const OpenedScene& opened) {
  const LightFieldPtr& light_field = opened.scene->light_field;
  return std::visit([&](const auto& stack) { return array_of(stack, light_field, Channels::Yes); },
                    light_field->samples());
}

py::object truth_of(OpenedScene& opened) {
  if (!opened.truth) {
    const GroundTruthPtr& truth = opened.scene->truth;
    opened.truth = disparity_array(truth->field, truth);
  }
  return opened.truth;
}

py::object labels_of(const OpenedScene& opened) {
  const GroundTruthPtr& truth = opened.scene->truth;
  if (truth->labels.empty()) return py::none();
  return array_of(truth->labels, truth, Channels::No);
}

py::object camera_of(const OpenedScene& opened) {
  const CameraGrid& camera = opened.light_field().info().camera;
  return camera.is_known() ? py::cast(camera) : py::object(py::none());
}

py::object promised_range(const OpenedScene& opened) {
  const auto& range = opened.light_field().info().disparity_range;
  return range ? py::object(interval_tuple(*range)) : py::object(py::none());
}

std::string text_of(const OpenedScene& opened) {
  const LightField& lf = opened.light_field();
  return "<episcope.LightField " + lf.info().name + ": " + std::to_string(lf.grid().v) + "×" +
         std::to_string(lf.grid().u) + " views of " + std::to_string(lf.width()) + "×" +
         std::to_string(lf.height()) + " px>";
}

/// Number of a line of pixels.
int line_from(const char* name, const py::object& line) {
  try {
    return py::cast<int>(line);
  } catch (const py::cast_error&) {
    throw InvalidInput(std::string(name) + " is " + py::cast<std::string>(py::repr(line)) +
                       ", but must be a whole number from 0");
  }
}

py::array epi_of(const py::object& light_field, const py::object& row, const py::object& column,
                 const py::object& view, double focus) {
  if (row.is_none() == column.is_none()) {
    throw InvalidInput("an EPI is of a row or of a column; give row=… or column=…");
  }
  const LightField& lf = scene_from(light_field).light_field();
  const ViewIndex at = view_from(view, lf.grid()).value_or(lf.center());
  if (column.is_none()) return array_of(horizontal_epi(lf, at, line_from("row", row), focus));
  return array_of(vertical_epi(lf, at, line_from("column", column), focus));
}

void add_camera(py::module_& module) {
  py::class_<CameraGrid>(module, "Camera", R"(The camera grid, which turns depth into disparity:
disparity = baseline · focal_length / depth − shift.)")
      .def_readonly("baseline", &CameraGrid::baseline,
                    "Distance of neighboring cameras; with focal_length in px · unit of depth.")
      .def_readonly("focal_length", &CameraGrid::focal_length)
      .def_readonly("shift", &CameraGrid::shift, "px per view step.")
      .def("disparity", py::vectorize(&CameraGrid::disparity_from_depth), py::arg("depth"),
           R"(disparity(depth)
--

Disparity in px per view step of depths, a number or an array; NaN where a depth is not above 0.)")
      .def("depth", py::vectorize(&CameraGrid::depth_from_disparity), py::arg("disparity"),
           R"(depth(disparity)
--

Depth of disparities in px per view step, a number or an array; NaN where no point in front of the
camera has that disparity.)");
}

void add_properties(py::class_<OpenedScene>& light_field) {
  light_field
      .def_property_readonly(
          "views", views_of,
          R"(The samples, read-only, [v, u, y, x, c]: uint8, uint16 or float32 as stored. v: camera
row, downwards; u: camera column, to the right; c: gray, or red, green, blue. No copy: the array
keeps the light field alive.)")
      .def_property_readonly(
          "truth", truth_of,
          R"(True disparity, float32 in px per view step, positive nearer than the
plane of zero disparity; NaN where it is not known. [v, u, y, x], or [y, x] of one view.
None without truth.)")
      .def_property_readonly(
          "labels", labels_of,
          R"(True labels, int32, [v, u, y, x], or [y, x] of one view. None without them.)")
      .def_property_readonly("camera", camera_of,
                             "The Camera that turns depth into disparity; None if it is not known.")
      .def_property_readonly(
          "range", promised_range,
          R"((min, max) of the disparity that the files promise, px per view step; else None.)")
      .def_property_readonly(
          "center",
          [](const OpenedScene& opened) { return view_tuple(opened.light_field().center()); },
          "(v, u) of the center view.")
      .def_property_readonly(
          "name", [](const OpenedScene& opened) { return opened.light_field().info().name; })
      .def_property_readonly(
          "source", [](const OpenedScene& opened) { return opened.input; },
          "What opens it again; empty for an array.")
      .def_property_readonly(
          "order", [](const OpenedScene& opened) { return opened.scene->convention.order; },
          "The order of views that was found.")
      .def_property_readonly(
          "sign", [](const OpenedScene& opened) { return opened.scene->convention.sign; },
          "How near and far were told apart; empty if they could not be.")
      .def_property_readonly(
          "units", [](const OpenedScene& opened) { return opened.scene->convention.units; },
          "What the numbers of the truth were taken for.")
      .def_property_readonly("notes", &OpenedScene::notes,
                             "What one should know of how it was read, a sentence each.")
      .def("__repr__", text_of);
}

OpenedScene decode_raw(const py::object& raw, const py::object& white, const py::object& dark,
                       const py::object& camera, const std::string& mosaic, int views, double step,
                       bool linear, const py::object& progress) {
  const auto path = [](const py::object& file) {
    return file.is_none() ? std::string() : path_from(file);
  };
  if (views < 0 || (views > 0 && views % 2 == 0) || !(step >= 0)) {
    throw InvalidInput("views must be odd and step above 0; 0 leaves them to the lenses");
  }
  capture::PictureFiles files{path(raw), path(white), path(dark), path(camera), {}};
  for (const auto& each : names_of(capture::Mosaic{})) {
    if (lower_case(mosaic) == each.name) files.mosaic = each.value;
  }
  if (!files.mosaic) {
    throw InvalidInput("mosaic is '" + mosaic + "', but must be one of " +
                       joined(all_names<capture::Mosaic>(), ", "));
  }
  Scene scene = result_of_job(progress, 0, [&](const Progress& job) {
    return capture::decode_files(files, {views, step, linear}, job);
  });
  return {std::make_shared<const Scene>(std::move(scene)), files.raw.string()};
}

}  // namespace

void add_light_fields(py::module_& module) {
  add_camera(module);
  py::class_<OpenedScene> light_field(module, "LightField",
                                      R"(LightField(array, *, name='array', **reading)

A light field: views on a regular grid of cameras.

array: [v, u, y, x, c], or [v, u, y, x] of gray views, or as else open reads it of an .npy file, such
as a list of views [n, y, x, c]; whole numbers or floats. State the order by the option axes, such as
axes='yxvuc'. Samples are copied, and checked as those of a file are. reading:
the options of 'episcope-cli help reading', with _ for -.)");
  light_field.def(py::init(&scene_of_array), py::arg("array"), py::kw_only(),
                  py::arg("name") = "array");
  add_properties(light_field);
  module.def(
      "open",
      [](const py::object& path, bool truth, const py::object& progress,
         const py::kwargs& reading) {
        return open_path(path_from(path), truth, progress, reading);
      },
      py::arg("path"), py::kw_only(), py::arg("truth") = true, py::arg("progress") = py::none(),
      R"(open(path, *, truth=True, progress=None, **reading)
--

Opens a light field: a file or a folder of any form, 'demo', or 'demo:SCENE'.

truth: whether truth and labels are wanted. progress: called as progress(fraction, step). reading:
the options of 'episcope-cli help reading', with _ for -, such as flip='u' or grid='9x9'.
Raises IoError for what cannot be read, InvalidInput for an option that does not fit.)");
  module.def(
      "demo",
      [](const std::string& scene, const py::object& progress) {
        return open_path(scene.empty() ? "demo" : "demo:" + scene, true, progress, {});
      },
      py::arg("scene") = "", py::kw_only(), py::arg("progress") = py::none(),
      R"(demo(scene='', *, progress=None)
--

A built-in scene with exact truth, such as 'edge', 'bars' or 'random?seed=7'.)");
  module.def("decode", decode_raw, py::arg("raw"), py::kw_only(), py::arg("white") = py::none(),
             py::arg("dark") = py::none(), py::arg("camera") = py::none(),
             py::arg("mosaic") = "gray", py::arg("views") = 0, py::arg("step") = 0.0,
             py::arg("linear") = false, py::arg("progress") = py::none(),
             R"(decode(raw, *, white=None, dark=None, camera=None, mosaic='gray', views=0, step=0.0,
       linear=False, progress=None)
--

A LightField of a raw picture of a plenoptic camera, as 'episcope-cli decode' makes it.

raw: a container (.lfp, .lfr), a bare .raw with its JSON beside it, or a picture. white: a picture,
or calibration data (a folder or a tar); by default what the raw file or its folder holds. mosaic:
'gray', 'rggb', 'grbg', 'gbrg' or 'bggr', of a picture that does not tell. views: along each axis,
odd; step: px between them below a lens; 0 = as the lenses have room. The notes of the light field
tell what was taken.
Raises IoError for what cannot be read, InvalidInput where no lenses are found.)");
  module.def("epi", epi_of, py::arg("light_field"), py::kw_only(), py::arg("row") = py::none(),
             py::arg("column") = py::none(), py::arg("view") = py::none(), py::arg("focus") = 0.0,
             R"(epi(light_field, *, row=None, column=None, view=None, focus=0.0)
--

An epipolar plane image, float32 in [0, 1]: [u, x, c] of an image row through the views of a camera
row, or [v, y, c] of an image column through those of a camera column.

view: (v, u) of a view on it; by default the center. A point of disparity focus, in px per view
step, stands upright.)");
}

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

namespace {

/// Whole numbers beyond 32 bits would become others.
void require_ids(const py::array& numbers, const std::string& what) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max() - 1;
  if (numbers.size() == 0) return;
  const auto largest = py::cast<double>(numbers.attr("max")());
  if (largest <= kMost) return;
  throw InvalidInput(fmt::format("{} hold {:.0f}, but at most {} is expected; number them anew",
                                 what, largest, kMost));
}

}  // namespace

template <class T>
OrderedArray<T> numbers_from(const py::object& array, const std::string& what) {
  constexpr bool is_whole = std::is_integral_v<T>;
  const std::string kinds = is_whole ? "biu" : "biuf";
  const std::string numbers = is_whole ? "whole numbers" : "numbers";
  if (names_path(array)) {
    throw InvalidInput("an array of " + numbers + " is expected for " + what + ", not the path '" +
                       path_from(array) + "'; read the file first");
  }
  const auto given = py::array::ensure(unmasked(array));
  if (given && kinds.find(given.dtype().kind()) != std::string::npos) {
    if (is_whole) require_ids(given, what);
    return OrderedArray<T>(given);
  }
  if (is_whole && given && given.dtype().kind() == 'f') {  // as MATLAB stores whole numbers
    const auto numpy = py::module_::import("numpy");
    const py::array whole = numpy.attr("where")(numpy.attr("isnan")(given), 0, given);
    if (py::cast<bool>(numpy.attr("array_equal")(whole, numpy.attr("rint")(whole)))) {
      require_ids(whole, what);
      return OrderedArray<T>(py::array(whole.attr("astype")("int32")));
    }
  }
  const bool is_array = py::isinstance<py::array>(array);
  const py::object found = is_array ? array.attr("dtype") : py::type::of(array).attr("__name__");
  throw InvalidInput("an array of " + numbers + " is expected for " + what + ", not " +
                     (is_array ? "of " : "") + py::cast<std::string>(py::str(found)) +
                     "; give one of " + (is_whole ? "int32" : "float32"));
}

template OrderedArray<std::int32_t> numbers_from(const py::object&, const std::string&);
template OrderedArray<float> numbers_from(const py::object&, const std::string&);

template <class T>
ViewStack<T> maps_from(const OrderedArray<T>& array, GridShape grid, const std::string& what) {
  const bool has_channel = array.ndim() % 2 == 1 && array.shape(array.ndim() - 1) == 1;
  const py::ssize_t axes = array.ndim() - (has_channel ? 1 : 0);
  const bool is_center = axes == 2;
  const bool is_all = axes == 4 && array.shape(0) == grid.v && array.shape(1) == grid.u;
  if ((!is_center && !is_all) || array.size() == 0) {
    throw InvalidInput(what + " have the shape " + shape_text(array) +
                       ", but must be [y][x] of the center view or [v][u][y][x] of the " +
                       std::to_string(grid.v) + "×" + std::to_string(grid.u) + " views");
  }
  const auto length = [&](py::ssize_t from_end) {
    return static_cast<int>(array.shape(axes - from_end));
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

std::string in_python(const std::string& sentence) {
  static const std::regex option("--([a-z][a-z-]*[a-z])");
  std::string text;
  std::size_t end = 0;
  for (std::sregex_iterator match(sentence.begin(), sentence.end(), option), last; match != last;
       ++match) {
    std::string name = (*match)[1];
    std::ranges::replace(name, '-', '_');
    text += sentence.substr(end, static_cast<std::size_t>(match->position()) - end) + name;
    end = static_cast<std::size_t>(match->position() + match->length());
  }
  return text + sentence.substr(end);
}

std::vector<std::string> in_python(std::vector<std::string> sentences) {
  for (std::string& sentence : sentences) sentence = in_python(sentence);
  return sentences;
}

py::object object_from(const nlohmann::ordered_json& json) {
  const std::string text = io::json_text(json);
  return py::module_::import("json").attr("loads")(text);
}

py::tuple view_tuple(ViewIndex view) {
  return py::make_tuple(view.v, view.u);
}

std::optional<ViewIndex> view_from(const py::object& view, GridShape grid) {
  if (view.is_none()) return std::nullopt;
  try {
    if (!py::isinstance<py::sequence>(view)) throw py::cast_error();
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

const OpenedScene& scene_from(const py::object& light_field) {
  if (py::isinstance<OpenedScene>(light_field)) return py::cast<const OpenedScene&>(light_field);
  throw py::type_error("light_field must be a LightField, not " +
                       py::cast<std::string>(py::type::of(light_field).attr("__name__")) +
                       "; episcope.open(path) and episcope.LightField(array) make one");
}

bool names_path(const py::object& object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

std::string path_from(const py::object& path) {
  return py::cast<std::string>(py::module_::import("os").attr("fsdecode")(path));
}

}  // namespace episcope::python
