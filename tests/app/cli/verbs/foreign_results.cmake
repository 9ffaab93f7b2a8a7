# Disparity maps of other programs in HDF5 files: show, convert, evaluate without a word on what
# they are.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

# write_map(out views datasets…)
function(write_map out views)
  execute_process(COMMAND "${WRITE_MAP}" truth.pfm "${out}" ${views} ${ARGN}
                  WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    fail_case("${out} could not be made: ${code}")
  endif()
endfunction()

expect(synthesize 0 ARGS synthesize objects -o lf.h5 --views 3x3 --size 64x48)
expect("the truth as PFM" 0 ARGS convert lf.h5 truth.pfm)
write_map(one.h5 0 depth_map)
write_map(all.h5 3 disparities)
write_map(two.h5 0 left right)

foreach(file one all)
  expect("show ${file}" 0 OUT "^${file}.png: disparity" ARGS show ${file}.h5 -o ${file}.png)
  expect_file(${file}.png ${png})
  expect("convert ${file} to PFM" 0 ARGS convert ${file}.h5 ${file}.pfm)
  expect("evaluate ${file} and its PFM" 0 ARGS evaluate ${file}.h5 ${file}.pfm --truth lf.h5 --json)
  json_is("${out}" 100.0 results 0 density)
  json_is("${out}" 100.0 results 1 density)
  json_near("${out}" 0 0.0001 results 1 mse_100)
  expect("show the error of ${file}" 0 ARGS show ${file}.h5 -o e_${file}.png --what error --truth lf.h5)
endforeach()
file(SHA256 "${WORK}/one.png" of_one)
file(SHA256 "${WORK}/all.png" of_all)
if(NOT of_one STREQUAL of_all)
  fail_case("the same map looks different as that of one view and of all")
endif()
expect("evaluate one view" 0 ARGS evaluate one.h5 --truth lf.h5 --json)
json_near("${out}" 0 0.0001 results 0 mse_100)
json_is("${out}" OFF results 0 all_views)

# The same map as that of another view.
expect("estimate a corner" 0 ERR "note: " ARGS estimate st_ch_s lf.h5 -o corner.h5 --view 0,2)
expect("evaluate the corner" 0 ARGS evaluate corner.h5 --truth lf.h5 --json)
json_is("${out}" 2 results 0 view 1)
string(JSON of_corner GET "${out}" results 0 mse_100)
expect("convert the corner" 0 ARGS convert corner.h5 corner.npy)
expect("evaluate a map of a stated view" 0 ARGS evaluate corner.npy --truth lf.h5 --view 0,2 --json)
string(JSON of_map GET "${out}" results 0 mse_100)
if(NOT of_map STREQUAL of_corner)
  fail_case("a map of a stated view has ${of_map}, its result ${of_corner}")
endif()

expect("two maps" 1 ERR "2 were found \\(left, right\\)" ARGS show two.h5 -o two.png)
expect("two maps to convert" 1 ERR "2 were found \\(left, right\\)" ARGS convert two.h5 two.pfm)
expect("error without a truth" 2 ERR "--truth" ARGS show one.h5 -o e2.png --what error)

# An estimate where the truth is looked for is not judged by itself.
file(MAKE_DIRECTORY "${WORK}/n")
expect("a bare light field" 0 ERR "holds no disparities" ARGS convert lf.h5 n/lf.npy)
expect("an estimate named as truth" 0 ERR "will be read as ground truth of n/lf.npy"
       ARGS estimate epi_l n/lf.npy -o n/lf_disparity.npy)
expect("a judge of itself" 1 ERR "is read as the ground truth of n/lf.npy itself"
       ARGS evaluate n/lf_disparity.npy --truth n/lf.npy)
