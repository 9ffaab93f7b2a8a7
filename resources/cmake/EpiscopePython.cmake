# The package `episcope` for Python, where there is pybind11: for the Python of the system, whose packages
# it is one of, unless Python_EXECUTABLE names another.
set(EPISCOPE_PYTHON AUTO CACHE STRING "Build the package for Python: AUTO = if there is pybind11, ON, OFF")
set_property(CACHE EPISCOPE_PYTHON PROPERTY STRINGS AUTO ON OFF)

set(EPISCOPE_HAS_PYTHON OFF)
if(NOT EPISCOPE_PYTHON)
  return()
endif()
if(EPISCOPE_SANITIZE)
  message(STATUS "No package for Python: it does not load libraries with sanitizers")
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # not one that a version manager puts before it
endif()
find_package(Python 3 QUIET COMPONENTS Interpreter Development.Module NumPy)
if(Python_FOUND)
  find_package(pybind11 QUIET CONFIG)
endif()
if(Python_FOUND AND pybind11_FOUND)
  set(EPISCOPE_HAS_PYTHON ON)
  # The module is a shared library of the static ones. As hidden as they are, their symbols cost no
  # more than those of position-independent programs do.
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(CMAKE_CXX_VISIBILITY_PRESET hidden)
elseif(EPISCOPE_PYTHON STREQUAL "AUTO")
  message(STATUS "No package for Python: there is no pybind11 (Debian: pybind11-dev python3-dev python3-numpy)")
else()
  message(FATAL_ERROR "There is no pybind11 for Python; install pybind11-dev, python3-dev and "
                      "python3-numpy, or build with -DEPISCOPE_PYTHON=OFF")
endif()
