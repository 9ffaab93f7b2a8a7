# Wrong usage of every verb: exit code 2, one sentence, nothing on standard output, no file.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
file(MAKE_DIRECTORY "${WORK}/scene")
expect("make a light field" 0 ARGS synthesize objects -o scene/lf.h5 --views 3x3 --size 48x48)
expect("make a result" 0 ARGS estimate epi_l scene -o r.h5 --views center)
expect("make a map" 0 ARGS convert r.h5 r.pfm)
expect("make labels" 0 ARGS label scene -o l.h5 --features image)
expect("make pictures" 0 ARGS convert scene pictures --to grid -q)

# A command line each, which writes to `out` if it writes at all.
set(table
  "estimate"
  "estimate epi_l"
  "estimate epi_l scene"
  "estimate nothing scene -o out.h5"
  "estimate epi_l scene -o out.h5 --nothing"
  "estimate epi_l scene -o out.h5 --threads -1"
  "estimate epi_l scene -o out.h5 --memory 0"
  "estimate epi_l scene -o out.h5 --range 5"
  "estimate epi_l scene -o out.h5 --crop 0x0"
  "estimate epi_l scene -o out.h5 --levels 3,1"
  "estimate epi_l scene -o out.h5 --axes vuq"
  "estimate epi_l pictures -o out.h5 --pattern view.png"
  "estimate epi_l scene -o out.h5 --frame -3"
  "estimate kz02 scene -o out.h5 --views all"
  "estimate epi_l scene -o out.pfm --views all"
  "estimate epi_l scene -o out.pfm --compress"
  "estimate epi_l scene -o out.ply"
  "estimate epi_l scene r.h5 -o out.npy"
  "estimate epi_l scene -o out --submission --views all"
  "estimate epi_l demo:nothing -o out.h5"
  "evaluate"
  "evaluate r.pfm"
  "evaluate r.h5 --view 1"
  "evaluate r.h5 --invalid maybe"
  "evaluate r.h5 --overwrite"
  "evaluate r.h5 --metrics ,"
  "evaluate r.h5 --metrics nothing -q"
  "evaluate r.h5 --map-scale 0"
  "evaluate r.h5 --map-border -1"
  "evaluate r.h5 --truth demo:nothing"
  "evaluate r.h5 --json --latex"
  "show"
  "show scene"
  "show scene -o out.png --label 0"
  "show scene -o out.png --map-transpose"
  "show scene -o out.png --threshold 2"
  "show scene -o out.png --fit -1"
  "show scene -o out.gif --movie flip --what epi"
  "show r.pfm -o out.png --what error"
  "show r.pfm -o out.png --over-view 0.5"
  "show r.h5 -o - --json"
  "convert"
  "convert scene"
  "convert scene out.mp4"
  "convert scene out.npz --to grid --views center"
  "convert scene out.h5 --values depth"
  "convert scene out.npz --gt-disparity"
  "convert scene out.npz --repack"
  "convert scene out.npz --map-transpose"
  "convert scene out.png --to map"
  "convert r.pfm out.h5"
  "label"
  "label scene"
  "label scene -o out.png"
  "label scene -o out.h5 --features nothing"
  "label scene -o out.h5 --colors colors.csv"
  "label scene -o out.h5 --features image+truth --disparity r.h5"
  "label scene -o out.h5 --write-probabilities --no-probabilities"
  "label demo:nothing -o out.h5"
  "synthesize"
  "synthesize edge"
  "synthesize nothing -o out.h5"
  "synthesize edge -o out.npz"
  "synthesize edge -o out.h5 --seed -1"
  "synthesize edge -o out.h5 --grid 0x3"
  "synthesize gantry -o out --overwrite"
  "decode"
  "decode raw.png"
  "decode raw.png -o out.png"
  "decode raw.png -o out.h5 --views 8"
  "decode raw.png -o out.h5 --mosaic rgbg"
  "calibrate"
  "calibrate pictures/input_Cam000.png -o out.yml"
  "calibrate pictures/input_Cam000.png --pattern 9 -o out.yml"
  "calibrate pictures/input_Cam000.png --board 9x2 -o out.yml"
  "calibrate pictures/input_Cam000.png --pattern 9x6 --kind cube -o out.yml"
  "rectify pictures"
  "rectify pictures --camera c.yml -o out.png"
  "rectify pictures --camera c.yml -o out.h5 --step 0"
  "rectify pictures --camera c.yml -o out.h5 --picks picks.csv"
  "pose scene"
  "pose scene --mesh m.ply --pairs pairs.csv"
  "ground-truth scene -o out.h5"
  "ground-truth scene --pose pose.json"
  "ground-truth scene --pose pose.json -o out.png"
  "ground-truth scene --pose pose.json -o out.h5 --step -1"
  "validate"
  "validate scene pictures"
  "validate scene --size 5"
  "validate scene --scenes"
  "methods nothing"
  "methods epi_l --device cpu"
  "list"
  "list --json"
  "list scene --nothing"
  "info"
  "info scene r.h5"
  "info scene --grid 3"
  "info r.h5 --flip u"
  "info l.h5 --flip u"
  "info demo:nothing"
  "benchmark"
  "benchmark scene"
  "benchmark scene -o out --methods nothing"
  "benchmark scene -o out --methods ,"
  "benchmark scene -o out --features image"
  "benchmark scene -o out --labels --features nothing"
  "benchmark scene -o out --labeling --profile paper"
  "benchmark scene -o out --task-seconds 3"
  "benchmark scene -o out --point -1"
  "benchmark scene -o out --point 1 --collect"
  "benchmark scene -o out --map-transpose"
  "benchmark scene -o out --plan"
  "benchmark -o out --collect --methods epi_l"
  "help nothing"
  "nothing")
foreach(line IN LISTS table)
  separate_arguments(arguments UNIX_COMMAND "${line}")
  expect("wrong usage" 2 ARGS ${arguments})
endforeach()
expect_files(. l.h5 pictures r.h5 r.pfm scene)

# The table has every verb.
run_cli(--help)
string(REGEX MATCHALL "\n  [a-z][a-z-]* " found "${out}")
foreach(entry IN LISTS found)
  string(STRIP "${entry}" verb)
  if(NOT verb STREQUAL "episcope-cli" AND NOT table MATCHES "(^|;)${verb} ?")
    fail_case("no wrong usage of ${verb} is tried")
  endif()
endforeach()

# An option has one meaning; earlier names of others still work, and help does not list them.
expect("earlier names" 0 ARGS synthesize edge -o old.h5 --views 3x3 --size 48x48 --noise=2 --seed 5)
expect("present names" 0 ARGS synthesize edge -o new.h5 --grid 3x3 --size 48x48 --noise-sigma 2 --seed 5)
foreach(file old new)
  expect("a row of ${file}" 0 ARGS show ${file}.h5 -o ${file}.png --row 20)
  file(SHA256 "${WORK}/${file}.png" of_${file})
endforeach()
if(NOT of_old STREQUAL of_new)
  fail_case("an earlier name means something else")
endif()
expect("earlier names of benchmark" 2 ERR "--scribble-folder has no effect without --labeling"
       ARGS benchmark scene -o out --scribbles strokes)
expect("an earlier flag" 2 ERR "--profile has no effect" ARGS benchmark scene -o out --labels --profile paper)
expect("earlier maps" 2 ERR "--search has no effect" ARGS benchmark scene -o out --submission theirs --search)
expect("an earlier board" 2 ERR "--board is 9x2" ARGS calibrate pictures/input_Cam000.png --pattern 9x2 -o c.yml)
foreach(pair calibrate=--pattern synthesize=--views synthesize=--noise benchmark=--labels benchmark=--submission
             benchmark=--scribbles)
  string(REPLACE "=" ";" pair "${pair}")
  list(GET pair 0 verb)
  list(GET pair 1 option)
  expect("help of ${verb}" 0 ARGS help ${verb})
  if(out MATCHES "\n  ${option}[ \n]")
    fail_case("help of ${verb} lists ${option}, which is an option of another meaning elsewhere")
  endif()
endforeach()
