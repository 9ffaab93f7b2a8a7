# A light field from its making to its judgement: synthesize, info, estimate, evaluate, show,
# convert, in a folder with a space and an umlaut.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
set(folder "Gerät 1")
file(MAKE_DIRECTORY "${WORK}/${folder}")
set(lf "${folder}/lf.h5")
set(result "${folder}/ergebnis ä.h5")

expect(synthesize 0 OUT "objects, 5×5 views of 64×48 px"
       ARGS synthesize objects -o "${lf}" --views 5x5 --size 64x48 --noise 1 --seed 7)
expect_files("${folder}" lf.h5 labels.h5)
expect_file("${lf}" ${hdf5})
expect("synthesize again, same seed" 0 ARGS synthesize objects -o again.h5 --views 5x5
       --size 64x48 --noise 1 --seed 7)
expect("synthesize, other seed" 0 ERR "scribbles are in other.h5 itself" ARGS synthesize objects -o other.h5 --views 5x5 --size 64x48
       --noise 1 --seed 8)

expect(info 0 OUT "5×5 views of 64×48 px" ARGS info "${folder}")
expect("info of the file" 0 OUT "truth +disparity of all views" ARGS info "${lf}")
expect("info as JSON" 0 ARGS info "${lf}" --json)
json_is("${out}" 5 views v)
json_is("${out}" 64 width)
json_is("${out}" 48 height)
json_is("${out}" uint8 sample_type)
json_is("${out}" all truth views)
json_is("${out}" 100.0 truth valid_percent)
json_near("${out}" 1 100 labels ids 0)
json_is("${out}" 2 scribbles view 0)
json_near("${out}" 0.1 99 scribbles painted_percent)
json_is("${out}" discontinuities regions 0)
string(JSON order ERROR_VARIABLE problem GET "${out}" order)
if(NOT order)
  fail_case("info does not tell the order: ${out}")
endif()

expect(estimate 0 ARGS estimate epi_l "${lf}" -o "${result}" --json --threads 1 --range -4,4
       --inner_scale 0.7)
json_is("${out}" epi_l method)
json_is("${out}" all views)
json_near("${out}" 0.0001 60 seconds)
json_near("${out}" 1 2000 peak_mib)
json_is("${out}" -4.0 parameters range 0)
json_near("${out}" 0.6999 0.7001 parameters inner_scale)
json_is("${out}" "${result}" output)
json_near("${out}" -4 0 range 0)
expect_file("${result}" ${hdf5})
expect("estimate of the center" 0 OUT "center.h5: epi_l of the center view"
       ARGS estimate epi_l "${lf}" -o center.h5 --views=center)
expect("estimate smoothly" 0 ARGS estimate epi_s "${lf}" -o smooth.h5 --quiet)
expect("evaluate two methods" 0 OUT "^file,[^\n]+\n[^\n]*epi_l,[^\n]+\n[^\n]*epi_s,[^\n]+\n$"
       ARGS evaluate "${result}" smooth.h5 --truth "${lf}" --csv)

# What is baked in gets lost from every disparity, and the error stays what it was.
expect("estimate with a focus plane" 0 ARGS estimate epi_l "${lf}" -o focus.h5 --json --focus 0.5
       --views=center --range -4.5,3.5)
expect("info with a focus plane" 0 OUT "focus +a plane of 0.5 px" ARGS info "${lf}" --focus 0.5)
expect("a focus plane out of the picture" 1 ERR "out of the image" ARGS info "${lf}" --focus 50)

expect(evaluate 0 OUT "mse_100 +[0-9.]+\nmse_100_inset15 +[0-9.]+\ndensity +[0-9.]+\n.*runtime_class +fast\nall_views +yes\n"
       ARGS evaluate "${result}" --truth "${lf}")
expect("evaluate by vmv2013" 0 ARGS evaluate "${result}" --truth "${lf}" --json)
json_is("${out}" vmv2013 protocol)
json_is("${out}" "${result}" results 0 file)
json_is("${out}" epi_l results 0 method)
json_is("${out}" fast results 0 runtime_class)
json_is("${out}" ON results 0 all_views)
json_near("${out}" 0.0001 1000 results 0 mse_100)
json_absent("${out}" results 0 badpix_0070)
expect("evaluate by benchmark2016" 0 ARGS evaluate "${result}" center.h5 --truth "${lf}" --json
       --protocol benchmark2016 --error-map error.png)
json_near("${out}" 0.0001 100 results 0 badpix_0010)
json_near("${out}" 0 100 results 1 badpix_0070)
json_near("${out}" 0 1000 results 1 q_25_100)
json_is("${out}" OFF results 1 all_views)
json_absent("${out}" results 0 mse_100_inset15)
json_absent("${out}" results 0 fine_thinning_0150)
expect_file("error-ergebnis ä.png" ${png})
expect_file("error-center.png" ${png})
expect("evaluate as CSV" 0 OUT "^file,method,mse_100,mse_100_inset15,density,seconds,runtime_class,all_views\n[^\n]+,fast,yes\n$"
       ARGS evaluate "${result}" --truth "${lf}" --csv)
expect("evaluate as LaTeX" 0 OUT "tabular.*mse\\\\_100.*runtime\\\\_class & all\\\\_views.*epi\\\\_l.*fast & yes.*bottomrule"
       ARGS evaluate "${result}" --truth "${lf}" --latex)
expect("evaluate against other samples" 0 ERR "^note: [^\n]*other samples" OUT "mse_100"
       ARGS evaluate "${result}" --truth other.h5)
expect("evaluate against equal samples" 0 OUT "mse_100"
       ARGS evaluate "${result}" --truth again.h5)

foreach(what view epi disparity labels edges)
  expect("show ${what} of a light field" 0 OUT "^lf-${what}.png: ${what}"
         ARGS show "${lf}" -o lf-${what}.png --what ${what})
  expect_file(lf-${what}.png ${png})
endforeach()
foreach(what disparity error confidence view epi labels edges)
  expect("show ${what} of a result" 0 ARGS show "${result}" -o r-${what}.png --what ${what})
  expect_file(r-${what}.png ${png})
endforeach()
expect("show a row" 0 OUT "epi, 64×40 px" ARGS show "${lf}" -o row.png --what epi --row 3)
expect("show a column" 0 OUT "epi, 40×48 px" ARGS show "${lf}" -o c.png --what epi --column 63)
expect("show another view" 0 ARGS show "${result}" -o v.png --view 0,4 --range -1.5,2
       --colormap turbo)
expect("show a negative range" 0 ARGS show "${result}" -o v2.png --range -.5,-.25)
file(SHA256 "${WORK}/r-view.png" of_result)
file(SHA256 "${WORK}/lf-view.png" of_light_field)
if(NOT of_result STREQUAL of_light_field)
  fail_case("the view differs between a light field and a result of it")
endif()

foreach(suffix pfm tiff npy ply)
  expect("convert a result to ${suffix}" 0 ARGS convert "${result}" r.${suffix})
  expect_file(r.${suffix})
  if(NOT suffix STREQUAL "npy")
    expect("convert the truth to ${suffix}" 0 ARGS convert "${lf}" t.${suffix})
    expect_file(t.${suffix})
  endif()
endforeach()
expect("evaluate the truth" 0 ARGS evaluate t.pfm t.tiff --truth "${lf}" --json)
foreach(row 0 1)
  json_is("${out}" 0.0 results ${row} mse_100)
  json_is("${out}" 100.0 results ${row} density)
endforeach()
expect("evaluate an array" 0 ARGS evaluate r.npy r.pfm --truth "${lf}" --json)
string(JSON of_npy GET "${out}" results 0 mse_100)
string(JSON of_pfm GET "${out}" results 1 mse_100)
if(NOT of_npy STREQUAL of_pfm)
  fail_case("a map has MSE ${of_pfm} as PFM, but ${of_npy} as .npy")
endif()
expect("evaluate a PFM" 0 ARGS evaluate "${result}" r.pfm --truth "${lf}" --json)
string(JSON of_result GET "${out}" results 0 mse_100)
string(JSON of_pfm GET "${out}" results 1 mse_100)
if(NOT of_result STREQUAL of_pfm)
  fail_case("a result has MSE ${of_result}, but ${of_pfm} as PFM")
endif()

expect("convert to the benchmark form" 0
       ERR "^note: The benchmark form holds labels of the center view only; those of the others are left out.\nnote: The benchmark form holds no scribbles; they are left out.\n$"
       ARGS convert "${lf}" bench/)
expect_file(bench/input_Cam024.png ${png})
expect("info of the benchmark form" 0 OUT "5×5 views of 64×48 px" ARGS info bench)
expect("evaluate against the benchmark form" 0 ARGS evaluate t.pfm --truth bench --json)
json_near("${out}" 0 0.0001 results 0 mse_100)
expect("convert to the archive form" 0 ARGS convert bench back.h5)
expect("evaluate against the archive form" 0 ARGS evaluate t.pfm --truth back.h5 --json)
# Disparity went through depth in float: 1e-6 px, squared and times 100.
json_near("${out}" 0 0.0001 results 0 mse_100)
expect("convert to a grid of images" 0 ERR "note: A grid of images holds no camera"
       ARGS convert "${lf}" views --to grid)
expect_file(views/02_04.png ${png})
foreach(suffix npy npz mat)
  expect("convert to .${suffix}" 0 ERR "^note: The .${suffix} form holds no camera; it is left out."
         ARGS convert "${lf}" lf.${suffix})
  expect("not over another file" 1 ERR "lf.${suffix}: exists; .*--overwrite"
         ARGS convert "${lf}" lf.${suffix})
  expect("but where it is asked for" 0 ARGS convert "${lf}" lf.${suffix} --overwrite --quiet)
  expect("info of that" 0 OUT "5×5 views of 64×48 px" ARGS info lf.${suffix})
endforeach()
expect("convert to a quilt" 0 ERR "row 2 is written, the others are left out"
       ARGS convert "${lf}" quilt_qs5x1a1.333.png)
expect("info of the quilt" 0 OUT "quilt of 1×5 tiles.*1×5 views of 64×48 px" ARGS info quilt_qs5x1a1.333.png)
expect("convert to a quilt of another name" 0 ERR "name it plain_qs" ARGS convert "${lf}" plain.png --to quilt)
expect("repack" 0 OUT "whole.h5: written" ARGS convert "${lf}" whole.h5 --repack)
expect("info of what was repacked" 0 OUT "5×5 views of 64×48 px.*truth +disparity of all views"
       ARGS info whole.h5)
expect("repack again" 1 ERR "--overwrite" ARGS convert "${lf}" whole.h5 --repack)

expect("convert to lenslets" 0 ERR "picture of lenslets holds no disparities"
       ARGS convert "${lf}" lf_eslf.png)
expect("info of that" 0 OUT "5×5 views of 64×48 px" ARGS info lf_eslf.png --mosaic lenslets
       --grid 5x5)
expect("convert by the name of a form" 0 ARGS convert "${lf}" named.hdf5 --to archive)
expect("info of that" 0 OUT "truth +disparity of all views" ARGS info named.hdf5)
expect("convert into a file of another form" 2 ERR "archive writes a file [*].h5, but .*named.pfm"
       ARGS convert "${lf}" named.pfm --to archive)
expect("convert to an unknown form" 2 ERR "'archive'" ARGS convert "${lf}" named.h5 --to archiv)
expect("info with a pattern that means nothing" 0 OUT "warning +--pattern[^\n]*ignored"
       ARGS info "${lf}" --pattern "{row}_{col}.png")
expect("info of a built-in scene with a flip" 0 OUT "warning +[^\n]*ignored"
       ARGS info demo:fronto --flip u)
expect("convert with a flip" 0 ERR "^note: [^\n]*chosen by hand[^\n]*\n$"
       ARGS convert "${lf}" flipped.h5 --flip u)

# A result finds its light field from any folder, and after both have moved together.
file(MAKE_DIRECTORY "${WORK}/moved")
file(RENAME "${WORK}/${folder}" "${WORK}/moved/folder")
expect("show the error after a move" 0
       ARGS show "moved/folder/ergebnis ä.h5" -o moved/error.png --what error)
file(STRINGS "${WORK}/moved/folder/ergebnis ä.h5" paths REGEX "/round_trip/")
if(paths)
  fail_case("the result holds an absolute path: ${paths}")
endif()

expect(methods 0 OUT "epi_l +EPI_L.*--range" ARGS methods)
expect("methods as JSON" 0 ARGS methods --json)
json_is("${out}" epi_l methods 0 id)
json_is("${out}" ON methods 0 all_views)
string(JSON count LENGTH "${out}" methods 0 parameters)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  foreach(key key help unit default)
    string(JSON value ERROR_VARIABLE problem GET "${out}" methods 0 parameters ${i} ${key})
    if(problem)
      fail_case("a parameter lacks ${key}: ${problem}")
    endif()
  endforeach()
endforeach()
