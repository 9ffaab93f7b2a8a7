# Every find_package of the project. The headless build never looks for Qt or VTK.
find_package(Threads REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(ZLIB REQUIRED)
find_package(Matio REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs ml)
find_package(PNG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(Boost REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavfilter libavformat libavcodec libswscale libavutil)

if(EPISCOPE_GUI)
  find_package(Qt6 REQUIRED COMPONENTS Widgets OpenGLWidgets Svg)
  # Always with components: without them VTK wants Qt 5.
  find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel CommonTransforms FiltersCore
               InteractionStyle InteractionWidgets RenderingAnnotation RenderingCore RenderingFreeType
               RenderingOpenGL2)
endif()
if(EPISCOPE_TESTS)
  if(EPISCOPE_GUI)
    find_package(Qt6 REQUIRED COMPONENTS Test)
  endif()
endif()
if(EPISCOPE_BENCH)
  find_package(benchmark REQUIRED)
endif()
