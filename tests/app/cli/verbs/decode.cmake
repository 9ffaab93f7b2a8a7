# From a raw picture of a plenoptic camera to a light field, as its readme.txt says; bad input.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")

expect("expose" 0 OUT "raw picture" ARGS synthesize edge --camera f01 --size 480x360 -o f01)
expect("decode" 0 ERR "MOD_0001.RAW .*nearest of 2" OUT "hexagonal lenses: pitch 10.02"
       ARGS decode f01/raw.lfp --white f01/calibration -o lf.h5)
expect("what the camera said" 0 OUT "decoded from raw.lfp.*serial A000000001.*zoom step 600"
       ARGS info lf.h5)
expect("samples and sign are kept" 0 OUT "uint16, gamma-encoded.*sign +checked" ARGS info lf.h5)
expect("linear" 0 ERR "--mosaic is ignored" OUT "linear samples" ARGS decode f01/raw.lfp --white
       f01/calibration --linear --mosaic GRBG -o linear.h5)
expect("linear is kept" 0 OUT "uint16, linear" ARGS info linear.h5)
expect("conversion" 0 OUT "written" ERR "dark" ARGS convert linear.h5 converted.h5)
expect("a conversion keeps what is stated" 0 OUT "decoded from.*uint16, linear.*sign +checked"
       ARGS info converted.h5)
expect("again" 1 ERR "--overwrite" ARGS decode f01/raw.lfp -o lf.h5)
expect("as JSON" 0 ERR "nearest of 2" ARGS decode f01/raw.lfp --white f01/calibration --views 5
       -o five.h5 --json)
json_is("${out}" 5 views u)
json_is("${out}" hexagonal lattice)
json_near("${out}" 9.9 10.1 pitch_px)
json_is("${out}" "600" camera "zoom step")
expect("expose an Illum" 0 ARGS synthesize edge --camera illum --size 640x480 -o illum -q)
expect("a container with its white picture is a light field" 0
       OUT "decoded from raw.lfr.*serial B5000000001" ARGS info illum/raw.lfr)

expect("expose a square array" 0 ARGS synthesize edge --camera square --size 480x360 -o square -q)
expect("pictures beside" 0 ERR "white picture raw_white.png" OUT "square lenses" ARGS decode
       square/raw.png -o square.h5)
file(SIZE "${WORK}/f01/raw.lfp" bytes)
math(EXPR half "${bytes} / 2")
execute_process(COMMAND head -c ${half} "${WORK}/f01/raw.lfp" OUTPUT_FILE "${WORK}/cut.lfp")
expect("cut off" 1 ERR "cut.lfp: section 4 .*the file is cut off" ARGS decode cut.lfp -o cut.h5)
expect("white of another camera" 1 ERR "mosaic gray, but the raw picture raw.lfp has bggr" ARGS decode f01/raw.lfp --white
       square/raw_white.png -o other.h5)
expect("no lenses" 1 ERR "no array of microlenses" ARGS decode square/raw_dark.png -o none.h5
       -q)
expect("white picture twice" 1 ERR "the white picture raw.png is the same picture as raw.png" ARGS
       decode square/raw.png --white square/raw.png -o none.h5)
expect("not there" 1 ERR "gone.png" ARGS decode gone.png -o none.h5)
expect("a sensor too small" 2 ERR "--size is 100x100" ARGS synthesize edge --camera f01 --size 100x100
       -o small)
expect("no effect" 2 ERR "--grid has no effect with --camera" ARGS synthesize edge --camera f01
       --grid 3x3 -o small)

# A processed container, as bytes: a table and a depth map of 2×2 px.
file(WRITE "${WORK}/depth" "AAAABBBBCCCCDDDD")
file(SHA1 "${WORK}/depth" depth)
file(WRITE "${WORK}/table" "{\"picture\":{\"frameArray\":[{\"frame\":{}}],\"width\":2,\"height\":2,\"depthMap\":{\"imageRef\":\"sha1-${depth}\"}}}")
file(SHA1 "${WORK}/table" table)
file(SIZE "${WORK}/table" bytes)
execute_process(COMMAND sh -c "z='\\0\\0\\0\\0'; z35=\"$z$z$z$z$z$z$z$z\\0\\0\\0\"
  section() { printf \"\\211LF$1\\r\\n\\032\\n$z\\0\\0\\0$(printf '\\\\%03o' $2)sha1-$3$z35\"; cat $4; }
  { printf \"\\211LFP\\r\\n\\032\\n\\0\\0\\0\\1$z\"
    section M ${bytes} ${table} table; head -c $(( (16 - ${bytes} % 16) % 16 )) /dev/zero
    section C 16 ${depth} depth; } > a-dm.lfp"
  WORKING_DIRECTORY "${WORK}")
expect("a processed container is a picture" 0 OUT "1×1.*note.*depthMap of 2×2 px" ARGS info a-dm.lfp)
expect("it has no light field" 2 ERR "depthMap of 2×2 px.*new folder" ARGS decode a-dm.lfp -o a.h5)
expect("its files" 0 OUT "depthMap of 2×2 px.*processed/depthMap.pfm" ERR "--views is ignored"
       ARGS decode a-dm.lfp --views 3 -o processed)
if(NOT EXISTS "${WORK}/processed/depthMap.pfm")
  message(FATAL_ERROR "no depth map was written")
endif()
