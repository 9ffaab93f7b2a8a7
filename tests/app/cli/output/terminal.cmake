# The progress bar is drawn on a terminal only, and not with --quiet. `script` lends a terminal.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
find_program(script script REQUIRED)

function(on_terminal expected)
  string(JOIN " " line ${ARGN})
  execute_process(COMMAND "${script}" -qec "'${CLI}' ${line}" /dev/null WORKING_DIRECTORY "${WORK}"
                  INPUT_FILE /dev/null RESULT_VARIABLE exit_code OUTPUT_VARIABLE out TIMEOUT 60)
  if(out MATCHES "\\[[#.]+\\] +[0-9]+ %")
    set(has_bar YES)
  else()
    set(has_bar NO)
  endif()
  if(NOT exit_code EQUAL 0 OR NOT has_bar STREQUAL expected)
    fail_case("bar on a terminal: ${has_bar}, expected ${expected}, exit code ${exit_code}: ${out}")
  endif()
endfunction()

on_terminal(YES synthesize edge -o lf.h5 --views 3x3 --size 64x64)
on_terminal(NO synthesize edge -o lf.h5 --views 3x3 --size 64x64 --quiet --overwrite)
on_terminal(NO info lf.h5 -q)
