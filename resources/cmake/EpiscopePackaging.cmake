# Packages of what is installed: the target `packages` builds the programs and makes Debian packages and
# a tarball of them in packages/ of the build folder.
set(EPISCOPE_MAINTAINER "Episcope authors <episcope@lists.example.org>" CACHE STRING
    "Who answers for the packages, as Debian writes it")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME episcope)
set(CPACK_PACKAGE_VENDOR "Episcope authors")
set(CPACK_PACKAGE_CONTACT "${EPISCOPE_MAINTAINER}")
set(CPACK_RESOURCE_FILE_LICENSE "${CMAKE_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL cli dev)
if(EPISCOPE_GUI)
  list(PREPEND CPACK_COMPONENTS_ALL window)
endif()
if(EPISCOPE_HAS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# episcope_debian_package(component name [ARCHITECTURE …]): its synopsis and description are those in
# resources/packaging/debian/<name>.txt, synopsis first.
function(episcope_debian_package component name)
  string(TOUPPER ${component} id)
  file(STRINGS "${packaging}/debian/${name}.txt" lines)
  list(JOIN lines "\n" text)
  set(CPACK_DEBIAN_${id}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${id}_DESCRIPTION "${text}" PARENT_SCOPE)
  episcope_install_files(${component} "${CMAKE_INSTALL_DATAROOTDIR}/doc/${name}" "${pages}/copyright"
                         "${pages}/changelog.gz")
endfunction()
episcope_debian_package(cli episcope-cli)
if(EPISCOPE_GUI)
  episcope_debian_package(window episcope)
endif()
episcope_debian_package(dev libepiscope-dev)
if(EPISCOPE_HAS_PYTHON)
  episcope_debian_package(python python3-episcope)
  # The module is for one version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${packaging}/debian/python3-episcope/postinst"
                                                "${packaging}/debian/python3-episcope/prerm")
endif()
set(CPACK_DEBIAN_WINDOW_PACKAGE_DEPENDS "episcope-cli (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_WINDOW_PACKAGE_RECOMMENDS "qt6-wayland, libgl1-mesa-dri, qt6-translations-l10n")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
execute_process(COMMAND sh -c ". resources/packages.sh; echo $LIBRARY_PACKAGES"
                WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}" OUTPUT_VARIABLE libraries
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(TARGET opencv_aruco)
  string(APPEND libraries " libopencv-contrib-dev")
endif()
string(REPLACE " " ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${libraries}")

include(CPack)
set(programs episcope-cli)
if(EPISCOPE_GUI)
  list(APPEND programs episcope)
endif()
if(EPISCOPE_HAS_PYTHON)
  list(APPEND programs episcope_python)
endif()
add_custom_target(packages
  COMMAND "${CMAKE_CPACK_COMMAND}"
  DEPENDS pages ${programs} ${engine}
  WORKING_DIRECTORY "${CMAKE_BINARY_DIR}" VERBATIM USES_TERMINAL)
