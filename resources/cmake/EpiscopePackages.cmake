# Every find_package of the project. The headless build never looks for Qt or VTK.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(Boost REQUIRED)
if(EPISCOPE_ESTIMATORS_ONLY)
  find_package(OpenCV QUIET COMPONENTS core imgproc ml)  # for the labeler, if there is one
  return()
endif()
find_package(HDF5 REQUIRED COMPONENTS C HL)
find_package(ZLIB REQUIRED)
find_package(Matio REQUIRED)
find_package(liblzf REQUIRED CONFIG)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs ml calib3d features2d)
# For ChArUco boards; the build does without.
find_library(EPISCOPE_ARUCO_LIBRARY opencv_aruco)
find_path(EPISCOPE_ARUCO_INCLUDE_DIR opencv2/aruco/charuco.hpp PATH_SUFFIXES opencv4)
if(EPISCOPE_ARUCO_LIBRARY AND EPISCOPE_ARUCO_INCLUDE_DIR AND NOT TARGET opencv_aruco)
  add_library(opencv_aruco UNKNOWN IMPORTED)
  set_target_properties(opencv_aruco PROPERTIES IMPORTED_LOCATION "${EPISCOPE_ARUCO_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${EPISCOPE_ARUCO_INCLUDE_DIR}"
                        INTERFACE_LINK_LIBRARIES "opencv_calib3d;opencv_imgproc;opencv_core")
endif()
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(assimp REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavfilter libavformat libavcodec libswscale libavutil)

if(EPISCOPE_GUI)
  find_package(Qt6 REQUIRED COMPONENTS Widgets OpenGL Svg)
  # Always with components: without them VTK wants Qt 5.
  find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel CommonTransforms
               FiltersCore InteractionStyle InteractionWidgets RenderingAnnotation
               RenderingCore RenderingFreeType RenderingOpenGL2)
endif()
if(EPISCOPE_TESTS)
  if(EPISCOPE_GUI)
    find_package(Qt6 REQUIRED COMPONENTS Test)
  endif()
endif()
if(EPISCOPE_BENCH)
  find_package(benchmark REQUIRED)
endif()
