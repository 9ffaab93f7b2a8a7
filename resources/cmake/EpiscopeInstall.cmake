# What is installed, in components: cli, window, python and dev. Included last, when every target is
# known.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Installing takes what was built; it does not build the tests first. See the target `packages`.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(EpiscopePages)

# episcope_install_files(component folder file…)
function(episcope_install_files component folder)
  install(FILES ${ARGN} DESTINATION "${folder}" COMPONENT ${component})
endfunction()

install(TARGETS episcope-cli RUNTIME COMPONENT cli)
install(DIRECTORY "${pages}/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT cli
        PATTERN "episcope.1.gz" EXCLUDE)
episcope_install_files(cli "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
                       "${pages}/bash/episcope-cli")
episcope_install_files(cli "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions"
                       "${pages}/zsh/_episcope-cli")
episcope_install_files(cli "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d"
                       "${pages}/fish/episcope-cli.fish")
install(DIRECTORY "${CMAKE_SOURCE_DIR}/resources/blender" DESTINATION "${CMAKE_INSTALL_DATADIR}/episcope"
        COMPONENT cli PATTERN "__pycache__" EXCLUDE)
episcope_install_files(cli "${CMAKE_INSTALL_DATADIR}/episcope/weights"
                       "${CMAKE_SOURCE_DIR}/resources/weights/net.npz")
if(EPISCOPE_GUI)
  install(TARGETS episcope RUNTIME COMPONENT window)
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/resources/manual/pages/"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/episcope/manual" COMPONENT window)
  episcope_install_files(window "${CMAKE_INSTALL_MANDIR}/man1" "${pages}/man/episcope.1.gz")
  install(PROGRAMS "${packaging}/desktop/episcope-thumbnailer" TYPE BIN COMPONENT window)
  episcope_install_files(window "${CMAKE_INSTALL_DATADIR}/applications"
                         "${packaging}/desktop/episcope.desktop")
  episcope_install_files(window "${CMAKE_INSTALL_DATADIR}/mime/packages"
                         "${packaging}/desktop/episcope.xml")
  episcope_install_files(window "${CMAKE_INSTALL_DATADIR}/thumbnailers"
                         "${packaging}/desktop/episcope.thumbnailer")
  episcope_install_files(window "${CMAKE_INSTALL_DATADIR}/metainfo"
                         "${pages}/org.episcope.Episcope.metainfo.xml")
  set(icons "${CMAKE_INSTALL_DATADIR}/icons")
  episcope_install_files(window "${icons}/hicolor/scalable/apps"
                         "${packaging}/desktop/episcope.svg")
  if(EPISCOPE_RSVG)
    install(DIRECTORY "${pages}/icons/hicolor" DESTINATION "${icons}" COMPONENT window)
  endif()
endif()

if(EPISCOPE_HAS_PYTHON)
  set(modules lib/python3/dist-packages/episcope)  # where Debian's Python finds it, whichever its version
  install(TARGETS episcope_python LIBRARY DESTINATION "${modules}" COMPONENT python)
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/app/python/episcope/" DESTINATION "${modules}" COMPONENT python
          PATTERN "__pycache__" EXCLUDE)
  # Its own, for it is installed without the command line as well.
  episcope_install_files(python "${modules}/share/episcope/weights"
                         "${CMAKE_SOURCE_DIR}/resources/weights/net.npz")
endif()

# episcope_libraries_in(out folder): the libraries that are added in a folder and below.
function(episcope_libraries_in out folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  set(libraries)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "STATIC_LIBRARY" OR type STREQUAL "INTERFACE_LIBRARY")
      list(APPEND libraries ${target})
    endif()
  endforeach()
  get_property(rooms DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(room ${rooms})
    episcope_libraries_in(below "${room}")
    list(APPEND libraries ${below})
  endforeach()
  set(${out} ${libraries} PARENT_SCOPE)
endfunction()

# The engine: static libraries, headers and find_package(Episcope).
episcope_libraries_in(engine "${CMAKE_SOURCE_DIR}/engine")
foreach(library episcope_options ${engine})
  string(REGEX REPLACE "^episcope_" "" name "${library}")
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS episcope_options ${engine} EXPORT EpiscopeTargets ARCHIVE COMPONENT dev)
set(config "${CMAKE_INSTALL_LIBDIR}/cmake/Episcope")
install(EXPORT EpiscopeTargets NAMESPACE Episcope:: DESTINATION "${config}" COMPONENT dev)
install(DIRECTORY "${CMAKE_SOURCE_DIR}/engine" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/episcope"
        COMPONENT dev FILES_MATCHING PATTERN "*.h")
set(EPISCOPE_OPENCV_COMPONENTS core imgproc imgcodecs ml calib3d features2d)
if(TARGET opencv_aruco)
  list(APPEND EPISCOPE_OPENCV_COMPONENTS aruco)
endif()
list(JOIN EPISCOPE_OPENCV_COMPONENTS " " EPISCOPE_OPENCV_COMPONENTS)
configure_package_config_file("${packaging}/EpiscopeConfig.cmake.in"
                              "${CMAKE_BINARY_DIR}/EpiscopeConfig.cmake" INSTALL_DESTINATION "${config}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/EpiscopeConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
episcope_install_files(dev "${config}" "${CMAKE_BINARY_DIR}/EpiscopeConfig.cmake"
                       "${CMAKE_BINARY_DIR}/EpiscopeConfigVersion.cmake"
                       "${CMAKE_SOURCE_DIR}/resources/cmake/FindMatio.cmake"
                       "${CMAKE_SOURCE_DIR}/resources/cmake/FindOpenCV.cmake")

include(EpiscopePackaging)
