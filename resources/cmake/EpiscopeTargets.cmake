# Helpers that add the project's targets: one way to warn, to sanitise, to check headers.

find_program(EPISCOPE_CCACHE ccache)
if(EPISCOPE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${EPISCOPE_CCACHE}")
endif()

# What every target of ours is compiled with.
add_library(episcope_options INTERFACE)
target_compile_options(episcope_options INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
target_include_directories(episcope_options INTERFACE "${CMAKE_SOURCE_DIR}")
# Seconds after which a test counts as hung; sanitizers slow them down by ten and more.
set(EPISCOPE_TEST_TIMEOUT 300)
if(EPISCOPE_SANITIZE)
  set(EPISCOPE_TEST_TIMEOUT 1800)
  target_compile_options(episcope_options INTERFACE "-fsanitize=${EPISCOPE_SANITIZE}"
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(episcope_options INTERFACE "-fsanitize=${EPISCOPE_SANITIZE}")
endif()

# episcope_add_library(name SOURCES a.cpp … HEADERS a.h … [LINK public targets] [PRIVATE_LINK …])
# Headers are public: each is also compiled alone.
function(episcope_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES} ${ARG_HEADERS})
  target_link_libraries(${name} PUBLIC episcope_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  if(EPISCOPE_TESTS)
    episcope_check_headers(${name} ${ARG_HEADERS})
  endif()
endfunction()

# Compiles every header in a unit of its own, so that each includes what it needs.
function(episcope_check_headers name)
  set(units)
  foreach(header ${ARGN})
    file(RELATIVE_PATH path "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${header}")
    string(MAKE_C_IDENTIFIER "${path}" id)
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/headers/${id}.cpp")
    file(GENERATE OUTPUT "${unit}" CONTENT "#include \"${path}\"\n")
    list(APPEND units "${unit}")
  endforeach()
  if(units)
    add_library(${name}_headers OBJECT ${units})
    set_target_properties(${name}_headers PROPERTIES AUTOMOC OFF)
    target_link_libraries(${name}_headers PRIVATE ${name})
    # Not -fsyntax-only: without object files they would be compiled anew in every build.
    target_compile_options(${name}_headers PRIVATE -O0 -g0)
  endif()
endfunction()

# episcope_add_kernels(target a_kernel.cpp …): compiles each source once for every instruction set,
# with EPISCOPE_KERNEL_NAMESPACE and EPISCOPE_VECTOR_BYTES defined. See engine/core/isa.h.
function(episcope_add_kernels target)
  set(flags_baseline "")
  set(bytes_baseline 16)
  set(isas baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(isas baseline avx2 avx512)
    set(flags_avx2 -mavx2 -mfma)
    set(bytes_avx2 32)
    set(flags_avx512 -mavx512f -mavx512vl -mavx512bw -mavx512dq -mfma -mprefer-vector-width=512)
    set(bytes_avx512 64)
  else()
    target_compile_definitions(${target} PRIVATE EPISCOPE_BASELINE_ONLY)
  endif()
  foreach(isa ${isas})
    set(objects ${target}_kernels_${isa})
    add_library(${objects} OBJECT ${ARGN})
    target_link_libraries(${objects} PRIVATE episcope_options)
    target_compile_options(${objects} PRIVATE -O3 -fno-math-errno -fno-trapping-math
                           -fno-signed-zeros -ffp-contract=fast -Wno-psabi ${flags_${isa}})
    target_compile_definitions(${objects} PRIVATE EPISCOPE_KERNEL_NAMESPACE=${isa}
                               EPISCOPE_VECTOR_BYTES=${bytes_${isa}})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()

# episcope_add_test(name SOURCES a_test.cpp LINK targets… [DISPLAY]): one QtTest executable. Runs
# offscreen, or under Xvfb with DISPLAY.
function(episcope_add_test name)
  cmake_parse_arguments(ARG "DISPLAY" "TIMEOUT" "SOURCES;LINK" ${ARGN})
  if(NOT TARGET Qt6::Test)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES AUTOMOC ON)
  target_link_libraries(${name} PRIVATE episcope_options Qt6::Test ${ARG_LINK})
  if(ARG_DISPLAY)
    add_test(NAME ${name} COMMAND xvfb-run -a -s "-screen 0 1280x800x24" $<TARGET_FILE:${name}>)
    # The display's own libraries (D-Bus, the software renderer) leak a kilobyte when they unload.
    set(environment "ASAN_OPTIONS=detect_leaks=0")
  else()
    add_test(NAME ${name} COMMAND ${name})
    set(environment "QT_QPA_PLATFORM=offscreen")
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT ${EPISCOPE_TEST_TIMEOUT})
  endif()
  # QtTest has a limit of its own, five minutes for each function.
  list(APPEND environment "QTEST_FUNCTION_TIMEOUT=${ARG_TIMEOUT}000")
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${environment}")
  if("${ARG_LINK}" MATCHES "episcope_(window|widgets)")
    set_tests_properties(${name} PROPERTIES LABELS window)
  endif()
endfunction()
