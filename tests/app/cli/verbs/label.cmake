# Painted strokes become labels of all views: label, show of what it wrote, and what it refuses.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
expect("make a scene" 0 ARGS synthesize objects -o lf.h5 --views 3x3 --size 96x96)
expect("estimate the center" 0 ARGS estimate epi_l lf.h5 -o center.h5 --views center)

expect(label 0 ARGS label lf.h5 --scribbles labels.h5 -o l.h5 --features image+truth
       --regularizer rayspace --json)
json_is("${out}" 3 labels)
json_near("${out}" 0.001 100 seconds)
json_near("${out}" 0.95 1 accuracy_all_views)
json_near("${out}" 0.95 1 accuracy_center)
json_near("${out}" 0.9 1 miou)
json_near("${out}" 0.9 1 macc)
json_near("${out}" 0.6 1 boundary_accuracy)
json_near("${out}" 0.95 1 consistency)
json_near("${out}" 0 0.01 gap)
json_is("${out}" rayspace parameters regularizer)
expect_file(l.h5 ${hdf5})
expect("one energy of all views" 0 ARGS label lf.h5 -o w.h5 --features image+truth
       --regularizer wsg13 --json)
json_is("${out}" wsg13 parameters regularizer)
json_near("${out}" 0 0.01 gap)
json_near("${out}" 0.95 1 accuracy_all_views)
json_near("${out}" 0.95 1 consistency)
expect("label again, over its own result" 0 OUT "3 labels in 9 views.*consistency along rays.*accuracy of all views"
       ARGS label lf.h5 -o l.h5 --features image --regularizer none --trees 8)

foreach(what labels probability uncertainty)
  expect("show ${what}" 0 OUT "${what}, 96×96 px" ARGS show l.h5 -o ${what}.png --what ${what}
         --label 2 --view 0,2)
  expect_file(${what}.png ${png})
endforeach()
expect("show by default" 0 OUT "labels, 96×96 px" ARGS show l.h5 -o l.png)
expect("show an unknown label" 1 ERR "no label 7; it has 1, 2, 3"
       ARGS show l.h5 -o no.png --what probability --label 7)
expect("show a view that is not there" 1 ERR "view 5,5 was asked for"
       ARGS show l.h5 -o no.png --view 5,5)
expect("show what labels lack" 2 ERR "is a file of labels" ARGS show l.h5 -o no.png --what view)
expect("labels alone" 0 ARGS label lf.h5 -o bare.h5 --features image --regularizer none --trees 8
       --no-probabilities --quiet)
expect("no probabilities to show" 1 ERR "has no probabilities"
       ARGS show bare.h5 -o no.png --what uncertainty)

# Nothing that matters is written over.
foreach(file lf.h5 labels.h5)
  file(SHA256 "${WORK}/${file}" before)
  expect("over ${file}" 1 ERR "${file}" ARGS label lf.h5 -o ${file})
  file(SHA256 "${WORK}/${file}" after)
  if(NOT before STREQUAL after)
    fail_case("${file} has changed")
  endif()
endforeach()
expect("a scene without strokes" 0 ARGS synthesize edge -o edge.h5 --views 3x3 --size 32x32)
expect("no strokes" 1 ERR "no scribbles" ARGS label edge.h5 -o no.h5)
expect("a result of other views" 1 ERR "covers 1 of 9"
       ARGS label lf.h5 -o no.h5 --disparity center.h5)
expect("an unknown set" 2 ERR "features" ARGS label lf.h5 -o no.h5 --features color)
expect("truth and a result" 2 ERR "no effect"
       ARGS label lf.h5 -o no.h5 --features image+truth --disparity l.h5)
