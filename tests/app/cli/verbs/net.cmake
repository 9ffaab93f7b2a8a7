# The learned method: its weights are named, others can be given, and what holds none is refused.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
run_cli(synthesize edge -o lf.h5 --views 3x3 --size 40x48 -q)

expect("its weights" 0 OUT "^net .*; all views; CPU, GPU\n  weights: version 8 of 2026-[0-9-]+, SHA-256 [0-9a-f]+, /.*net.npz\n.*--weights"
       ARGS methods net)
run_cli(methods net --json)
json_is("${out}" 8 methods 0 weights version)
string(JSON weights GET "${out}" methods 0 weights file)
expect("two methods" 0 OUT "^epi_l .*\nnet " ARGS methods epi_l net)
expect("no such method" 2 ERR "no method 'nett'.*'net'" ARGS methods nett)

expect("of all views" 0 OUT "net of all views" ARGS estimate net lf.h5 -o all.h5 -q)
expect("of one view" 0 OUT "net of view 0,2" ARGS estimate net lf.h5 -o one.h5 --views center --view 0,2 -q)
expect("mean" 0 OUT "net of the center view" ARGS estimate net lf.h5 -o mean.h5 --views center --silhouettes mean
       --rounds 1 --range -1,1.5 -q)

# Another disparity beside silhouettes is in the file of one view, however it was made.
run_cli(info one.h5 --json)
json_is("${out}" ON second)
run_cli(info all.h5 --json)
json_is("${out}" OFF second)
expect("second" 0 ARGS show one.h5 -o second.png --what second --view 0,2)
expect("no second" 1 ERR "the result of net has no second disparity" ARGS show all.h5 -o no.png --what second)
run_cli(estimate net lf.h5 -o blocks.h5 --views center --view 0,2 --memory 2G -q)
execute_process(COMMAND "${SAME_RESULTS}" one.h5 blocks.h5 3 3 WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE code
                OUTPUT_VARIABLE differences ERROR_VARIABLE err)
if(NOT code EQUAL 0)
  fail_case("in blocks: ${differences}${err}")
endif()

# The same weights from a file that is named, from anywhere.
file(COPY_FILE "${weights}" "${WORK}/mine.npz")
expect("own weights" 0 ERR "weights of mine.npz, hash [0-9a-f]+" ARGS estimate net lf.h5 -o mine.h5
       --weights mine.npz)

file(WRITE "${WORK}/text.npz" "No weights.\n")
execute_process(COMMAND head -c 100000 mine.npz WORKING_DIRECTORY "${WORK}" OUTPUT_FILE "${WORK}/cut.npz")
expect("missing" 1 ERR "nowhere.npz: no file of weights" ARGS estimate net lf.h5 -o x.h5 --weights nowhere.npz)
expect("no archive" 1 ERR "text.npz: .*choose a file of weights" ARGS estimate net lf.h5 -o x.h5 --weights text.npz)
expect("truncated" 1 ERR "cut.npz: .*copy it again" ARGS estimate net lf.h5 -o x.h5 --weights cut.npz)
expect("another archive" 1 ERR "lf.h5: .*choose a file of weights" ARGS estimate net lf.h5 -o x.h5 --weights lf.h5)
if(EXISTS "${WORK}/x.h5")
  fail_case("a failed run left x.h5")
endif()
