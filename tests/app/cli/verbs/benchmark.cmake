# Benchmarks: tables and files, resuming after any end, submissions, what fails.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
find_program(sh sh REQUIRED)

foreach(scene edge slant)
  file(MAKE_DIRECTORY "${WORK}/${scene}")
  expect("make ${scene}" 0 ARGS synthesize ${scene} -o ${scene}/lf.h5 --views 3x3 --size 64x64)
endforeach()

# reused(number regex): what the last answer says of earlier runs.
macro(expect_reused number)
  if(NOT out MATCHES "index.html: ${number}")
    fail_case("expected '${number}' in the last line of\n${out}")
  endif()
endmacro()

expect("benchmark" 0 OUT "^Algorithms ranked.*\nepi_[ls] +1 .*\naverage +[0-9.]+ +[0-9.]+\nrank"
       ARGS benchmark edge slant --methods epi_l,epi_s -o out)
expect_reused("4 results, 0 points searched, 0 taken from before")
expect_files(out index.html log.jsonl results.csv results.json scenes tables.csv tables.tex)
expect_files(out/scenes edge slant)
expect_files(out/scenes/edge view.png truth.png epi_l.h5 epi_l-disparity.png epi_l-error.png
             epi_s.h5 epi_s-disparity.png epi_s-error.png)
expect_file(out/scenes/edge/epi_l-error.png ${png})
expect("the kept map" 0 OUT "mse_100" ARGS evaluate out/scenes/edge/epi_l.h5 --truth edge)
file(READ "${WORK}/out/index.html" page)
if(NOT page MATCHES "<html.*scenes/edge/epi_l-error.png.*prefers|prefers.*scenes/edge/epi_l-error.png")
  fail_case("the page lacks pictures")
endif()
foreach(name tables.csv tables.tex results.csv results.json)
  file(READ "${WORK}/out/${name}" text)
  if(NOT text MATCHES "epi_s|epi\\\\_s")
    fail_case("${name} lacks a method")
  endif()
endforeach()

expect("again" 0 ARGS benchmark edge slant --methods epi_l,epi_s -o out)
expect_reused("4 results, 0 points searched, 4 taken from before")
expect("as JSON" 0 ARGS benchmark edge slant --methods epi_l,epi_s -o out --json)
one_shape("${out}" 4 7)
json_is("${out}" edge scenes 0 name)
foreach(name index.html log.jsonl results.csv results.json scenes tables.csv tables.tex)
  if(NOT out MATCHES "\"out/${name}\"")
    fail_case("${name} is not among the files that were written:\n${out}")
  endif()
endforeach()
json_near("${out}" 0.0001 100 results 0 vmv2013 mse_100)
json_near("${out}" 0.0001 100 results 0 benchmark2016 badpix_0010)
json_near("${out}" 1 1 ranking entries 0 rank)
json_absent("${out}" search)
file(REMOVE "${WORK}/out/scenes/edge/epi_l.h5")
expect("after a loss" 0 ARGS benchmark edge slant --methods epi_l,epi_s -o out)
expect_reused("4 results, 0 points searched, 3 taken from before")
expect("make another edge" 0 ARGS synthesize edge -o edge/lf.h5 --views 3x3 --size 64x64 --noise 1
       --overwrite)
expect("changed samples" 0 ARGS benchmark edge slant --methods epi_l,epi_s -o out)
expect_reused("4 results, 0 points searched, 2 taken from before")
expect("all methods" 0 ARGS benchmark slant --methods all -o every)

# Submissions: by name, by folder, with a time; one lacks a scene, one is broken.
file(MAKE_DIRECTORY "${WORK}/theirs/disp_maps" "${WORK}/theirs/runtimes" "${WORK}/bad/edge")
expect("make a submission" 0 ARGS convert edge theirs/disp_maps/edge.pfm)
file(WRITE "${WORK}/theirs/runtimes/edge.txt" "12.5\n")
file(WRITE "${WORK}/bad/edge/any.pfm" "no map\n")
expect("a submission" 0 OUT "theirs +1 +0.000 +medium +12.50" ERR "^note: theirs on slant: [^\n]+\n$"
       ARGS benchmark edge slant --methods epi_l -o subs --submission theirs)
if(NOT out MATCHES "1 of 2 scenes, those with scores for every ranked entry. Left out because of missing scores: slant .theirs.")
  fail_case("the table does not tell the gap:\n${out}")
endif()
file(MAKE_DIRECTORY "${WORK}/arrays")
expect("an array" 0 ARGS estimate epi_l edge -o arrays/edge.npy)
expect("submissions alone" 0 OUT "Algorithms ranked.*theirs.*index.html: 2 results"
       ARGS benchmark edge -o alone --submission theirs --submission arrays)
if(out MATCHES "epi_l")
  fail_case("methods ran that were not asked for:\n${out}")
endif()
expect("a broken submission" 1 ERR "bad on edge: .*any.pfm.*. the tables of the others are in subs"
       ARGS benchmark edge --methods epi_l -o subs --submission theirs --submission bad)
configure_file("${WORK}/edge/lf.h5" "${WORK}/light/edge.h5" COPYONLY)
expect("a light field is no submission" 1 ERR "light/edge.h5: holds a light field or true depth"
       ARGS benchmark edge --methods epi_l -o subs --submission light)
expect("a broken submission again" 1 ERR "any.pfm"
       ARGS benchmark edge --methods epi_l -o subs --submission theirs --submission bad)
file(READ "${WORK}/subs/index.html" page)
if(NOT page MATCHES "Failures.*any.pfm")
  fail_case("the page does not tell the failure")
endif()

# Labels: ways to label instead of methods, resumed likewise; a scene without strokes is a failure.
file(MAKE_DIRECTORY "${WORK}/painted")
expect("make a scene with strokes" 0 ARGS synthesize objects -o painted/lf.h5 --views 3x3 --size 64x64)
set(ways benchmark painted --labels --features image,image+truth --regularizers none,wsg13)
expect("labels" 0 OUT "^Labels ranked.*\npainted: intersection over union of each label"
       ARGS ${ways} -o ways)
expect_reused("4 results, 0 points searched, 0 taken from before")
expect_files(ways index.html log.jsonl results.csv results.json scenes tables.csv tables.tex)
expect_file(ways/scenes/painted/image+truth-wsg13-wrong.png ${png})
expect_file(ways/scenes/painted/labels.png ${png})
file(READ "${WORK}/ways/index.html" page)
if(NOT page MATCHES "Label benchmark.*image%2Btruth-wsg13-wrong.png" OR page MATCHES "MSE")
  fail_case("the page of labels lacks pictures, or tells of disparities")
endif()
file(READ "${WORK}/ways/results.csv" text)
if(NOT text MATCHES "labels.iou_label_2.*\nimage-none,painted,")
  fail_case("results.csv lacks labels:\n${text}")
endif()
expect("labels again" 0 ARGS ${ways} -o ways --json)
json_near("${out}" 0.9 1 results 3 labels accuracy_all_views)
json_near("${out}" 0.9 1 results 3 labels boundary_accuracy)
json_near("${out}" 1 1 label_ranking entries 0 rank)
json_absent("${out}" ranking)
expect("a way more" 0 ARGS benchmark painted --labels --features image --regularizers none,view
       -o ways)
expect_reused("2 results, 0 points searched, 1 taken from before")
expect("labels and a method" 0 OUT "^Labels ranked.*Algorithms ranked"
       ARGS benchmark painted --labels --features image --regularizers none --methods epi_l -o both)
expect("no strokes" 1 ERR "edge has no strokes"
       ARGS benchmark edge --labels --features image --regularizers none -o strokeless)
expect("strokes of another scene" 1 ERR "edge has no strokes"
       ARGS benchmark edge --labels --features image --regularizers none --scribbles painted
       -o strokeless)
file(MAKE_DIRECTORY "${WORK}/strokes")
file(COPY_FILE "${WORK}/painted/labels.h5" "${WORK}/strokes/edge.h5")
set(unpainted benchmark edge --labels --features image --regularizers none)
expect("strokes kept elsewhere" 0 OUT "^Labels ranked" ARGS ${unpainted} --scribbles strokes -o stroked)
expect("no folder of strokes" 1 ERR "nowhere.*is not a folder"
       ARGS ${unpainted} --scribbles nowhere -o stroked)
expect("strokes without labels" 2 ERR "without --labeling"
       ARGS benchmark edge --scribbles strokes --methods epi_l -o o)
expect("features without labels" 2 ERR "without --labeling"
       ARGS benchmark painted --features image --methods epi_l -o o)
file(MAKE_DIRECTORY "${WORK}/painters")
expect("a map of it" 0 ARGS convert painted painters/painted.pfm)
expect("labels and a submission" 0 OUT "^Labels ranked.*Algorithms ranked.*painters"
       ARGS benchmark painted --labels --features image --regularizers none -o ways_and_theirs
       --submission painters)
expect("no such regulariser" 2 ERR "wsg12.*wsg13"
       ARGS benchmark painted --labels --regularizers wsg12 -o o)

# A method that cannot use a scene, a scene that cannot be read, a scene without truth.
file(MAKE_DIRECTORY "${WORK}/flat" "${WORK}/plain")
expect("make a single view" 0 ARGS synthesize edge -o flat/lf.h5 --views 1x1 --size 48x48)
expect("a method that fails" 1 ERR "epi_l on flat: .*the tables of the others are in flat_out"
       ARGS benchmark flat edge --methods epi_l -o flat_out)
file(READ "${WORK}/flat_out/tables.csv" text)
if(NOT text MATCHES "\nedge,[0-9.]+\n")
  fail_case("the other scene was not run:\n${text}")
endif()
file(STRINGS "${WORK}/flat_out/log.jsonl" failures REGEX "\"failed\":true")
list(LENGTH failures count)
if(NOT count EQUAL 1)
  fail_case("the log lacks the failure")
endif()
file(WRITE "${WORK}/plain/lf.h5" "no HDF5")
expect("a scene that fails" 1 ERR "plain/lf.h5: [^\n]*tables of the others"
       ARGS benchmark plain edge --methods epi_l -o flat_out)
expect("make a light field without truth" 0 ERR "^note: The benchmark form" ARGS convert edge dark/)
file(GLOB truth "${WORK}/dark/gt_*")
file(REMOVE ${truth})
expect("a scene without truth" 0 ERR "^note: epi_l on dark: dark has no true disparity[^\n]*\n$"
       OUT "fast +[0-9.]+ +yes" ARGS benchmark dark --methods epi_l -o dark_out --search)
expect_files(dark_out/scenes/dark view.png epi_l.h5 epi_l-disparity.png)

expect("no such method" 2 ERR "no method 'epi_x'.*epi_" ARGS benchmark edge --methods epi_x -o o)
expect("no such scene" 1 ERR "nowhere: " ARGS benchmark edge nowhere --methods epi_l -o o)
expect("no such built-in scene" 2 ERR "did you mean 'edge'"
       ARGS benchmark demo:edg --methods epi_l -o o)
expect("no such submission" 1 ERR "none: is not a folder"
       ARGS benchmark edge --methods epi_l -o o --submission none)
expect("a folder of other things" 1 ERR "theirs: contains something other"
       ARGS benchmark edge --methods epi_l -o theirs)
expect("no output" 2 ARGS benchmark edge --methods epi_l)
if(EXISTS "${WORK}/o")
  fail_case("a refused benchmark left a folder")
endif()

# search_until(folder lines signal): searches until the log has so many lines, then sends the signal;
# sets out to the exit code.
macro(search_until folder lines signal)
  set(script "'${CLI}' benchmark edge slant --methods epi_s -o ${folder} --search -q --threads 1 & cli=$!
    until [ \"$(cat ${folder}/log.jsonl 2>/dev/null | wc -l)\" -ge ${lines} ]; do
      kill -0 $cli 2>/dev/null || break; sleep 0.005; done
    kill -${signal} $cli; wait $cli; echo $?")
  execute_process(COMMAND "${sh}" -c "${script}" WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE out
                  ERROR_VARIABLE err TIMEOUT 60)
endmacro()
set(search benchmark edge slant --methods epi_s --search -q --threads 1 -o)

# Killed in the middle of a search, again and again, it comes to the end without doing anything
# twice, and the tables are those of a search in one go.
foreach(wanted 2 9 30)
  search_until(killed ${wanted} KILL)
  if(NOT out STREQUAL "137\n")
    fail_case("the search was not killed after ${wanted} points: ${out} ${err}")
  endif()
  # As a machine that stops in the middle of writing leaves it.
  file(APPEND "${WORK}/killed/log.jsonl" "{\"key\":\"4f")
endforeach()
file(STRINGS "${WORK}/killed/log.jsonl" lines)
list(LENGTH lines before)
math(EXPR before "${before} - 1")
expect("go on" 0 ARGS ${search} killed)
string(REGEX MATCH "([0-9]+) points searched, ([0-9]+) taken" ignored "${out}")
set(points ${CMAKE_MATCH_1})
if(NOT CMAKE_MATCH_2 EQUAL before)
  fail_case("${before} runs were finished, but ${CMAKE_MATCH_2} taken from before")
endif()
file(READ "${WORK}/killed/log.jsonl" log)
string(REGEX MATCHALL "\"key\":\"[0-9a-f]+\"" keys "${log}")
list(LENGTH keys all)
list(REMOVE_DUPLICATES keys)
list(LENGTH keys distinct)
math(EXPR expected "${points} + 2")  # and a run for the tables on each scene
if(NOT all EQUAL expected OR NOT distinct EQUAL expected OR log MATCHES "4f{|4f\n")
  fail_case("${expected} runs, but the log has ${all} lines with ${distinct} keys")
endif()
expect("in one go" 0 ARGS ${search} whole)
foreach(run killed whole)
  file(READ "${WORK}/${run}/tables.csv" ${run}_tables)
  # Seconds differ from run to run.
  string(REGEX REPLACE "(fast|medium|slow),[0-9.]+" "" ${run}_tables "${${run}_tables}")
endforeach()
if(NOT killed_tables STREQUAL whole_tables)
  fail_case("the tables differ:\n${killed_tables}\n${whole_tables}")
endif()
file(GLOB_RECURSE hidden "${WORK}/whole/.*.part")
if(hidden)
  fail_case("half-written files: ${hidden}")
endif()

# Ctrl+C: exit code 130, and the next call goes on.
search_until(stopped 5 TERM)
if(NOT out STREQUAL "130\n" OR NOT err STREQUAL "episcope-cli: cancelled\n")
  fail_case("interrupted: ${out} ${err}")
endif()
expect("go on after Ctrl+C" 0 OUT "points searched, [1-9][0-9]* taken" ARGS ${search} stopped)
