# Submissions to the 2016 benchmark: written of a whole folder, checked, and read as others' maps.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
file(MAKE_DIRECTORY "${WORK}/scenes/boxes" "${WORK}/scenes/dots")
expect("make boxes" 0 ARGS synthesize objects -o scenes/boxes/lf.h5 --views 3x3 --size 64x48)
expect("make dots" 0 ARGS synthesize bars -o scenes/dots/lf.h5 --views 3x3 --size 64x48)

expect("submit all" 0 OUT "ours/disp_maps/boxes.pfm: st_ch_l of the center view.*ours/disp_maps/dots.pfm"
       ERR "also wants backgammon, pyramids.*episcope-cli validate ours"
       ARGS estimate st_ch_l scenes -o ours --submission)
expect_files(ours disp_maps runtimes)
expect_files(ours/disp_maps boxes.pfm dots.pfm)
expect_files(ours/runtimes boxes.txt dots.txt)
expect_file(ours/disp_maps/boxes.pfm 50660a36342034380a2d312e300a)
expect("validate what there is" 0 OUT "^ours: 2 scenes are complete\n$"
       ARGS validate ours --scenes boxes dots --size 64x48)
expect("validate as JSON" 0 ARGS validate ours --scenes boxes --scenes dots --size 64x48 --json)
one_shape("${out}" 1 0)
json_is("${out}" ON complete)
json_is("${out}" 2 scenes)

expect("evaluate a submission" 0 ARGS evaluate ours --truth scenes/boxes --json
       --protocol benchmark2016)
json_near("${out}" 0 100 results 0 mse_100)
json_near("${out}" -6 4 results 0 runtime_log)
json_near("${out}" 0 1000 results 0 seconds)
file(SHA256 "${WORK}/ours/disp_maps/boxes.pfm" before)
expect("over another submission" 1 ERR "2 of 2 .*boxes.pfm: exists and does not tell which method"
       ARGS estimate st_av_l scenes -o ours --submission --quiet)
file(SHA256 "${WORK}/ours/disp_maps/boxes.pfm" after)
if(NOT before STREQUAL after)
  fail_case("a submission was replaced")
endif()
expect("a method of one view" 2 ERR "leave out --views" ARGS estimate st_ch_l scenes -o ours
       --submission --views all)

run_cli(validate ours --json)
if(NOT exit_code EQUAL 1 OR NOT err MATCHES "^episcope-cli: ours would not be accepted: [0-9]+ problems, the first: [^\n]+\n$")
  fail_case("an incomplete submission: ${exit_code} ${err}")
endif()
json_is("${out}" OFF complete)
string(JSON problems LENGTH "${out}" problems)
if(NOT problems EQUAL 22)  # ten scenes are missing, the maps of two are too small
  fail_case("${problems} problems in ${out}")
endif()
expect("no folder" 1 ERR "is not a folder" ARGS validate nothing)
expect("a bad size" 2 ERR "--size" ARGS validate ours --size 64)
