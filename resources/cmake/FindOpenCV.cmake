# OpenCV by its own configuration files, else by its headers and libraries: Debian ships the files
# with libopencv-dev alone, which brings five times what the modules that are used here need.
# Makes the targets opencv_<component>, and OpenCV_INCLUDE_DIRS.
find_package(OpenCV QUIET CONFIG COMPONENTS ${OpenCV_FIND_COMPONENTS})
if(OpenCV_FOUND)
  return()
endif()

find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(libraries)
foreach(component ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${component}_LIBRARY opencv_${component})
  list(APPEND libraries OpenCV_${component}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR ${libraries})
mark_as_advanced(OpenCV_INCLUDE_DIR ${libraries})
set(OpenCV_INCLUDE_DIRS "${OpenCV_INCLUDE_DIR}")
foreach(component ${OpenCV_FIND_COMPONENTS})
  add_library(opencv_${component} UNKNOWN IMPORTED)
  set_target_properties(opencv_${component} PROPERTIES
                        IMPORTED_LOCATION "${OpenCV_${component}_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
  if(NOT component STREQUAL core)
    set_property(TARGET opencv_${component} PROPERTY INTERFACE_LINK_LIBRARIES opencv_core)
  endif()
endforeach()
