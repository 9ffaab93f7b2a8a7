# A result file knows its camera: depth follows from it without the light field.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

expect(synthesize 0 ARGS synthesize objects -o lf.h5 --views 3x3 --size 64x64)
expect(estimate 0 ARGS estimate epi_l lf.h5 -o r.h5 --quiet)
expect("the error of the result" 0 ARGS evaluate r.h5 --truth lf.h5 --json)
string(JSON expected GET "${out}" results 0 mse_100)
file(RENAME "${WORK}/lf.h5" "${WORK}/elsewhere.h5")

foreach(name depth.pfm depth.tif depth.npy)
  expect("${name}" 0 OUT "${name}: written" ARGS convert r.h5 ${name} --values depth)
  expect("evaluate ${name}" 0 ARGS evaluate ${name} --truth elsewhere.h5 --map-values depth --json)
  string(JSON found GET "${out}" results 0 mse_100)
  string(SUBSTRING "${found}" 0 5 found)
  string(SUBSTRING "${expected}" 0 5 beginning)
  if(NOT found STREQUAL beginning)
    fail_case("${name}: MSE×100 is ${found}, expected ${beginning}")
  endif()
endforeach()

expect("depth of the truth" 0 ARGS convert elsewhere.h5 truth.pfm --values depth)
expect("evaluate it" 0 ARGS evaluate truth.pfm --truth elsewhere.h5 --map-values depth --json)
json_near("${out}" 0 0.001 results 0 mse_100)

# Without a camera, and where it would mean nothing.
expect("a map" 0 ARGS convert r.h5 map.pfm)
expect("a map without a camera" 1 ERR "map.pfm: depth does not follow from disparity.*--truth INPUT"
       ARGS convert map.pfm d.pfm --values depth)
expect("with its light field" 0 ARGS convert map.pfm d.pfm --values depth --truth elsewhere.h5)
expect("a light field" 2 ERR "--values depth is for a map.*x.h5"
       ARGS convert elsewhere.h5 x.h5 --values depth)

# Compressed on request, with the same content.
expect(compress 0 ARGS estimate epi_l elsewhere.h5 -o packed.h5 --compress --quiet)
expect("not compressed" 0 ARGS estimate epi_l elsewhere.h5 -o unpacked.h5 --quiet)
file(SIZE "${WORK}/unpacked.h5" unpacked)
file(SIZE "${WORK}/packed.h5" packed)
if(NOT packed LESS unpacked)
  fail_case("a compressed result has ${packed} bytes, a plain one ${unpacked}")
endif()
execute_process(COMMAND "${SAME_RESULTS}" unpacked.h5 packed.h5 3 3 WORKING_DIRECTORY "${WORK}"
                RESULT_VARIABLE differs OUTPUT_VARIABLE difference)
if(differs)
  fail_case("a compressed result differs: ${difference}")
endif()
expect("compress a map" 2 ERR "--compress is for a result file"
       ARGS estimate epi_l elsewhere.h5 -o x.pfm --compress)

# Disparity beside depth, on request.
expect("archive" 0 ARGS convert elsewhere.h5 plain.h5)
expect("with disparity" 0 ARGS convert elsewhere.h5 both.h5 --gt-disparity)
expect("no archive" 2 ERR "--gt-disparity is for the archive form.*x.npy"
       ARGS convert elsewhere.h5 x.npy --gt-disparity)
file(SIZE "${WORK}/plain.h5" plain)
file(SIZE "${WORK}/both.h5" both)
math(EXPR more "${both} - ${plain}")
if(more LESS 147456 OR more GREATER 163840)
  fail_case("GT_DISPARITY of 9 views of 64×64 px has 147456 bytes, the file grew by ${more}")
endif()
expect("evaluate the truth" 0 ARGS convert both.h5 again.pfm)
expect("it is the same" 0 ARGS evaluate again.pfm --truth plain.h5 --json)
json_near("${out}" 0 0.001 results 0 mse_100)
