# Helpers that add tests.

# Seconds after which a test counts as hung; sanitizers slow them down by ten and more.
set(EPISCOPE_TEST_TIMEOUT 300)
if(EPISCOPE_SANITIZE)
  set(EPISCOPE_TEST_TIMEOUT 1800)
endif()

# episcope_add_test(name INPUTS file… COMMAND …): a test that depends on these files alone, so that
# test.sh can leave it out while they are the same (resources/run_test.sh).
function(episcope_add_test name)
  cmake_parse_arguments(ARG "" "" "INPUTS;COMMAND" ${ARGN})
  add_test(NAME ${name} COMMAND "${CMAKE_SOURCE_DIR}/resources/run_test.sh" ${name} ${ARG_INPUTS} --
                                ${ARG_COMMAND})
endfunction()

# episcope_add_tests(suite TESTS a_test.cpp room/b_test.cpp … [SUPPORT c.cpp …] LINK targets…
# [PREFIX io_] [ON_DISPLAY a_test …] [PROGRAMS files that the tests start]): one executable of many QtTest sources, each of which ends with
# a macro of tests/test_main.h and is a test of its own for CTest, named as its source is, after the
# prefix. Tests run offscreen, those named ON_DISPLAY under Xvfb. Nothing without Qt: the headless
# build has no QtTest.
function(episcope_add_tests suite)
  cmake_parse_arguments(ARG "" "PREFIX" "TESTS;SUPPORT;LINK;ON_DISPLAY;PROGRAMS" ${ARGN})
  if(NOT TARGET Qt6::Test)
    return()
  endif()
  set(declarations "")
  set(rows "")
  set(names)
  foreach(source ${ARG_TESTS})
    get_filename_component(name "${source}" NAME_WE)
    string(APPEND declarations "int ${name}(int argc, char** argv);\n")
    string(APPEND rows "    {\"${name}\", ${name}},\n")
    list(APPEND names ${name})
  endforeach()
  set(main "${CMAKE_CURRENT_BINARY_DIR}/${suite}_main.cpp")
  configure_file("${CMAKE_SOURCE_DIR}/resources/cmake/test_main.cpp.in" "${main}" @ONLY)
  add_executable(${suite} ${ARG_TESTS} ${ARG_SUPPORT} "${main}")
  set_target_properties(${suite} PROPERTIES AUTOMOC ON UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  target_link_libraries(${suite} PRIVATE episcope_options Qt6::Test ${ARG_LINK})
  target_compile_options(${suite} PRIVATE -O1)  # half the time that Release takes to compile them
  set(inputs $<TARGET_FILE:${suite}> ${ARG_PROGRAMS})
  foreach(name ${names})
    set(test ${ARG_PREFIX}${name})
    if(name IN_LIST ARG_ON_DISPLAY)
      episcope_add_test(${test} INPUTS ${inputs}
                        COMMAND xvfb-run -a -s "-screen 0 1280x800x24" $<TARGET_FILE:${suite}> ${name})
      # The display's own libraries (D-Bus, the software renderer) leak a kilobyte when they unload.
      episcope_set_test_properties(${test} "ASAN_OPTIONS=detect_leaks=0")
    else()
      episcope_add_test(${test} INPUTS ${inputs} COMMAND $<TARGET_FILE:${suite}> ${name})
      episcope_set_test_properties(${test} "QT_QPA_PLATFORM=offscreen")
    endif()
    if("${ARG_LINK}" MATCHES "episcope_(window|widgets)")
      set_tests_properties(${test} PROPERTIES LABELS window)
    endif()
  endforeach()
endfunction()

# episcope_set_test_properties(test environment…): time limits of CTest and of QtTest, which has one
# of its own for each function.
function(episcope_set_test_properties test)
  set_tests_properties(${test} PROPERTIES TIMEOUT ${EPISCOPE_TEST_TIMEOUT}
                       ENVIRONMENT "${ARGN};QTEST_FUNCTION_TIMEOUT=${EPISCOPE_TEST_TIMEOUT}000")
endfunction()
