# Answers in JSON have one shape; results are judged against what they name; folders, streams and
# other files stand for what they hold.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

file(MAKE_DIRECTORY "${WORK}/scenes/edge" "${WORK}/scenes/bars")
foreach(scene edge bars)
  expect("make ${scene}" 0 ARGS synthesize ${scene} -o scenes/${scene}/lf.h5 --views 3x3 --size 48x48 --json)
  json_is("${out}" 3 views v)
  json_is("${out}" scenes/${scene}/lf.h5 output)
  json_is("${out}" scenes/${scene}/lf.h5 written 0)
endforeach()
one_shape("${out}" 1 2)  # with labels.h5
expect("estimate both" 0 ARGS estimate epi_l scenes -o results --json --views center)
one_shape("${out}" 2 2)
expect("estimate one" 0 ARGS estimate epi_l scenes/edge -o r.h5 --json)
one_shape("${out}" 1 1)
json_is("${out}" epi_l method)
json_is("${out}" epi_l results 0 method)
expect("info" 0 ARGS info scenes/edge --json)
one_shape("${out}" 1 0)
expect("info of a result" 0 ARGS info r.h5 --json)
one_shape("${out}" 1 0)
expect("info of labels alone" 0 OUT "GT_LABELS: 3×3×48×48, ids [12], " ARGS info scenes/edge/labels.h5)
expect("info of labels alone" 0 ARGS info scenes/edge/labels.h5 --json)
one_shape("${out}" 1 0)
json_is("${out}" labels kind)
json_is("${out}" GT_LABELS maps 0 name)
expect("methods" 0 ARGS methods epi_l epi_s --json)
one_shape("${out}" 2 0)
expect("list" 0 ARGS list scenes --json)
one_shape("${out}" 2 0)
json_is("${out}" bars results 0 name)
json_is("${out}" bars scenes 0 name)
expect("convert" 0 ARGS convert r.h5 r.pfm --json)
one_shape("${out}" 1 1)
json_is("${out}" map form)
expect("convert two" 0 ARGS convert scenes copies --to archive --json -q)
one_shape("${out}" 2 4)

# The truth of a result is that of its light field, unless that has changed.
expect("judged by itself" 0 ERR "r.h5: judged against scenes/edge, which it was estimated from"
       ARGS evaluate r.h5 --json)
one_shape("${out}" 1 0)
json_is("${out}" scenes/edge truth)
json_is("${out}" scenes/edge results 0 truth)
string(JSON mse GET "${out}" results 0 mse_100)
string(JSON note GET "${out}" notes 0)
if(NOT note MATCHES "^r.h5: judged against")
  fail_case("the note is not in the answer: ${note}")
endif()
expect("judged as told" 0 ARGS evaluate r.h5 --truth scenes/edge --json)
json_is("${out}" "${mse}" results 0 mse_100)
expect("a map names nothing" 2 ERR "r.pfm does not tell its light field; name it with --truth"
       ARGS evaluate r.pfm)
expect("another view" 0 ARGS evaluate r.h5 --truth scenes/edge --view 0,2 --json)
json_is("${out}" 2 results 0 view 1)
expect("no such view" 1 ERR "view 9,9" ARGS evaluate r.h5 --truth scenes/edge --view 9,9)
expect("chosen metrics" 0 OUT "^file,method,density,mse_100,seconds,runtime_class,all_views\n"
       ARGS evaluate r.h5 --truth scenes/edge --csv --metrics density,mse_100)
expect("unknown metric" 2 ERR "no metric 'mse_10'; did you mean 'mse_100'"
       ARGS evaluate r.h5 --truth scenes/edge --metrics mse_10)

# Folders of results and of light fields.
file(COPY_FILE "${WORK}/r.pfm" "${WORK}/results/edge.pfm")
file(COPY_FILE "${WORK}/r.pfm" "${WORK}/results/other.pfm")
expect("folders" 0 ERR "note: results/other.pfm: no light field has its name; it is left out\n"
       ARGS evaluate results --truth scenes --json)
one_shape("${out}" 3 0)
json_is("${out}" results/bars_epi_l.h5 results 0 file)
json_is("${out}" scenes/bars results 0 truth)
json_is("${out}" results/edge.pfm results 1 file)
json_is("${out}" scenes/edge results 2 truth)
json_is("${out}" "${mse}" results 1 mse_100)
file(REMOVE "${WORK}/results/other.pfm" "${WORK}/results/edge.pfm")

# A damaged result does not stop the others.
execute_process(COMMAND head -c 4000 "${WORK}/r.h5" OUTPUT_FILE "${WORK}/results/edge_damaged.h5")
foreach(truth "" "--truth;scenes" "--truth;scenes/edge")
  run_cli(evaluate results ${truth} --json)
  if(NOT exit_code EQUAL 1 OR NOT err MATCHES
     "note: results/edge_damaged.h5: .*\nepiscope-cli: 1 of 3 results failed, the first: results/edge_damaged.h5: ")
    fail_case("a damaged result among others, ${truth}: ${exit_code} ${err}")
  endif()
  one_shape("${out}" 3 0)
  json_is("${out}" results/edge_damaged.h5 results 2 file)
  string(JSON error GET "${out}" results 2 error)
  if(NOT error MATCHES "^results/edge_damaged.h5: ")
    fail_case("no error in ${out}")
  endif()
endforeach()
run_cli(evaluate results)
if(NOT exit_code EQUAL 1 OR NOT out MATCHES "results/edge_epi_l.h5")
  fail_case("a damaged result among others as a table: ${exit_code} ${out}")
endif()
expect("a damaged result alone" 1 ERR "edge_damaged.h5: " ARGS evaluate results/edge_damaged.h5)
file(REMOVE "${WORK}/results/edge_damaged.h5")
expect("folders by themselves" 0 ERR "judged against" OUT "the truth of each.*file +truth|truth"
       ARGS evaluate results)
file(RENAME "${WORK}/scenes/bars" "${WORK}/scenes/barred")
expect("gone" 1 ERR "its light field, .*bars, is not there" ARGS evaluate results/bars_epi_l.h5)
run_cli(evaluate results --json)
if(NOT exit_code EQUAL 1 OR NOT err MATCHES "episcope-cli: 1 of 2 results failed, the first: .*bars, is not there")
  fail_case("one of two whose light field is gone: ${exit_code} ${err}")
endif()
one_shape("${out}" 2 0)
file(RENAME "${WORK}/scenes/barred" "${WORK}/scenes/bars")
expect("another one in its place" 0 ARGS synthesize edge -o scenes/edge/lf.h5 --views 3x3 --size 48x48
       --noise 3 --overwrite -q)
expect("changed" 1 ERR "does not have the samples that it was estimated from" ARGS evaluate r.h5)

# An error map is a picture like others.
expect("error map" 0 ARGS evaluate r.pfm --truth scenes/edge --error-map e.png --json -q)
one_shape("${out}" 1 1)
expect("the same again" 0 ARGS evaluate r.pfm --truth scenes/edge --error-map e.png -q)
expect("another one" 1 ERR "e.png: exists and holds something else; .*--overwrite"
       ARGS evaluate r.pfm --truth scenes/bars --error-map e.png -q)
expect("another one when asked" 0
       ARGS evaluate r.pfm --truth scenes/bars --error-map e.png --overwrite -q)

# What show draws.
expect("show" 0 OUT "^d.png: disparity, 48×48 px, colors from -?[0-9.]+ to -?[0-9.]+ px\n$"
       ARGS show r.h5 -o d.png --range -1,1.5 -q)
expect("show as JSON" 0 ARGS show r.h5 -o d.png --range -1,1.5 --json -q)
one_shape("${out}" 1 1)
json_is("${out}" -1.0 range 0)
json_is("${out}" px unit)
json_is("${out}" 48 width)
expect("with a legend" 0 ARGS show r.h5 -o legend.png --legend --json -q)
json_near("${out}" 70 200 width)
json_near("${out}" 100 100 height)
expect("a legend of nothing" 2 ERR "--legend has no effect on --what view" ARGS show scenes/edge -o v.png
       --legend)
set(bad show r.pfm --truth scenes/bars --what bad_pixels -q)
expect("bad pixels" 0 OUT "bad above 0.07 px" ARGS ${bad} -o bad.png)
expect("other bad pixels" 0 OUT "bad above 0.5 px" ARGS ${bad} -o bad5.png --threshold 0.5)
file(SHA256 "${WORK}/bad.png" first)
file(SHA256 "${WORK}/bad5.png" second)
if(first STREQUAL second)
  fail_case("the threshold changes nothing")
endif()
expect("a threshold of nothing" 2 ERR "--threshold has no effect" ARGS show r.h5 -o v.png --threshold 1)

# Standard input and output.
function(piped name command expected)
  execute_process(COMMAND sh -c "${command}" WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE code
                  OUTPUT_VARIABLE out ERROR_VARIABLE err TIMEOUT 300)
  if(NOT code EQUAL 0 OR NOT out MATCHES "${expected}")
    fail_case("${name}: ${code}\n${out}\n${err}")
  endif()
endfunction()
expect("the map itself" 0 ARGS evaluate r.pfm --truth scenes/bars --csv -q)
string(REGEX REPLACE ".*\nr.pfm,r,([^,]*),.*" "\\1" number "${out}")
foreach(form - pfm:- npz:- mat:- csv:- tiff:-)
  piped("through ${form}" "'${CLI}' convert r.pfm ${form} --to map | '${CLI}' evaluate - --truth scenes/bars --csv"
        "\n-,stdin,${number},")
endforeach()
piped("an estimate" "'${CLI}' estimate epi_l scenes/bars -o - | '${CLI}' info -" "48×48 px")
piped("a light field" "'${CLI}' estimate epi_l - -o piped.h5 < scenes/bars/lf.h5" "^piped.h5: epi_l of all views")
piped("what was estimated" "'${CLI}' evaluate piped.h5 --truth scenes/bars --csv" "\npiped.h5,epi_l,")
piped("one of several" "cat scenes/bars/lf.h5 | '${CLI}' estimate epi_l scenes/edge - -o both --views center --json"
      "\"input\": \"-\"")
expect_file(both/stdin_epi_l.h5 ${hdf5})
piped("its info" "'${CLI}' info - --json < scenes/bars/lf.h5" "\"input\": \"-\"")
file(MAKE_DIRECTORY "${WORK}/strokes")
expect("strokes to pipe for" 0 ARGS synthesize objects -o strokes/lf.h5 --grid 3x3 --size 48x48)
expect("ids of strokes, without what is unpainted" 0 OUT "SCRIBBLES: [^\n]*, ids 1, " ARGS info strokes/labels.h5)
set(labeled "'${CLI}' label - -o labeled.h5 --scribbles strokes/labels.h5 --features image --trees 4 < strokes/lf.h5")
piped("labels" "${labeled}" "^labeled.h5: 3 labels in 9 views")
expect("of no file" 2 ERR "piped.h5 does not tell its light field" ARGS evaluate piped.h5)
function(piped_fails name code command expected)
  execute_process(COMMAND sh -c "${command}" WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE exit_code
                  OUTPUT_VARIABLE out ERROR_VARIABLE err TIMEOUT 300)
  if(NOT exit_code EQUAL code OR NOT err MATCHES "^episcope-cli: ${expected}")
    fail_case("${name}: ${exit_code}\n${out}\n${err}")
  endif()
endfunction()
piped_fails("a result of something piped" 1 "'${CLI}' estimate epi_l - -o piped.h5 < scenes/edge/lf.h5"
            "piped.h5: exists and does not tell whether it is of what is piped; .*--overwrite")
piped_fails("labels of something piped" 1 "${labeled}"
            "labeled.h5: exists and does not tell whether it is of what is piped; .*--overwrite")
piped_fails("a map" 1 "'${CLI}' estimate epi_l - -o x.h5 < r.pfm" "-: standard input holds no light field.*HDF5")
piped_fails("nothing" 1 "'${CLI}' estimate epi_l - -o x.h5 < /dev/null" "-: standard input is empty")
piped_fails("twice" 2 "'${CLI}' estimate epi_l - - -o x < scenes/bars/lf.h5" "standard input can be read only once")
piped("a picture" "'${CLI}' show r.pfm -o - | head -c 4 | tail -c 3" "^PNG$")
expect("two answers" 2 ERR "--json; leave one" ARGS convert r.pfm - --json)

# Info of files of the window and of the gantry.
file(WRITE "${WORK}/camera.yml" "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ 0.1, 0., 0., 0., 0. ]\navg_reprojection_error: 0.25\n")
expect("a camera" 0 OUT "^camera +photographs of 640×480 px\nfocal +length 500.00 × 501.00 px\n.*error +0.250 px"
       ARGS info camera.yml)
expect("a camera as JSON" 0 ARGS info camera.yml --json)
one_shape("${out}" 1 0)
json_is("${out}" camera kind)
json_is("${out}" 640 width)
file(WRITE "${WORK}/pose.json" "{\"mesh\": \"head.ply\", \"rotation\": [1,0,0,0,1,0,0,0,1], \"translation\": [0.5,0,2]}")
expect("a pose" 0 OUT "^pose +of .*head.ply, which is not there\n.*place +0.5, 0, 2 \\(X, Y, Z\\)"
       ARGS info pose.json)
expect("a pose as JSON" 0 ARGS info pose.json --json)
json_is("${out}" pose kind)
json_is("${out}" OFF mesh_exists)
json_is("${out}" 2.0 translation 2)
json_absent("${out}" reprojection_error_px)
file(WRITE "${WORK}/pairs.json" "{\"mesh\": \"head.ply\", \"rotation\": [1,0,0,0,1,0,0,0,1], \"translation\": [0.5,0,2], \"reprojection_error_px\": 0.5, \"delta_tz\": 3, \"pairs\": [{\"name\": \"a\", \"outlier\": true}, {\"name\": \"b\"}]}")
expect("a pose with its pairs" 0 OUT "pairs +2, 1 of them wrong picks\nerror +0.500 px, depth 3 "
       ARGS info pairs.json)

# A result says what made it, on what, and of which samples.
expect("a result that is whole" 0 ARGS estimate epi_l scenes/bars -o whole.h5 --views center)
expect("a result" 0 OUT "\nversion +Episcope .*\ncommit +[^\n]+\ndevice +[^\n]+\nfinished +20[^\n]+Z\nsource_hash +[0-9a-f]+\ncamera +baseline "
       ARGS info whole.h5)
expect("a result as JSON" 0 ARGS info whole.h5 --json)
foreach(key commit device finished source_hash)
  string(JSON value ERROR_VARIABLE problem GET "${out}" ${key})
  if(problem OR value STREQUAL "")
    fail_case("info does not tell ${key} of a result:\n${out}")
  endif()
endforeach()
string(JSON baseline GET "${out}" camera baseline)
expect("its light field" 0 ARGS info scenes/bars --json)
json_is("${out}" "${baseline}" camera baseline)
expect("a map of another program has none" 0 ARGS info r.pfm --json)
json_absent("${out}" commit)
json_absent("${out}" camera)

# A project of the window.
set(place "{\"view\": [1, 1], \"pixel\": [0, 0], \"focus_px\": 0, \"ranges\": {}}")
set(shown "\"display_range\": [0, 1], \"shown\": true, \"compared\": false")
file(WRITE "${WORK}/work.episcope" "{\"format\": \"episcope project\", \"version\": 1, \"current\": 1, \"bad_threshold_px\": 0.07,
 \"scenes\": [{\"name\": \"bars\", \"source\": \"scenes/bars\", \"hash\": \"0\", \"reading\": {}, \"place\": ${place},
   \"results\": [{\"name\": \"EPI_L\", \"file\": \"whole.h5\", ${shown}}, {\"name\": \"lost\", \"file\": \"lost.h5\", ${shown}}]},
  {\"name\": \"gone\", \"source\": \"scenes/gone\", \"hash\": \"0\", \"reading\": {\"flip\": \"u\"}, \"place\": ${place}, \"results\": []}]}")
expect("a project" 0 OUT "^project +2 light fields\nscene +bars, [^\n]*scenes/bars\n +result +EPI_L, whole.h5\n +result +lost, lost.h5, which is not there\nshown +gone, [^\n]*scenes/gone --flip=u, which is not there\ndate +20"
       ARGS info work.episcope)
expect("a project as JSON" 0 ARGS info work.episcope --json)
one_shape("${out}" 1 0)
json_is("${out}" project kind)
json_is("${out}" ON scenes 0 source_exists)
json_is("${out}" ON scenes 0 results 0 exists)
json_is("${out}" OFF scenes 0 results 1 exists)
json_is("${out}" ON scenes 1 shown)
file(WRITE "${WORK}/broken.episcope" "{\"format\": \"episcope project\"")
expect("a damaged project" 1 ERR "broken.episcope: " ARGS info broken.episcope)
