# A result remembers how its light field was read. Whoever reads the light field again reads it the
# same way, for each option that changes views or truth; options that contradict are refused.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

# score_of(variable input results… [options…] [TOLD regex]): MSE of the last result, without a word
# on standard error but for what is told.
function(score_of variable)
  cmake_parse_arguments(SCORE "" "TOLD" "" ${ARGN})
  set(arguments ARGS evaluate --json --truth ${SCORE_UNPARSED_ARGUMENTS})
  if(DEFINED SCORE_TOLD)
    list(PREPEND arguments ERR "${SCORE_TOLD}")
  endif()
  expect("evaluate for ${variable}" 0 ${arguments})
  string(JSON last LENGTH "${out}" results)
  math(EXPR last "${last} - 1")
  string(JSON score GET "${out}" results ${last} mse_100)
  set(${variable} ${score} PARENT_SCOPE)
endfunction()
# picture_of(variable what subject options…): hash of the picture of view 1,0.
function(picture_of variable what subject)
  expect("show for ${variable}" 0 ARGS show ${subject} -o ${variable}.png --what ${what}
         --view 1,0 --overwrite ${ARGN})
  file(SHA256 "${WORK}/${variable}.png" hash)
  set(${variable} ${hash} PARENT_SCOPE)
endfunction()
function(expect_equal what a b)
  if(NOT a STREQUAL b)
    fail_case("${what}: ${a} and ${b}, expected to be equal")
  endif()
endfunction()
function(expect_different what a b)
  if(a STREQUAL b)
    fail_case("${what}: ${a} twice, expected to differ")
  endif()
endfunction()

file(MAKE_DIRECTORY "${WORK}/a")
expect(synthesize 0 ARGS synthesize objects -o a/lf.h5 --views 3x3 --size 64x48)
expect("estimate plainly" 0 ARGS estimate epi_l a/lf.h5 -o a/plain.h5)
expect("the benchmark form" 0 ERR "^note: The benchmark form" ARGS convert a/lf.h5 bench)
score_of(plain a/lf.h5 a/plain.h5)

# Focus: a map that remembers nothing is judged in the focus that is asked for.
expect("estimate with a focus plane" 0 ARGS estimate epi_l a/lf.h5 -o a/focus.h5 --focus 0.5)
expect("a map forgets the focus" 0 ERR "evaluate it with --focus=0.5"
       ARGS convert a/focus.h5 focus.pfm)
score_of(at_focus a/lf.h5 focus.pfm --focus 0.5)
score_of(unfocused a/lf.h5 focus.pfm TOLD "off by -0.[45][0-9]* px everywhere.*--focus")
expect_different("the focus plane" ${at_focus} ${unfocused})
score_of(remembered a/lf.h5 a/focus.h5)
expect_equal("a result with a focus plane" ${remembered} ${at_focus})
score_of(repeated a/lf.h5 a/focus.h5 --focus 0.5)
expect_equal("the same focus plane again" ${repeated} ${at_focus})
score_of(in_other_form bench a/focus.h5)
expect_equal("a focus plane holds for another form" ${in_other_form} ${at_focus})
score_of(second a/lf.h5 a/plain.h5 a/focus.h5)
expect_equal("a focused result after a plain one" ${second} ${at_focus})
score_of(second a/lf.h5 a/focus.h5 a/plain.h5)
expect_equal("a plain result after a focused one" ${second} ${plain})
expect("another focus plane" 1 ERR "with --focus=0.5, but --focus=0.25.*leave --focus out"
       ARGS evaluate a/focus.h5 --truth a/lf.h5 --focus 0.25)
expect("no focus plane" 1 ERR "with --focus=0.5, but --focus=0 "
       ARGS show a/focus.h5 -o x.png --what error --truth a/lf.h5 --focus 0)
expect("a focus plane afterwards" 1 ERR "without --focus, but --focus=0.5"
       ARGS evaluate a/plain.h5 --truth a/lf.h5 --focus 0.5)

# Two results are compared in one focus plane. A map that remembers nothing is subtracted as it is.
# The ranges are wide, so that a rounding of the last bit changes no colour.
expect("the plain result as a map" 0 ARGS convert a/plain.h5 plain.pfm)
expect("difference of the maps" 0 ARGS show focus.pfm -o raw.png --what difference --minus plain.pfm
       --range -8.5,7.5)
expect("difference of the results" 0 ARGS show a/focus.h5 -o d.png --what difference
       --minus a/plain.h5 --range -8,8)
file(SHA256 "${WORK}/raw.png" raw)
file(SHA256 "${WORK}/d.png" difference)
expect_equal("a difference across focus planes" ${difference} ${raw})

# Labels are carried along the rays of the light field as it is read now. A shear by whole pixels is
# exact, so that the result is the same.
function(accuracy_of variable result)
  expect("label for ${variable}" 0 ARGS label a/lf.h5 -o labels.h5 --trees 4 --json --overwrite
         --disparity ${result})
  string(JSON share GET "${out}" accuracy_center)
  set(${variable} ${share} PARENT_SCOPE)
endfunction()
expect("estimate in a far focus plane" 0 ARGS estimate epi_l a/lf.h5 -o a/far.h5 --focus 2)
accuracy_of(by_plain a/plain.h5)
accuracy_of(by_far a/far.h5)
expect_equal("labels by a result with a focus plane" ${by_far} ${by_plain})

# Labels remember the focus plane as well: those of a view off the centre belong to a moved image.
expect("label in a focus plane" 0
       ARGS label a/lf.h5 -o a/segments.h5 --features image --trees 4 --focus 2)
picture_of(remembered wrong_labels a/segments.h5)
picture_of(repeated wrong_labels a/segments.h5 --focus 2)
expect_equal("labels with a focus plane" ${remembered} ${repeated})
picture_of(shown segmentation a/segments.h5 --over-view 0 --color-view)
picture_of(focused view a/lf.h5 --focus 2)
expect_equal("the view of labels with a focus plane" ${shown} ${focused})
expect("another focus plane of labels" 1 ERR "with --focus=2, but --focus=0 .*leave --focus out"
       ARGS show a/segments.h5 -o x.png --what wrong_labels --focus 0)

# A submission is judged in the focus plane of its scene, whose name is that of the folder.
file(MAKE_DIRECTORY "${WORK}/submission")
file(COPY_FILE "${WORK}/a/far.h5" "${WORK}/submission/a.h5")
expect("benchmark with a submission" 0 ERR "^note: submission on a: moved to a focus plane"
       ARGS benchmark a/lf.h5 --methods epi_l -o tables --json --submission submission)
json_is("${out}" submission results 1 entry)
json_near("${out}" 0.1 20 results 1 vmv2013 mse_100)

# Order of views.
expect("estimate with a flip" 0 ERR "chosen by hand"
       ARGS estimate epi_l a/lf.h5 -o a/flip.h5 --flip u)
picture_of(flipped view a/lf.h5 --flip u)
picture_of(stored view a/lf.h5)
expect_different("the flip" ${flipped} ${stored})
picture_of(remembered view a/flip.h5)
expect_equal("views of a result with a flip" ${remembered} ${flipped})
score_of(score a/lf.h5 a/flip.h5)  # no note of other samples
expect("another flip" 1 ERR "with --flip=u, but --flip=none.*leave --flip out"
       ARGS evaluate a/flip.h5 --truth a/lf.h5 --flip none)
expect("a flip afterwards" 0 ERR "other samples[^\n]*; its own were read without --flip=u\n"
       ARGS evaluate a/plain.h5 --truth a/lf.h5 --flip u)
expect("a flip in another form" 0 ERR "other samples[^\n]*; its own were read with --flip=u\n"
       ARGS evaluate a/flip.h5 --truth bench)
expect("the same flip in another form" 0 ARGS evaluate a/flip.h5 --truth bench --flip u)
expect("labels by a flipped result" 0 ERR "other samples[^\n]*; its own were read with --flip=u\n"
       ARGS label a/lf.h5 -o labels.h5 --disparity a/flip.h5 --trees 4 --overwrite)
expect("difference from a flipped result" 0
       ERR "a/flip.h5 was read with --flip=u, that of a/plain.h5 was not"
       ARGS show a/plain.h5 -o other.png --what difference --minus a/flip.h5)

expect("label with a flip" 0 ERR "chosen by hand"
       ARGS label a/lf.h5 -o a/flipped.h5 --features image --trees 4 --flip u)
picture_of(shown segmentation a/flipped.h5 --over-view 0 --color-view)
expect_equal("the view of labels with a flip" ${shown} ${flipped})

# Units of the true depth: the estimate is the same, the truth is not.
expect("estimate with units" 0 ERR "implausible"
       ARGS estimate epi_l a/lf.h5 -o a/units.h5 --units without-width)
# Truth in the wrong units fits neither results nor views, which is told.
set(told "but the views fit it as it is: check the ground truth, or add --map-scale=")
score_of(other_units a/lf.h5 a/plain.h5 --units without-width TOLD "${told}")
expect_different("the units" ${other_units} ${plain})
score_of(remembered a/lf.h5 a/units.h5 TOLD "${told}")
expect_equal("a result with units" ${remembered} ${other_units})
expect("contradicting units" 1 ERR "with --units=without-width, but --units=with-width"
       ARGS evaluate a/units.h5 --truth a/lf.h5 --units with-width)

# An option that means nothing to a form is named, and changes nothing.
expect("an option of another form" 0 ERR "--units is ignored, because this is [^\n]*2016"
       ARGS estimate epi_l bench -o a/ignored.h5 --units with-width)
score_of(score bench a/ignored.h5)

# Names and order of the images of a grid, whose names fit two patterns.
file(MAKE_DIRECTORY "${WORK}/grid" "${WORK}/snake")
foreach(v RANGE 2)
  foreach(u RANGE 2)
    math(EXPR index "100 + ${v} * 3 + ${u}")
    string(SUBSTRING ${index} 1 2 index)
    math(EXPR captured "100 + ${v} * 3 + ${u} + (${v} % 2) * (2 - 2 * ${u})")
    file(COPY_FILE "${WORK}/bench/input_Cam0${index}.png" "${WORK}/grid/view_${v}_${u}.png")
    file(COPY_FILE "${WORK}/bench/input_Cam0${index}.png" "${WORK}/snake/shot_${captured}.png")
  endforeach()
endforeach()
set(pattern "view_{row}_{col}.png")
set(transposed "view_{col}_{row}.png")
picture_of(straight view grid --pattern ${pattern})
picture_of(by_pattern view grid --pattern ${transposed})
expect_different("the pattern" ${by_pattern} ${straight})
expect("estimate with a pattern" 0 ERR "Near and far" ARGS estimate epi_l grid -o pattern.h5 --pattern ${transposed})
picture_of(remembered view pattern.h5)
expect_equal("views of a result with a pattern" ${remembered} ${by_pattern})
expect("another pattern" 1 ERR "with --pattern=[^\n]*, but --pattern=[^\n]*leave --pattern out"
       ARGS show pattern.h5 -o x.png --what view --truth grid --pattern ${pattern})
expect("estimate in snake order" 0 ERR "Near and far" ARGS estimate epi_l snake -o snake.h5 --snake)
picture_of(remembered view snake.h5)
expect_equal("views of a result in snake order" ${remembered} ${straight})
score_of(score bench snake.h5)  # no note of other samples

# Built-in scenes, and a folder that has moved.
expect("estimate a built-in scene" 0
       ARGS estimate epi_l demo:fronto -o demo.h5 --views center --focus 0.25)
score_of(score demo:fronto demo.h5)
if(score GREATER 0.01)
  fail_case("a built-in scene with a focus plane has MSE ${score}")
endif()
picture_of(before error a/focus.h5 --view 1,1)
picture_of(view_before view a/flip.h5)
file(RENAME "${WORK}/a" "${WORK}/b")
picture_of(after error b/focus.h5 --view 1,1)
picture_of(view_after view b/flip.h5)
expect_equal("the error after a move" ${after} ${before})
expect_equal("a flipped view after a move" ${view_after} ${view_before})
