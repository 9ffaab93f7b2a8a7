# Maps of other programs in another order, sign or unit: what their files state is honored, the rest
# is told with both numbers and the option that applies it, and nothing else is changed.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

# write_map(out form)
function(write_map out form)
  execute_process(COMMAND "${WRITE_MAP}" truth.pfm "${out}" "${form}" disparity
                  WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    fail_case("${out} could not be made: ${code}")
  endif()
endfunction()

expect(synthesize 0 ARGS synthesize objects -o lf.h5 --views 3x3 --size 64x64)
expect("the truth as PFM" 0 ARGS convert lf.h5 truth.pfm)
write_map(axes.h5 "x,y")
write_map(matlab.mat matlab)
write_map(reversed.h5 reversed)
write_map(hundredths.npy hundredths)
expect("transposed" 0 ARGS convert truth.pfm transposed.npy --map-transpose)
expect("negated" 0 ARGS convert truth.pfm negated.pfm --map-scale -1)
expect("upside down" 0 ARGS convert truth.pfm flipped.tif --map-flip y)

# Stated: right at once, and not a word.
foreach(file axes.h5 matlab.mat)
  expect("evaluate ${file}" 0 ARGS evaluate ${file} --truth lf.h5 --json)
  json_near("${out}" 0 0.0001 results 0 mse_100)
  json_absent("${out}" results 0 better_reading)
endforeach()

# Not stated: judged as it is, with a word on how it would fit.
foreach(row "reversed.h5;--map-transpose" "transposed.npy;--map-transpose"
            "negated.pfm;--map-scale=-1" "hundredths.npy;--map-scale=0.01"
            "flipped.tif;--map-flip=y")
  list(GET row 0 file)
  list(GET row 1 option)
  expect("evaluate ${file}" 0 ERR "${file}: the map fits the ground truth far better with .*MSE×100 [0-9.e-]+ instead of [0-9.e+]+.*; if it is stored so, add ${option}\n"
         ARGS evaluate ${file} --truth lf.h5 --json)
  json_near("${out}" 1 100000000 results 0 mse_100)
  json_near("${out}" 0 0.01 results 0 better_reading mse_100)
  json_near("${out}" 1 100000000 results 0 better_reading mse_100_as_read)
  json_is("${out}" "${option}" results 0 better_reading options)
  expect("evaluate ${file} as told" 0 ARGS evaluate ${file} --truth lf.h5 --json ${option})
  json_near("${out}" 0 0.01 results 0 mse_100)
  json_absent("${out}" results 0 better_reading)
  expect("show ${file}" 0 ERR "add ${option}\n" ARGS show ${file} --truth lf.h5 -o ${file}.png)
  expect("show ${file} as told" 0 ARGS show ${file} --truth lf.h5 -o told_${file}.png ${option})
endforeach()

# Another resolution: the error names the option.
expect("a larger scene" 0 ERR "labels" ARGS synthesize objects -o twice.h5 --views 3x3 --size 128x128)
expect("half the resolution" 1 ERR "name the light field of the estimate, or bring a map .*--map-resize"
       ARGS evaluate truth.pfm --truth twice.h5)
expect("show it" 1 ERR "truth.pfm: the map has 64×64 px, but [a-z_]+ has 128×128 px; name the light field"
       ARGS show truth.pfm --truth twice.h5 -o twice.png --over-view .5)
expect("convert it" 1 ERR "the map has 64×64 px" ARGS convert truth.pfm t2.h5 --truth twice.h5)
expect("estimate the small scene" 0 ARGS estimate epi_l lf.h5 -o small.h5 --views center -q)
expect("and the large one" 0 ARGS estimate epi_l twice.h5 -o large.h5 --views center -q)
expect("their difference" 1 ERR "the result of epi_l has 128×128 px, but that of epi_l has 64×64 px"
       ARGS show small.h5 --what difference --minus large.h5 -o d.png -q)
expect("a scene of the same size" 0 ARGS synthesize edge -o edge.h5 --views 3x3 --size 64x64)
expect("estimate it" 0 ARGS estimate epi_l edge.h5 -o of_edge.h5 --views center -q)
expect("its difference" 0 ERR "note: of_edge.h5: it was estimated from other samples than small.h5\n"
       ARGS show small.h5 --what difference --minus of_edge.h5 -o d.png)
# What a result was estimated from stays what it says.
expect("its result there" 0 ERR "note: of_edge.h5: the result was estimated from other samples than [a-z_]+ has"
       ARGS convert of_edge.h5 other.h5 --truth lf.h5)
expect("info of it" 0 OUT "estimated by epi_l from edge.h5\n" ERR "" ARGS info other.h5)
expect("evaluate it there" 0 ERR "note: of_edge.h5: the result was estimated from other samples than"
       ARGS evaluate of_edge.h5 --truth lf.h5)

expect("enlarged" 0 ARGS evaluate truth.pfm --truth twice.h5 --map-resize --json)

# A number where nothing is known: told with both numbers, too.
expect("the truth as text" 0 ARGS convert lf.h5 truth.csv)
file(READ "${WORK}/truth.csv" rows)
string(REPEAT "-1," 63 missing)
string(FIND "${rows}" "\n" end)
string(SUBSTRING "${rows}" ${end} -1 rows)
file(WRITE "${WORK}/missing.csv" "${missing}-1${rows}")
expect("evaluate it" 0 ERR "missing.csv: the map fits the ground truth far better with -1 taken as no estimate .*; if it is stored so, add --map-missing=-1\n"
       ARGS evaluate missing.csv --truth lf.h5 --json)
json_is("${out}" "--map-missing=-1" results 0 better_reading options)
json_near("${out}" 0 0.0001 results 0 better_reading mse_100)
expect("evaluate it as told" 0 ERR "have no value" ARGS evaluate missing.csv --truth lf.h5 --map-missing=-1 --json)
json_near("${out}" 0 0.0001 results 0 mse_100_present)
json_absent("${out}" results 0 better_reading)
expect("no number" 2 ERR "--map-missing: 'x' is no number; give values between commas"
       ARGS evaluate missing.csv --truth lf.h5 --map-missing=x)

# Of another scene: no reading helps, and both numbers say so. What was estimated from these samples
# is not doubted.
expect("its truth" 0 ARGS convert edge.h5 edge.pfm)
set(little "the map explains little of the ground truth: MSE×100 [0-9.]+ against [0-9.]+ of the best constant map; check its scale, units and view")
expect("evaluate it" 0 ERR "edge.pfm: ${little}\n$" ARGS evaluate edge.pfm --truth lf.h5 --json)
string(JSON note GET "${out}" results 0 notes 0)
if(NOT note MATCHES "^${little}$")
  fail_case("the answer does not tell of a map of another scene:\n${out}")
endif()
json_absent("${out}" results 0 better_reading)
expect("show it" 0 ERR "edge.pfm: ${little}\n" ARGS show edge.pfm --truth lf.h5 -o edge.png)
expect("a poor estimate" 0 ARGS estimate epi_l lf.h5 -o poor.h5 --range 3,4 --views center -q)
expect("evaluate it" 0 ARGS evaluate poor.h5 --truth lf.h5 -q --json)
if(out MATCHES "explains little")
  fail_case("an estimate of these samples is doubted:\n${out}")
endif()

# Resized from another resolution, with the values as they were.
file(MAKE_DIRECTORY "${WORK}/seven")
expect("seven views" 0 ARGS synthesize objects -o seven/lf.h5 --views 7x7 --size 64x64)
expect("their truth as a map" 0 ARGS convert seven/lf.h5 seven.pfm)
foreach(row "2;0.5" "0.5;2")
  list(GET row 0 was)
  list(GET row 1 factor)
  expect("resized, ${was}" 0 ARGS convert seven.pfm resized.npy --map-scale ${was} --overwrite)
  expect("evaluate it, ${was}" 0 ERR "far better" ARGS evaluate resized.npy --truth seven/lf.h5 --json)
  json_is("${out}" "--map-scale=${factor}" results 0 better_reading options)
  json_near("${out}" 0 0.0001 results 0 better_reading mse_100)
endforeach()

# A submission says so in its tables.
file(MAKE_DIRECTORY "${WORK}/theirs" "${WORK}/objects")
file(COPY_FILE "${WORK}/negated.pfm" "${WORK}/theirs/objects.pfm")
file(COPY_FILE "${WORK}/lf.h5" "${WORK}/objects/lf.h5")
set(benchmark benchmark objects --methods epi_l --views center --submission theirs -o tables --json)
expect("benchmark a submission" 0 ERR "objects.pfm: the map fits the ground truth far better"
       ARGS ${benchmark})
if(NOT out MATCHES "objects.pfm: the map fits the ground truth far better with values negated")
  fail_case("the benchmark does not tell of a negated map:\n${out}")
endif()
expect("benchmark it as told" 0 ARGS ${benchmark} --map-scale -1)
if(out MATCHES "far better")
  fail_case("the benchmark tells of a map that is right:\n${out}")
endif()

file(COPY_FILE "${WORK}/edge.pfm" "${WORK}/theirs/objects.pfm")
expect("benchmark a map of another scene" 0 ERR "objects.pfm: ${little}"
       ARGS ${benchmark})

# Oblong views leave no doubt.
file(MAKE_DIRECTORY "${WORK}/wide")
expect("oblong views" 0 ARGS synthesize objects -o wide/lf.h5 --views 3x3 --size 64x48)
expect("their truth" 0 ARGS convert wide wide.pfm)
expect("on its side" 0 ARGS convert wide.pfm tall.npy --map-transpose)
expect("evaluate it" 1 ERR "rows and columns are exchanged; add --map-transpose"
       ARGS evaluate tall.npy --truth wide)
expect("evaluate it as told" 0 ARGS evaluate tall.npy --truth wide --map-transpose --json)
json_near("${out}" 0 0.0001 results 0 mse_100)

expect("options without a map" 2 ERR "--map-flip is for the maps of a RESULT"
       ARGS show lf.h5 -o v.png --map-flip x)
expect("options without a submission" 2 ERR "has no effect without --maps"
       ARGS benchmark lf.h5 -o t --methods epi_l --map-flip x)

# An estimate is no evidence of the order of views.
expect("a negated map as truth" 0 ERR "negated.pfm: the map fits the ground truth far better with values negated"
       ARGS convert negated.pfm as_truth.h5 --truth lf.h5)
expect("the order of its views" 0 ARGS info as_truth.h5 --json)
string(JSON order GET "${out}" order)
if(order MATCHES "truth" OR NOT order MATCHES "as stored")
  fail_case("an estimate decides on the order of views: ${order}")
endif()

# A result that took the place of truth stays a result.
expect("a result as truth" 0 ARGS convert axes.h5 estimated.h5 --truth lf.h5)
expect("info of it" 0 OUT "not ground truth: estimated by axes from lf.h5\n"
       ARGS info estimated.h5)
expect("info of it as JSON" 0 ARGS info estimated.h5 --json)
json_is("${out}" axes truth_estimated method)
expect("evaluate against it" 0 ERR "no ground truth: it was estimated by axes from lf.h5"
       ARGS evaluate truth.pfm --truth estimated.h5)
expect("as a folder" 0 ARGS convert axes.h5 folder/ --truth lf.h5 -q)
expect("info of that" 0 OUT "not ground truth: estimated by axes from ../lf.h5\n" ARGS info folder)
expect("without a slash" 0 ARGS convert axes.h5 folder_too --truth lf.h5 -q)
expect("info of that" 0 OUT "not ground truth: estimated by axes from ../lf.h5\n" ARGS info folder_too)
foreach(name theirs.npz theirs.mat)
  expect("in ${name}" 0 ARGS convert axes.h5 ${name} --truth lf.h5 -q)
  expect("info of ${name}" 0 OUT "not ground truth: estimated by axes from lf.h5\n" ARGS info ${name})
endforeach()
