# From photographs of a gantry to a light field with truth: synthesize gantry, calibrate, rectify,
# pose, ground-truth; and what each says of wrong input.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

expect(synthesize 0 OUT "picks; see readme.txt"
       ARGS synthesize gantry -o rig --views 3x3 --size 320x240 --seed 4)
expect("synthesize into a full folder" 1 ERR "not empty" ARGS synthesize gantry -o rig)
expect("info of the gantry" 0 OUT "built-in gantry" ARGS info "demo:gantry?size=200x150&grid=3x3")
expect("a gantry of one photograph" 2 ERR "3 to 21 rows" ARGS info "demo:gantry?grid=1x1")
file(GLOB photographs RELATIVE "${WORK}" "${WORK}/rig/pattern/*.png")

expect(calibrate 0 ARGS calibrate ${photographs} --pattern 9x6 --square 25 -o camera.yml --json)
one_shape("${out}" 1 1)
json_near("${out}" 0 0.3 rms)
json_near("${out}" 448 458 focal_length_px 0)
json_is("${out}" ON photos 0 used)
json_is("${out}" OFF photos 12 used)
json_is("${out}" OFF photos 13 used)
# One odd photograph among many is left out, even if it comes first.
expect("an odd photograph" 0 ARGS show demo:fronto -o odd.png)
expect("calibrate with an odd one" 0 ARGS calibrate odd.png ${photographs} --pattern 9x6 --square 25
       -o again.yml --json)
json_is("${out}" OFF photos 0 used)
string(JSON problem GET "${out}" photos 0 problem)
if(NOT problem MATCHES "^[0-9]+×[0-9]+ px, but 14 of 15 have [0-9]+×[0-9]+$")
  fail_case("the odd photograph is not named: ${problem}")
endif()
json_is("${out}" ON photos 1 used)
json_near("${out}" 448 458 focal_length_px 0)
expect("calibrate again" 0 OUT "camera.yml: focal length"
       ARGS calibrate ${photographs} --pattern 9x6 --square 25 -o camera.yml -q)
expect("calibrate over another camera" 1 ERR "mesh.ply: exists and holds something else; .*--overwrite"
       ARGS calibrate ${photographs} --pattern 9x6 --square 30 --kind chessboard -o rig/mesh.ply -q)
expect("calibrate with too few" 1 ERR "at least 3 photographs"
       ARGS calibrate rig/pattern/01.png --pattern 9x6 -o other.yml)
expect("calibrate without a pattern" 2 ERR "--board" ARGS calibrate rig/pattern/01.png -o other.yml)
expect("calibrate over its input" 1 ERR "01.png"
       ARGS calibrate rig/pattern/01.png --pattern 9x6 -o rig/pattern/01.png)

expect(rectify 0 ARGS rectify rig/photographs --camera camera.yml --step 12 --picks rig/picks.csv
       --pairs pairs.csv -o raw.h5 --json --quiet)
one_shape("${out}" 1 2)
json_near("${out}" 0 0.1 vertical_disparity_after_px percentile_95)
json_near("${out}" 0.1 9 vertical_disparity_before_px percentile_95)
expect("rectify without a camera" 1 ERR "camera_matrix"
       ARGS rectify rig/photographs --camera rig/picks.csv -o other.h5 --quiet)

expect(pose 0 ARGS pose raw.h5 --mesh rig/mesh.ply --pairs pairs.csv -o pose.json --json --quiet)
one_shape("${out}" 1 1)
json_near("${out}" 0 1.2 reprojection_error_px)
json_is("${out}" p1 pairs 0 name)
json_is("${out}" OFF pairs 0 outlier)
expect("pose again" 0 ARGS pose raw.h5 --mesh rig/mesh.ply --pairs pairs.csv -o pose.json --quiet)
expect("pose over other pairs" 1 ERR "pairs.csv: .*" ARGS pose raw.h5 --mesh rig/mesh.ply
       --pairs rig/picks.csv -o pairs.csv --quiet)
expect("rectify over other pairs" 1 ERR "pose.json: exists and holds something else"
       ARGS rectify rig/photographs --camera camera.yml --step 12 --picks rig/picks.csv
       --pairs pose.json -o raw2.h5 --quiet)
if(EXISTS "${WORK}/raw2.h5")
  fail_case("rectify over other pairs: the light field was written")
endif()
file(STRINGS "${WORK}/pairs.csv" lines)
list(POP_FRONT lines head)
set(wrong "${head}\n")
set(shift 0)
foreach(line ${lines})
  string(REPLACE "," ";" words "${line}")
  list(GET words 0 name)
  list(GET words 1 x)
  list(GET words 2 y)
  list(SUBLIST words 3 2 place)
  list(GET words 5 z)
  string(REPLACE ";" "," place "${place}")
  math(EXPR shift "(${shift} + 17) % 60")
  string(REGEX REPLACE "[.].*" "" x "${x}")
  math(EXPR x "${x} + ${shift}")
  string(APPEND wrong "${name},${x},${y},${place},${z}\n")
endforeach()
file(WRITE "${WORK}/wrong.csv" "${wrong}")
expect("pose of wrong pairs" 0 ERR "wrong.json: the pairs are off by [0-9.]+ px on average"
       ARGS pose raw.h5 --mesh rig/mesh.ply --pairs wrong.csv -o wrong.json)
file(MAKE_DIRECTORY "${WORK}/wrong")
expect("truth of that pose" 0 ERR "wrong.json: the pairs are off by"
       ARGS ground-truth raw.h5 --pose wrong.json -o wrong/lf.h5)
file(READ "${WORK}/pairs.csv" pairs)
string(REGEX REPLACE "\n(p1,[^,]*,[^,]*),[^\n]*" "\n\\1,9999,9999,9999" pairs "${pairs}")
file(WRITE "${WORK}/off.csv" "${pairs}")
expect("pose of pairs off the mesh" 0 ERR "off.json: the points of p1 lie outside of the mesh"
       ARGS pose raw.h5 --mesh rig/mesh.ply --pairs off.csv -o off.json)
expect("pose of pairs that are none" 1 ERR "line 1" ARGS pose raw.h5 --mesh rig/mesh.ply
       --pairs rig/readme.txt -o other.json --quiet)
expect("pose without a pinhole" 1 ERR "pinhole" ARGS pose demo:edge --mesh rig/mesh.ply
       --pairs pairs.csv -o other.json --quiet)

execute_process(COMMAND "${CLI}" pose - --mesh rig/mesh.ply --pairs pairs.csv -o piped.json -q
                WORKING_DIRECTORY "${WORK}" INPUT_FILE "${WORK}/raw.h5" RESULT_VARIABLE code
                OUTPUT_QUIET)
file(MAKE_DIRECTORY "${WORK}/piped")
execute_process(COMMAND "${CLI}" ground-truth - --pose piped.json -o piped/lf.h5 -q
                WORKING_DIRECTORY "${WORK}" INPUT_FILE "${WORK}/raw.h5" RESULT_VARIABLE and_code
                OUTPUT_VARIABLE out)
if(NOT code EQUAL 0 OR NOT and_code EQUAL 0 OR NOT out MATCHES "depth of 9 views from 1 mesh")
  fail_case("the light field is not read from standard input: ${code}, ${and_code}, ${out}")
endif()
expect(ground-truth 0 OUT "depth of 9 views from 1 mesh"
       ARGS ground-truth raw.h5 --pose pose.json -o lf.h5 --quiet)
expect("ground-truth as JSON" 0
       ARGS ground-truth raw.h5 --pose pose.json -o lf.h5 --overwrite --json --quiet)
one_shape("${out}" 1 2)
json_near("${out}" 80 99.99 valid_percent)
expect("a gantry as JSON" 0 ARGS synthesize gantry -o small --grid 3x3 --size 160x120 --json --quiet)
one_shape("${out}" 1 1)
expect(info 0 ARGS info lf.h5 --json)
json_is("${out}" all truth views)
json_near("${out}" 80 99.99 truth valid_percent)
expect("benchmark on it" 0 ARGS benchmark lf.h5 --methods epi_l -o bench --quiet)
expect("ground-truth without a pose" 2 ERR "--pose" ARGS ground-truth raw.h5 -o other.h5)
expect("ground-truth over its input" 1 ERR "raw.h5"
       ARGS ground-truth raw.h5 --pose pose.json -o raw.h5 --overwrite --quiet)
