# Ctrl+C: exit code 130, and nothing half-written is left.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
find_program(timeout timeout REQUIRED)

# interrupted(arguments…): sends SIGINT while it works, which is later on a busy machine: a program
# that has not come to listen yet dies of the signal without a word.
function(interrupted)
  file(MAKE_DIRECTORY "${WORK}/out")
  foreach(seconds 0.7 1.4 2.8 5.6)
    # --foreground: else the signal would come twice, by way of the process group.
    execute_process(COMMAND "${timeout}" --foreground -s INT --preserve-status ${seconds} "${CLI}"
                            ${ARGN}
                    WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE exit_code OUTPUT_VARIABLE out
                    ERROR_VARIABLE err TIMEOUT 60)
    if(NOT exit_code EQUAL 130 OR NOT err STREQUAL "")
      break()
    endif()
  endforeach()
  if(NOT exit_code EQUAL 130 OR NOT err STREQUAL "episcope-cli: cancelled\n" OR NOT out STREQUAL "")
    string(CONCAT text "interrupted after ${seconds} s: episcope-cli ${ARGN}\n"
           "  exit code ${exit_code}\n  out: ${out}\n  err: ${err}")
    fail_case("${text}")
  endif()
  expect_files(out)
endfunction()

# Scenes that take far longer than the time until the signal.
interrupted(synthesize demo -o out/lf.h5 --views 17x17 --size 1024x1024)
interrupted(estimate epi_l demo -o out/x.h5 --threads 1)
interrupted(info demo:objects --threads 1)

# Twice in a row, once the hidden temporary file is there: it is removed all the same.
find_program(sh sh REQUIRED)
foreach(pause 0 0.02)
  file(MAKE_DIRECTORY "${WORK}/twice")
  set(script "'${CLI}' synthesize fronto -q -o twice/lf.h5 --size 512x512 & cli=$!
    until ls twice/.*.part >/dev/null 2>&1; do kill -0 $cli || break; sleep 0.002; done
    kill -TERM $cli; sleep ${pause}; kill -TERM $cli; wait $cli; echo $?")
  execute_process(COMMAND "${sh}" -c "${script}" WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE out
                  ERROR_VARIABLE err TIMEOUT 240)
  if(NOT out STREQUAL "130\n")
    fail_case("interrupted twice, ${pause} s apart: ${out} ${err}")
  endif()
  expect_files(twice)
endforeach()
