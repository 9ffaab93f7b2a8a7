// SPDX-License-Identifier: BSD-3-Clause
#include "app/about/version_text.h"
#include "app/python/estimates.h"
#include "app/python/labels.h"
#include "app/python/light_fields.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/version.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

namespace episcope::python {
namespace {

py::object builtin(PyObject* type) {
  return py::reinterpret_borrow<py::object>(type);
}

void add_exception(py::module_& module, const char* name, const char* text,
                   const py::object& bases) {
  const std::string full = std::string("episcope.") + name;
  const auto made = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(full.c_str(), text, bases.ptr(), nullptr));
  if (!made) throw py::error_already_set();
  module.attr(name) = made;
}

void add_exceptions(py::module_& module) {
  add_exception(module, "Error", "Whatever fails, in one sentence that says what to do.",
                builtin(PyExc_Exception));
  const py::object error = module.attr("Error");
  add_exception(module, "InvalidInput",
                "A shape, a range, a name or a parameter that does not fit.",
                py::make_tuple(error, builtin(PyExc_ValueError)));
  add_exception(module, "IoError", "Reading or writing failed; the sentence begins with the path.",
                py::make_tuple(error, builtin(PyExc_OSError)));
  add_exception(module, "Unavailable", "Something that this build or machine does not have.",
                py::make_tuple(error, builtin(PyExc_RuntimeError)));
}

void set_error(const char* name, const Error& error) {
  const py::object type = py::module_::import("episcope._episcope").attr(name);
  PyErr_SetString(type.ptr(), in_python(error.what()).c_str());
}

void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const Cancelled&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } catch (const InvalidInput& error) {
    set_error("InvalidInput", error);
  } catch (const IoError& error) {
    set_error("IoError", error);
  } catch (const Unavailable& error) {
    set_error("Unavailable", error);
  } catch (const Error& error) {
    set_error("Error", error);
  }
}

}  // namespace
}  // namespace episcope::python

PYBIND11_MODULE(_episcope, module) {
  using namespace episcope;
  pybind11::options options;
  options.disable_function_signatures();  // the texts begin with them, as inspect reads them
  use_cache_for_scratch();
  state_built_commit(kCommit);
  module.attr("__version__") = kVersion;
  python::add_exceptions(module);
  pybind11::register_exception_translator(python::translate);
  python::add_light_fields(module);
  python::add_estimates(module);
  python::add_labels(module);
}
