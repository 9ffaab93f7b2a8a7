# Nothing that matters is written over: neither an input nor the files that belong to it, nor another
# light field unless that is asked for.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
file(MAKE_DIRECTORY "${WORK}/a" "${WORK}/b")
expect("make a" 0 ARGS synthesize objects -o a/lf.h5 --views 3x3 --size 48x48)
expect("make b" 0 ARGS synthesize objects -o b/lf.h5 --views 3x3 --size 48x48 --seed 2 --noise 1)
expect("make a result" 0 ARGS estimate epi_l a -o a/r.h5 --views center)
expect("make a folder of images" 0 ERR "^note: The benchmark form" ARGS convert a bench/)
set(kept a/lf.h5 a/labels.h5 b/lf.h5 b/labels.h5 bench/input_Cam000.png bench/gt_disp_lowres.pfm)
foreach(file ${kept})
  file(SHA256 "${WORK}/${file}" before_${file})
endforeach()

# refused(stderr regex, arguments…)
macro(refused pattern)
  expect("refused" 1 ERR "${pattern}" ARGS ${ARGN})
endmacro()
foreach(option "" --overwrite)
  refused("a/lf.h5: .*input" convert a a/lf.h5 ${option})
  refused("a/lf.h5: is the input" convert a/lf.h5 ./a/lf.h5 ${option})
  refused("a/labels.h5: .*input" convert a a/labels.h5 ${option})
  refused("a/labels.h5: .*input" convert a/lf.h5 a/labels.h5 ${option})
  refused("a/lf.h5: .*input" convert a/r.h5 a/lf.h5 ${option})
  refused("b/labels.h5: exists and is not a light field" synthesize fronto -o b/labels.h5 ${option})
  refused("b/labels.h5: exists and is not a light field" convert a b/labels.h5 ${option})
  refused("a/r.h5: exists and is not a light field" synthesize fronto -o a/r.h5 ${option})
  refused("gt_disp_lowres.pfm: .*input" convert bench bench/gt_disp_lowres.pfm ${option})
endforeach()
refused("b/lf.h5: exists; .*--overwrite" synthesize fronto -o b/lf.h5)
refused("b/lf.h5: exists; .*--overwrite" convert a b/lf.h5)
refused("input_Cam000.png: .*input" show bench -o bench/input_Cam000.png)
refused("input_Cam000.png: .*input" evaluate a/r.h5 --truth bench --error-map
        bench/input_Cam000.png)
refused("a/lf.h5: exists and is not a result" estimate epi_l b -o a/lf.h5)
refused("a/labels.h5: exists and is not a result" estimate epi_l a -o a/labels.h5)
foreach(file ${kept})
  file(SHA256 "${WORK}/${file}" after)
  if(NOT after STREQUAL before_${file})
    fail_case("${file} has changed")
  endif()
endforeach()
expect_files(a labels.h5 lf.h5 r.h5)
expect_files(b labels.h5 lf.h5)

# Nor are views and truth of any light field.
refused("input_Cam000.png: is part of a light field" show a -o bench/input_Cam000.png --overwrite)
refused("gt_disp_lowres.pfm: is part of a light field" convert a/r.h5 bench/gt_disp_lowres.pfm
        --overwrite)
refused("gt_disp_lowres.pfm: is part of a light field" estimate epi_l a -o bench/gt_disp_lowres.pfm
        --overwrite)
expect("a light field in an array" 0 ERR "note" ARGS convert a a/array.npy)
refused("array.npy: is part of a light field" estimate epi_l b -o a/array.npy --overwrite)
file(REMOVE "${WORK}/a/array.npy")
foreach(file ${kept})
  file(SHA256 "${WORK}/${file}" after)
  if(NOT after STREQUAL before_${file})
    fail_case("${file} has changed")
  endif()
endforeach()
foreach(view 1 2)
  expect("a picture of ours among views" 0 ARGS show b -o bench/error.png --view 0,${view} --overwrite)
endforeach()
file(REMOVE "${WORK}/bench/error.png")

expect("replace a light field when asked" 0 ARGS convert a b/lf.h5 --overwrite)
expect("synthesize over a light field when asked" 0
       ARGS synthesize fronto -o b/lf.h5 --views 3x3 --size 48x48 --overwrite)
expect("the new one is there" 0 OUT "labels +1 in all" ARGS info b/lf.h5)
foreach(again 1 2)
  expect("a picture beside the light field" 0 ARGS show a -o a/view.png)
  expect("a map beside its result" 0 ARGS convert a/r.h5 a/r.pfm)
endforeach()

# A result of another method, other parameters or another scene stays unless asked otherwise.
function(expect_kept file)
  file(SHA256 "${WORK}/${file}" after)
  if(NOT after STREQUAL "${before_${file}}")
    fail_case("${file} has changed")
  endif()
endfunction()
file(SHA256 "${WORK}/a/r.h5" before_a/r.h5)
refused("a/r.h5: exists and holds a result of epi_l; .*--overwrite" estimate epi_s a -o a/r.h5)
refused("a/r.h5: exists and holds a result with --inner-scale .*--overwrite" estimate epi_l a
        -o a/r.h5 --inner_scale 0.9)
refused("a/r.h5: exists and holds a result of another light field, a; .*--overwrite"
        estimate epi_l b -o a/r.h5)
refused("a/r.h5: exists and holds a result of another reading" estimate epi_l a -o a/r.h5
        --focus 0.5)
expect_kept(a/r.h5)
expect("the same method again" 0 ARGS estimate epi_l a -o a/r.h5 --views center)
expect("the same by the file" 0 ARGS estimate EPI_L a/lf.h5 -o a/r.h5 --views center)
expect("parameters at their defaults" 0 ARGS estimate epi_l a -o a/r.h5 --views center --range auto)
expect("another method when asked" 0 OUT "epi_s" ARGS estimate epi_s a -o a/r.h5 --views center
       --overwrite -q)
refused("a/r.pfm: exists and holds something else; .*--overwrite" convert a/r.h5 a/r.pfm)
expect("a map when asked" 0 ARGS convert a/r.h5 a/r.pfm --overwrite)

file(SHA256 "${WORK}/a/view.png" before_a/view.png)
refused("a/view.png: exists and holds something else; .*--overwrite" show a/r.h5 -o a/view.png)
expect_kept(a/view.png)
expect("another picture when asked" 0 ARGS show a/r.h5 -o a/view.png --overwrite)
expect_files(a labels.h5 lf.h5 r.h5 r.pfm view.png)
expect("all views" 0 ARGS estimate epi_l a -o b/all.h5)
refused("b/all.h5: exists and holds a result of several views; .*--overwrite" estimate epi_l a
        -o b/all.h5 --views center)
expect("one view when asked" 0 ARGS estimate epi_l a -o b/all.h5 --views center --overwrite)
expect("all views in its place" 0 ARGS estimate epi_l a -o b/all.h5)

# Nor do labels of other strokes, disparity or parameters.
expect("strokes" 0 ARGS label a -o a/drawn.h5 --features image --regularizer view)
expect("the same strokes" 0 ARGS label a -o a/drawn.h5 --features image --regularizer view)
file(SHA256 "${WORK}/a/drawn.h5" before_a/drawn.h5)
refused("a/drawn.h5: exists and holds labels of other strokes.*--overwrite" label a
        --scribbles b/labels.h5 -o a/drawn.h5 --features image --regularizer view)
refused("a/drawn.h5: exists and holds labels with --regularizer .*--overwrite" label a
        -o a/drawn.h5 --features image --regularizer none)
expect_kept(a/drawn.h5)
expect("other parameters when asked" 0 ARGS label a -o a/drawn.h5 --features image
       --regularizer none --overwrite)
file(REMOVE "${WORK}/a/drawn.h5")

# Maps do not say what made them.
foreach(suffix npy pfm tiff)
  expect("estimate a ${suffix}" 0 OUT "map.${suffix}: epi_l of the center view"
         ARGS estimate epi_l a -o map.${suffix})
  refused("map.${suffix}: exists and does not tell .*--overwrite" estimate epi_l a -o map.${suffix})
  expect("estimate it when asked" 0 ARGS estimate epi_l a -o map.${suffix} --overwrite)
endforeach()
expect("evaluate them" 0 OUT "map.npy.*map.pfm" ARGS evaluate map.npy map.pfm map.tiff --truth a)
expect("all views in a map" 2 ERR "one view; leave out --views" ARGS estimate epi_l a -o all.pfm
       --views all)

# What is written is printed; labels bear the name of their light field.
file(MAKE_DIRECTORY "${WORK}/c")
expect("labels beside" 0 OUT "^c/copy.h5: written\nc/copy_labels.h5: labels of copy.h5\n$"
       ARGS convert b c/copy.h5)
expect_files(c copy.h5 copy_labels.h5)
expect("they are read" 0 OUT "labels +1 in all" ARGS info c/copy.h5)
expect("labels of lf.h5" 0 OUT "^c/lf.h5: written\nc/labels.h5: labels of lf.h5\n$"
       ARGS convert b c/lf.h5)
refused("c/copy.h5: exists" convert a c/copy.h5)
file(REMOVE "${WORK}/c/copy.h5")
refused("c/copy_labels.h5: exists" convert a c/copy.h5)
expect("error maps" 0 OUT "\ne-r.png: error of a/r.h5\ne-map.png: error of map.npy\n$"
       ARGS evaluate a/r.h5 map.npy --truth a --error-map e.png)
expect_file(e-r.png ${png})
expect("error maps as JSON" 0 ARGS evaluate a/r.h5 --truth a --error-map e.png --json)
json_is("${out}" e.png results 0 error_map)
expect("error maps as CSV" 0 ERR "^note: wrote e.png: error of a/r.h5\n$"
       ARGS evaluate a/r.h5 --truth a --error-map e.png --csv)
expect("the help tells of it" 0 OUT "--overwrite" ARGS convert --help)
expect("the help of synthesize too" 0 OUT "--overwrite" ARGS synthesize --help)
