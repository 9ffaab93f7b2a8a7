# --memory: maps are made block by block and equal those of the run at once, also where the program was
# killed; what cannot be cut goes to disk.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
find_program(sh sh REQUIRED)

run_cli(synthesize edge -o lf.h5 --views 5x6 --size 210x190 -q)
if(NOT exit_code EQUAL 0)
  message(FATAL_ERROR "synthesize: ${err}")
endif()

function(expect_same name a b)
  execute_process(COMMAND "${SAME_RESULTS}" ${a} ${b} 5 6 WORKING_DIRECTORY "${WORK}"
                  RESULT_VARIABLE code OUTPUT_VARIABLE differences ERROR_VARIABLE err)
  if(NOT code EQUAL 0)
    fail_case("${name}: ${differences}${err}")
  endif()
endfunction()

file(MAKE_DIRECTORY "${WORK}/made" "${WORK}/once" "${WORK}/killed")
foreach(method epi_l epi_s plane_pm)
  expect("${method} at once" 0 ERR "" ARGS estimate ${method} lf.h5 -o once/${method}.h5 -q)
  expect("${method} in blocks" 0 OUT "${method} of " ARGS estimate ${method} lf.h5
         -o made/${method}.h5 --memory 40M -q)
  expect_same("${method} in blocks" once/${method}.h5 made/${method}.h5)
endforeach()
expect_files(made epi_l.h5 epi_s.h5 plane_pm.h5)

# Views of different brightness are evened out also where they stay in their file.
run_cli(synthesize random?seed=9 -o uneven.h5 --views 5x6 --size 210x190 -q)
foreach(method st_av_s st_ch_l)
  expect("${method} of uneven views" 0 ERR "evened out" ARGS estimate ${method} uneven.h5 -o once/uneven_${method}.h5)
  expect("${method} of uneven views on disk" 0 ERR "evened out" ARGS estimate ${method} uneven.h5
         -o made/uneven_${method}.h5 --memory 20M)
  expect_same("${method} of uneven views on disk" once/uneven_${method}.h5 made/uneven_${method}.h5)
endforeach()

# Methods that are not cut: what does not fit goes to disk.
foreach(method epi_g epi_c epi_two_layer st_av_l st_ch_s)
  expect("${method} at once" 0 ARGS estimate ${method} lf.h5 -o once/${method}.h5 -q)
  expect("${method} on disk" 0 ERR "${method} runs at once: what does not fit is put on disk" ARGS
         estimate ${method} lf.h5 -o made/${method}.h5 --memory 3M)
  expect_same("${method} on disk" once/${method}.h5 made/${method}.h5)
endforeach()

# Nothing is left of a run that was refused.
file(MAKE_DIRECTORY "${WORK}/refused")
expect("too little memory" 1 ERR "needs [0-9]+ MB of memory at least" ARGS estimate epi_s lf.h5
       -o refused/none.h5 --memory 1M)
expect_files(refused)
expect("no size" 2 ERR "--memory is 'lots'.*4G, 800M" ARGS estimate epi_l lf.h5 -o none.h5
       --memory lots)
expect("nothing" 2 ERR "--memory" ARGS estimate epi_l lf.h5 -o none.h5 --memory 0)

# expect_continued(method scene expected memory steps…): killed after so many steps were noted, then continued. A
# machine that is done before it is killed has nothing to continue: the scene is one that takes much longer than a
# step.
function(expect_continued method scene expected memory)
  set(continued 0)
  foreach(steps ${ARGN})
    set(run "'${CLI}' estimate ${method} ${scene} -o killed/r.h5 --memory ${memory} --threads 1")
    set(script "${run} -q & cli=$!
      until [ $(wc -l < killed/r.h5.partial.log 2>/dev/null || echo 0) -ge ${steps} ]; do
        kill -0 $cli 2>/dev/null || break; sleep 0.01; done
      kill -9 $cli; wait $cli 2>/dev/null; [ -e killed/r.h5 ] || ${run} --json")
    execute_process(COMMAND "${sh}" -c "${script}" WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE out
                    ERROR_VARIABLE err RESULT_VARIABLE code TIMEOUT 240)
    if(NOT code EQUAL 0)
      fail_case("${method} continued after ${steps} steps: ${code} ${out} ${err}")
    endif()
    if(err MATCHES "r.h5.partial was continued")
      math(EXPR continued "${continued} + 1")
    endif()
    expect_same("${method} continued after ${steps} steps" ${expected} killed/r.h5)
    expect_files(killed r.h5)
    file(REMOVE "${WORK}/killed/r.h5")
  endforeach()
  if(continued EQUAL 0)
    fail_case("no run of ${method} was killed before it was done")
  endif()
endfunction()
run_cli(synthesize edge -o large.h5 --views 5x6 --size 420x410 -q)
expect("at once" 0 ARGS estimate epi_s large.h5 -o once/large.h5 -q)
expect_continued(epi_s large.h5 once/large.h5 64M 3 6 12)
# While views are estimated, while they are carried, while sides are chosen.
run_cli(synthesize edge -o small.h5 --views 5x6 --size 96x90 -q)
expect("at once" 0 ARGS estimate plane_pm small.h5 -o once/small.h5 -q)
expect_continued(plane_pm small.h5 once/small.h5 3M 4 12 29)
# While corners are estimated, while they are carried.
expect("at once" 0 ARGS estimate net small.h5 -o once/small_net.h5 -q)
expect_continued(net small.h5 once/small_net.h5 20M 4 12)

# The samples stay in their file where they are large beside the memory.
expect("at once" 0 ARGS estimate epi_l large.h5 -o once/large_epi_l.h5 -q)
expect("mapped samples" 0 OUT "epi_l of all views" ARGS estimate epi_l large.h5 -o made/large_epi_l.h5
       --memory 44M --threads 1 -q)
expect_same("mapped samples" once/large_epi_l.h5 made/large_epi_l.h5)

# What another run left is replaced.
set(script "'${CLI}' estimate epi_s large.h5 -o killed/r.h5 --memory 64M --threads 1 -q & cli=$!
    until [ $(wc -l < killed/r.h5.partial.log 2>/dev/null || echo 0) -ge 3 ]; do
      kill -0 $cli 2>/dev/null || break; sleep 0.01; done
    kill -9 $cli")
execute_process(COMMAND "${sh}" -c "${script}" WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE out
                ERROR_VARIABLE err TIMEOUT 240)
expect("another run" 0 ERR "partial, which another run had left unfinished, was replaced" ARGS
       estimate epi_l large.h5 -o killed/r.h5 --memory 64M)
expect_files(killed r.h5)
