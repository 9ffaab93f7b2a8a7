# A benchmark in tasks: the plan, its points in any order, after a kill, failures, tables and status.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
find_program(sh sh REQUIRED)

foreach(scene edge slant)
  file(MAKE_DIRECTORY "${WORK}/${scene}")
  expect("make ${scene}" 0 ARGS synthesize ${scene} -o ${scene}/lf.h5 --views 3x3 --size 64x64)
endforeach()

# expect_same(regex name a b): a file of two benchmarks, without the times, which match the regex.
function(expect_same regex name a b)
  foreach(folder a b)
    file(READ "${WORK}/${${folder}}/${name}" text)
    string(REGEX REPLACE "${regex}" "" ${folder}_text "${text}")
  endforeach()
  if(NOT a_text STREQUAL b_text)
    fail_case("${name} of ${a} and ${b} differ")
  endif()
endfunction()
function(expect_same_tables a b)
  expect_same("(fast|medium|slow)(,| & )[0-9.]+" tables.csv ${a} ${b})
  expect_same("(fast|medium|slow)(,| & )[0-9.]+" tables.tex ${a} ${b})
  expect_same_results(${a} ${b})
endfunction()
function(expect_same_results a b)
  expect_same("\"(seconds|runtime_log)\": [-0-9.e]+" results.json ${a} ${b})
endfunction()
# expect_status(folder all done failed missing): numbers of tasks.
function(expect_status folder all done failed missing)
  expect("status of ${folder}" 0 ARGS benchmark -o ${folder} --status --json)
  one_shape("${out}" 1 0)
  foreach(key all done failed missing)
    json_is("${out}" ${${key}} tasks ${key})
  endforeach()
endfunction()
# expect_no_run_twice(folder): no key stands twice in the logs of the tasks.
function(expect_no_run_twice folder)
  file(GLOB logs "${WORK}/${folder}/tasks/*.jsonl")
  set(all "")
  foreach(log ${logs})
    file(READ "${log}" text)
    string(REGEX MATCHALL "\"key\":\"[0-9a-f]+\"" keys "${text}")
    list(APPEND all ${keys})
  endforeach()
  list(LENGTH all count)
  list(REMOVE_DUPLICATES all)
  list(LENGTH all distinct)
  if(NOT count EQUAL distinct)
    fail_case("${folder}: ${count} runs, but ${distinct} different ones")
  endif()
endfunction()

# Tasks in any order make the tables of a benchmark in one go.
set(what edge slant --methods epi_s,st_ch_l --search)
expect("in one go" 0 ARGS benchmark ${what} -o one)
expect("nothing is planned" 1 ERR "there is no plan of a benchmark; make one with --plan"
       ARGS benchmark -o one --point 0)
expect("plan" 0 OUT "^many/plan.json: [0-9]+ tasks with 148 runs"
       ARGS benchmark ${what} -o many --plan plan.json --task-seconds 0.3)
expect_files(many log.jsonl plan.json tasks)
file(READ "${WORK}/plan.json" plan)
string(JSON count LENGTH "${plan}" tasks)
if(count LESS 4)
  fail_case("only ${count} tasks; the test needs several")
endif()
math(EXPR last "${count} - 1")
json_is("${plan}" edge scenes 0 name)
json_is("${plan}" st_ch_l runs 1 method)
expect("plan again" 0 ARGS benchmark ${what} -o many --plan again.json --task-seconds 0.3 --json)
json_is("${out}" ${count} tasks)
one_shape("${out}" 1 2)
json_is("${out}" 148 points)
foreach(name again.json many/plan.json)
  file(READ "${WORK}/${name}" text)
  string(JSON tasks GET "${text}" tasks)
  string(JSON expected GET "${plan}" tasks)
  if(NOT tasks STREQUAL expected)
    fail_case("${name} has other tasks")
  endif()
endforeach()
expect_status(many ${count} 0 0 ${count})

# The tables can be made before all is done, and tell what is missing.
expect("last task" 0 OUT "\"points\": [1-9]" ARGS benchmark -o many --point ${last} --json)
expect("last task again" 0 OUT "\"computed\": 0" ARGS benchmark -o many --point ${last} --json)
expect("collect too early" 1 ERR "not computed yet.*and [0-9]+ more.; the tables of the others are"
       ARGS benchmark -o many --collect)
file(READ "${WORK}/many/index.html" page)
if(NOT page MATCHES "not computed yet")
  fail_case("the page does not tell what is missing")
endif()

# A task that is killed keeps what it finished; the same call goes on.
string(JSON points LENGTH "${plan}" tasks 0 points)
set(script "'${CLI}' benchmark -o many --point 0 -q --threads 1 & cli=$!
  until [ -s many/tasks/0.jsonl ]; do kill -0 $cli 2>/dev/null || break; sleep 0.005; done
  kill -KILL $cli; wait $cli; echo $?")
execute_process(COMMAND "${sh}" -c "${script}" WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE out
                ERROR_VARIABLE err TIMEOUT 60)
file(STRINGS "${WORK}/many/tasks/0.jsonl" lines)
list(LENGTH lines finished)
expect("a killed task" 0 ARGS benchmark -o many --point 0 --json)
math(EXPR left "${points} - ${finished}")
json_is("${out}" ${left} computed)

# With what the plan was made of, from another folder, and the others backwards.
expect("with INPUT" 0 ARGS benchmark ${what} -o many --point 1)
file(MAKE_DIRECTORY "${WORK}/elsewhere")
execute_process(COMMAND "${CLI}" benchmark -o ../many --point 2 -q RESULT_VARIABLE code
                WORKING_DIRECTORY "${WORK}/elsewhere" OUTPUT_QUIET ERROR_VARIABLE err)
if(NOT code EQUAL 0)
  fail_case("from another folder: ${err}")
endif()
foreach(task RANGE ${last} 0 -1)
  expect("task ${task}" 0 ARGS benchmark -o many --point ${task})
endforeach()
expect_status(many ${count} ${count} 0 0)
expect_no_run_twice(many)
expect("collect" 0 OUT "144 points searched, 148 taken" ARGS benchmark -o many --collect)
expect_same_tables(one many)
expect_files(many/scenes/edge view.png truth.png epi_s.h5 epi_s-disparity.png epi_s-error.png
             st_ch_l.h5 st_ch_l-disparity.png st_ch_l-error.png)
expect("collect again" 0 ARGS benchmark ${what} -o many --collect --json)
json_near("${out}" 0 100 search 0 scenes 0 p_fix mse_100)

# What was collected counts in a benchmark in one go, and in another plan, of which little is left.
expect("in one go after it" 0 OUT "148 taken" ARGS benchmark ${what} -o many)
expect("another plan" 0 ARGS benchmark ${what} -o many --plan plan.json --task-seconds 1000)
expect_status(many 1 1 0 0)
expect("a method more" 0 ARGS benchmark edge slant --methods epi_s,st_ch_l,epi_l -o many
       --plan plan.json --task-seconds 0)
expect_status(many 6 4 0 2)

# Labels, submissions and reading options go with the plan.
file(MAKE_DIRECTORY "${WORK}/painted" "${WORK}/theirs")
expect("make a scene with strokes" 0 ARGS synthesize objects -o painted/lf.h5 --views 3x3 --size 64x64)
expect("a map of it" 0 ARGS convert painted theirs/painted.pfm)
set(ways painted --labels --features image --methods epi_l --profile paper --submission theirs)
expect("ways in one go" 0 ARGS benchmark ${ways} -o ways_one)
expect("plan of ways" 0 ARGS benchmark ${ways} -o ways --plan ways.json --task-seconds 0)
foreach(task RANGE 4)
  expect("way ${task}" 0 ARGS benchmark -o ways --point ${task})
endforeach()
expect("ways collected" 0 OUT "6 results, 0 points searched, 5 taken" ARGS benchmark -o ways --collect)
expect_same_results(ways_one ways)

# What fails is told by the task, by the status and in the tables; it is tried again.
file(MAKE_DIRECTORY "${WORK}/flat" "${WORK}/plain")
expect("make a single view" 0 ARGS synthesize edge -o flat/lf.h5 --views 1x1 --size 48x48)
file(WRITE "${WORK}/plain/lf.h5" "no HDF5")
expect("plan of failures" 0 ARGS benchmark flat plain edge --methods epi_l -o failing --plan f.json
       --task-seconds 0 --json)
json_is("${out}" 2 tasks)
foreach(attempt first second)
  foreach(task 0 1)
    run_cli(benchmark -o failing --point ${task})
    if(exit_code EQUAL 1 AND NOT err MATCHES "1 of 1 runs of task ${task} failed, the first: epi_l on flat: ")
      fail_case("a failing task: ${err}")
    endif()
    list(APPEND codes ${exit_code})
  endforeach()
endforeach()
list(SORT codes)
if(NOT codes STREQUAL "0;0;1;1")
  fail_case("tasks ended with ${codes}, expected one that fails each time")
endif()
expect_status(failing 2 1 1 0)
expect("status for people" 0 OUT "1 done, 1 failed, 0 missing of 2\n.*\nfailed: epi_l on flat: "
       ARGS benchmark -o failing --status)
expect("collect failures" 1 ERR "plain/lf.h5: .*and 1 more.; the tables of the others are in failing"
       ARGS benchmark -o failing --collect)
file(READ "${WORK}/failing/index.html" page)
if(NOT page MATCHES "Failures.*plain/lf.h5.*epi_l on flat")
  fail_case("the page does not tell the failures")
endif()

# A scene that changed since then is refused by tasks and by the tables.
expect("plan before a change" 0 ARGS benchmark edge --methods epi_l,epi_s -o changed --plan c.json
       --task-seconds 0)
expect("before the change" 0 ARGS benchmark -o changed --point 0)
expect("change edge" 0 ARGS synthesize edge -o edge/lf.h5 --views 3x3 --size 64x64 --noise 1
       --overwrite)
expect("a changed scene" 1 ERR "edge: the scene has changed since the plan was made; make the plan again"
       ARGS benchmark -o changed --point 1)
expect("tables of a changed scene" 1 ERR "edge: the scene has changed" ARGS benchmark -o changed --collect)
expect("other methods" 1 ERR "made for other inputs or settings"
       ARGS benchmark edge --methods epi_l -o changed --point 1)
expect("plan after the change" 0 ARGS benchmark edge --methods epi_l,epi_s -o changed --plan c.json
       --task-seconds 0)
expect_status(changed 2 0 0 2)

# Slurm, without a cluster: sbatch is a script that writes down its words.
file(WRITE "${WORK}/bin/sbatch" "#!/bin/sh\nprintf '%s\\n' \"$@\" >>'${WORK}/words'\necho '7;cluster'\n")
file(CHMOD "${WORK}/bin/sbatch" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
set(path "$ENV{PATH}")
set(ENV{PATH} "${WORK}/bin:${path}")
expect("submit" 0 OUT "^2 of 2 tasks submitted as job 7; job 7 then makes the tables"
       ARGS benchmark edge --methods epi_l,epi_s -o changed --task-seconds 0
       --slurm "--partition=gpu --time=1:00:00 --comment='two words'")
file(READ "${WORK}/words" words)
foreach(word "--array=0-1\n" "\n--partition=gpu\n--time=1:00:00\n--comment=two words\n"
        "--point .*SLURM_ARRAY_TASK_ID" "--dependency=afterany:7\n" "${WORK}/changed .*--collect\n")
  if(NOT words MATCHES "${word}")
    fail_case("sbatch was not told '${word}':\n${words}")
  endif()
endforeach()
expect("task 1 of two" 0 ARGS benchmark -o changed --point 1)
file(REMOVE "${WORK}/words")
expect("submit the rest" 0 OUT "\"submitted\": 1" ARGS benchmark edge --methods epi_l,epi_s -o changed
       --task-seconds 0 --slurm --partition=gpu --json)
file(READ "${WORK}/words" words)
if(NOT words MATCHES "--array=0\n")
  fail_case("finished tasks were submitted again:\n${words}")
endif()
expect("task 0 of two" 0 ARGS benchmark -o changed --point 0)
expect("submit nothing" 0 OUT "^nothing to submit: 2 of 2 tasks are finished"
       ARGS benchmark edge --methods epi_l,epi_s -o changed --task-seconds 0 --slurm --partition=gpu)
file(WRITE "${WORK}/bin/sbatch" "#!/bin/sh\necho 'invalid partition specified: gpu' >&2\nexit 1\n")
expect("a refused job" 1 ERR "sbatch refused the job .exit code 1.: invalid partition specified: gpu"
       ARGS benchmark slant --methods epi_l -o refused --slurm --partition=gpu)
set(ENV{PATH} "${path}")

# Bad input.
expect("no such task" 1 ERR "has 2 tasks, from 0 on, but no task 2" ARGS benchmark -o changed --point 2)
expect("no number" 2 ERR "--point" ARGS benchmark -o changed --point x)
expect("two ways at once" 2 ERR "exclude each other" ARGS benchmark -o changed --point 0 --collect)
expect("neither INPUT nor plan" 2 ERR "INPUT is required" ARGS benchmark -o changed)
expect("methods of a plan" 2 ERR "the plan says what to run"
       ARGS benchmark -o changed --methods epi_l --collect)
expect("bundles of nothing" 2 ERR "--task-seconds has no effect"
       ARGS benchmark edge -o changed --task-seconds 3)
expect("an open quote" 1 ERR "is not closed in: --comment='a"
       ARGS benchmark edge -o changed --slurm "--comment='a")
file(WRITE "${WORK}/thesis.tex" "years of work")
expect("a plan over a thesis" 1 ERR "thesis.tex: exists and is no plan"
       ARGS benchmark edge --methods epi_l -o changed --plan thesis.tex)
file(WRITE "${WORK}/changed/plan.json" "{")
expect("a broken plan" 1 ERR "plan.json: is no plan of a benchmark" ARGS benchmark -o changed --status)
