// SPDX-License-Identifier: BSD-3-Clause
#include "app/python/light_fields.h"

#include "app/python/job.h"
#include "app/session/load_scene.h"
#include "app/session/scene_summary.h"
#include "engine/core/camera_grid.h"
#include "engine/core/error.h"
#include "engine/core/light_field.h"
#include "engine/io/base/array_input.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/open_options.h"

#include <pybind11/stl.h>

#include <cstring>
#include <map>
#include <utility>
#include <variant>

namespace episcope::python {

std::vector<std::string> OpenedScene::notes() const {
  std::vector<std::string> notes = scene->convention.warnings;
  if (const std::string sign = sign_warning(scene->convention); !sign.empty()) {
    notes.push_back(sign);
  }
  return notes;
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

/// In C order, and in the byte order of this machine.
py::array in_order(const py::object& object) {
  const auto numpy = py::module_::import("numpy");
  const py::object array = numpy.attr("asarray")(object);
  return numpy.attr("ascontiguousarray")(array, array.attr("dtype").attr("newbyteorder")("="));
}

OpenedScene scene_of_array(const py::object& object, const std::string& name,
                           const py::kwargs& reading) {
  const py::array array = in_order(object);
  const auto schema = io::open_schema();
  ParameterSet given = parameters_from(reading, schema.descriptions());
  const bool has_axes = std::ranges::any_of(
      given, [](const auto& one) { return one.first == "axes" || one.first == "grid"; });
  if (!has_axes && array.ndim() == 5) given.emplace_back("axes", std::string("vuyxc"));
  if (!has_axes && array.ndim() == 4) given.emplace_back("axes", std::string("vuyx"));
  const io::OpenOptions options = schema.parse(given);
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

py::array epi_of(const OpenedScene& opened, const py::object& row, const py::object& column,
                 const py::object& view, double focus) {
  if (row.is_none() == column.is_none()) {
    throw InvalidInput("an EPI is of a row or of a column; give row=… or column=…");
  }
  const LightField& lf = opened.light_field();
  const ViewIndex at = view_from(view, lf.grid()).value_or(lf.center());
  if (column.is_none()) return array_of(horizontal_epi(lf, at, py::cast<int>(row), focus));
  return array_of(vertical_epi(lf, at, py::cast<int>(column), focus));
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
      .def_property_readonly("notes", &OpenedScene::notes,
                             "What one should know of how it was read, a sentence each.")
      .def("__repr__", text_of);
}

}  // namespace

void add_light_fields(py::module_& module) {
  add_camera(module);
  py::class_<OpenedScene> light_field(module, "LightField",
                                      R"(LightField(array, *, name='array', **reading)

A light field: views on a regular grid of cameras.

array: [v, u, y, x, c], or [v, u, y, x] of gray views; whole numbers or floats. Other orders by the
option axes, such as axes='yxvuc'. Samples are copied, and checked as those of a file are. reading:
the options of 'episcope-cli info --help', with _ for -.)");
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
the options of 'episcope-cli info --help', with _ for -, such as flip='u' or grid='9x9'.
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
  module.def("epi", epi_of, py::arg("light_field"), py::kw_only(), py::arg("row") = py::none(),
             py::arg("column") = py::none(), py::arg("view") = py::none(), py::arg("focus") = 0.0,
             R"(epi(light_field, *, row=None, column=None, view=None, focus=0.0)
--

An epipolar plane image, float32 in [0, 1]: [u, x, c] of an image row through the views of a camera
row, or [v, y, c] of an image column through those of a camera column.

view: (v, u) of a view on it; by default the center. A point of disparity focus, in px per view
step, stands upright.)");
}

}  // namespace episcope::python
