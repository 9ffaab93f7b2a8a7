# What is made for those who install the programs: pages of the manual and completions from the
# programs themselves, icons, metadata. The target is `pages`.
set(pages "${CMAKE_BINARY_DIR}/pages")
set(packaging "${CMAKE_SOURCE_DIR}/resources/packaging")
set(made "${pages}/made")
find_program(EPISCOPE_GZIP gzip REQUIRED)
find_program(EPISCOPE_RSVG rsvg-convert)
set(EPISCOPE_ICON_SIZES 16 22 24 32 48 64 128 256 512)
# Where the project is on the web; AppStream's screenshots have addresses, or there are none.
set(EPISCOPE_WEB "" CACHE STRING "Address of the project's files on the web, for AppStream")

set(window_help)
if(EPISCOPE_GUI)
  set(window_help "${pages}/episcope_help.txt")
  add_custom_command(OUTPUT "${window_help}" COMMAND sh -c "exec \"$0\" --help >\"$1\""
                     $<TARGET_FILE:episcope> "${window_help}" DEPENDS episcope VERBATIM)
endif()
# Compressed without names and times: the same bytes whenever they are made.
add_custom_command(
  OUTPUT "${made}"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf man bash zsh fish
  COMMAND episcope_pages . ${window_help}
  COMMAND sh -c "exec \"$0\" -9n man/*.1" "${EPISCOPE_GZIP}"
  COMMAND sh -c "exec \"$0\" -9nc \"$1\" >changelog.gz" "${EPISCOPE_GZIP}"
          "${packaging}/debian/changelog"
  COMMAND "${CMAKE_COMMAND}" -E touch "${made}"
  WORKING_DIRECTORY "${pages}"
  DEPENDS episcope_pages ${window_help} "${packaging}/debian/changelog" VERBATIM)
set(icons)
if(EPISCOPE_GUI AND EPISCOPE_RSVG)
  foreach(size ${EPISCOPE_ICON_SIZES})
    set(icon "${pages}/icons/hicolor/${size}x${size}/apps/episcope.png")
    add_custom_command(OUTPUT "${icon}"
                       COMMAND "${CMAKE_COMMAND}" -E make_directory "${pages}/icons/hicolor/${size}x${size}/apps"
                       COMMAND "${EPISCOPE_RSVG}" -w ${size} -h ${size} "${packaging}/desktop/episcope.svg"
                               -o "${icon}"
                       DEPENDS "${packaging}/desktop/episcope.svg" VERBATIM)
    list(APPEND icons "${icon}")
  endforeach()
endif()
file(MAKE_DIRECTORY "${pages}")
add_custom_target(pages DEPENDS "${made}" ${icons})

# The metadata of AppStream, with the version and its date from the changelog.
file(READ "${packaging}/debian/changelog" changelog)
if(NOT changelog MATCHES "^episcope \\(${PROJECT_VERSION}\\)")
  message(FATAL_ERROR "resources/packaging/debian/changelog does not begin with version "
                      "${PROJECT_VERSION}; add an entry")
endif()
string(REGEX MATCH "([0-9]+) ([A-Z][a-z][a-z]) ([0-9][0-9][0-9][0-9])" date "${changelog}")
set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
list(FIND months "${CMAKE_MATCH_2}" month)
math(EXPR month "${month} + 101")
string(SUBSTRING "${month}" 1 2 month)
set(EPISCOPE_RELEASE_DATE "${CMAKE_MATCH_3}-${month}-${CMAKE_MATCH_1}")
set(EPISCOPE_WEB_ELEMENTS "")
if(EPISCOPE_WEB)
  set(EPISCOPE_WEB_ELEMENTS "  <url type=\"homepage\">${EPISCOPE_WEB}</url>
  <screenshots>
    <screenshot type=\"default\">
      <caption>A view with the error of its disparity laid over it, and its two EPIs</caption>
      <image type=\"source\" width=\"1280\" height=\"800\">${EPISCOPE_WEB}/resources/manual/pages/pictures/window.png</image>
    </screenshot>
    <screenshot>
      <caption>Strokes of eleven labels and the segmentation learnt from them</caption>
      <image type=\"source\" width=\"1280\" height=\"800\">${EPISCOPE_WEB}/resources/manual/pages/pictures/annotate.png</image>
    </screenshot>
  </screenshots>
")
endif()
configure_file("${packaging}/desktop/org.episcope.Episcope.metainfo.xml.in"
               "${pages}/org.episcope.Episcope.metainfo.xml" @ONLY)
# As Debian formats a licence: every line led by a space, empty ones by a dot.
file(READ "${CMAKE_SOURCE_DIR}/LICENSE" EPISCOPE_LICENSE_TEXT)
string(STRIP "${EPISCOPE_LICENSE_TEXT}" EPISCOPE_LICENSE_TEXT)
string(REGEX REPLACE "\n\n" "\n.\n" EPISCOPE_LICENSE_TEXT "${EPISCOPE_LICENSE_TEXT}")
string(REPLACE "\n" "\n " EPISCOPE_LICENSE_TEXT " ${EPISCOPE_LICENSE_TEXT}")
configure_file("${packaging}/debian/copyright.in" "${pages}/copyright" @ONLY)
