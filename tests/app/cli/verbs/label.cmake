# Painted strokes become labels of all views: label, show of what it wrote, and what it refuses.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
expect("make a scene" 0 ARGS synthesize objects -o lf.h5 --views 3x3 --size 96x96)
expect("estimate the center" 0 ARGS estimate epi_l lf.h5 -o center.h5 --views center)

expect(label 0 ARGS label lf.h5 --scribbles labels.h5 -o l.h5 --features image+truth
       --regularizer rayspace --write-probabilities --json)
one_shape("${out}" 1 1)
json_is("${out}" 3 labels)
json_is("${out}" l.h5 written 0)
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
set(other label lf.h5 -o l.h5 --features image --regularizer none --trees 8 --write-probabilities)
expect("labels of other parameters" 1 ERR "l.h5: exists and holds labels with --features image.truth.*--overwrite"
       ARGS ${other})
expect("its smoothness by both names" 0 ARGS label lf.h5 -o smooth.h5 --features image --trees 4
       --boundary-cost 7 --quiet)
expect("the earlier name" 0 ARGS label lf.h5 -o smooth.h5 --features image --trees 4 --smoothness 7
       --json)
json_is("${out}" 7.0 parameters smoothness)
expect("label again, over its own result" 0 OUT "3 labels in 9 views.*consistency along rays.*accuracy of all views"
       ARGS ${other} --overwrite)
expect("the same again" 0 ARGS ${other} --quiet)
expect("info of labels" 0 OUT "^labels +1 .*3×3 views of 96×96 px, with probabilities.*parameters +.*features image.*source +lf.h5\nversion"
       ARGS info l.h5)
expect("info of labels as JSON" 0 ARGS info l.h5 --json)
json_is("${out}" labels kind)
json_is("${out}" image parameters features)
json_is("${out}" ON probabilities)
json_is("${out}" lf.h5 source)

foreach(what labels probability uncertainty)
  set(options --view 0,2)
  if(what STREQUAL probability)
    list(APPEND options --label 2)
  endif()
  expect("show ${what}" 0 OUT "${what}, 96×96 px" ARGS show l.h5 -o ${what}.png --what ${what}
         ${options})
  expect_file(${what}.png ${png})
endforeach()
expect("show by default" 0 OUT "labels, 96×96 px" ARGS show l.h5 -o l.png)
expect("show an unknown label" 1 ERR "no label 7; it has 1, 2, 3"
       ARGS show l.h5 -o no.png --what probability --label 7)
expect("show a view that is not there" 1 ERR "view 5,5 was asked for"
       ARGS show l.h5 -o no.png --view 5,5)
expect("show what labels lack" 2 ERR "is a file of labels" ARGS show l.h5 -o no.png --what view)
expect("labels alone" 0 ARGS label lf.h5 -o bare.h5 --features image --regularizer none --trees 8
       --quiet)
file(SIZE "${WORK}/bare.h5" bare)
file(SIZE "${WORK}/l.h5" whole)
if(NOT bare LESS 1000000 OR NOT whole GREATER 1000000)
  fail_case("labels alone take ${bare} bytes, with probabilities ${whole}")
endif()
expect("no probabilities to show" 1 ERR "has no probabilities; label again with --write-probabilities"
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
# What contradicts: another sign, other strokes, other probabilities.
expect("all views" 0 ARGS estimate epi_l lf.h5 -o all.h5 -q)
expect("as a map" 0 ARGS convert all.h5 negated.npy --views all --map-scale -1 -q)
expect("labels by it" 0 ERR "negated.npy: the map fits the ground truth far better with values negated .*add --map-scale=-1 to convert"
       ARGS label lf.h5 -o d.h5 --disparity negated.npy --trees 4 --regularizer none)
expect("another light field" 0 ARGS synthesize bars -o bars.h5 --views 3x3 --size 96x96)
expect("its true labels" 0 ARGS show bars.h5 -o bars.png --what labels)
expect("strokes of another light field" 0 ERR "only [0-9.]+ % of the painted pixels have that label in GT_LABELS"
       ARGS label lf.h5 --scribbles bars.png -o d2.h5 --features image --trees 4 --regularizer none)
expect("probabilities" 0 ARGS label lf.h5 -o p.h5 --features image --trees 4 --regularizer none
       --write-archive probabilities -q)
expect("of these labels" 0
       ARGS label lf.h5 -o p2.h5 --probabilities probabilities/feature_single_view_probabilities.h5 --regularizer view)

expect("an unknown set" 2 ERR "features" ARGS label lf.h5 -o no.h5 --features color)
expect("truth and a result" 2 ERR "no effect"
       ARGS label lf.h5 -o no.h5 --features image+truth --disparity l.h5)

# Masks and files of the archive do not tell what they were made by.
set(folders label lf.h5 --features image --regularizer none --trees 4 -q)
expect("masks" 0 ARGS ${folders} -o m.h5 --write-masks masks)
expect("other masks" 1 ERR "masks/labels.txt: exists and does not tell what it was made by; .*--overwrite"
       ARGS ${folders} -o n.h5 --seed 2 --write-masks masks)
expect("other masks as told" 0 ARGS ${folders} -o n.h5 --seed 2 --write-masks masks --overwrite)
file(MAKE_DIRECTORY "${WORK}/archive")
file(WRITE "${WORK}/archive/edge_weights.h5" "of others")
expect("the archive's own" 1 ERR "edge_weights.h5: exists and does not tell" ARGS ${folders} -o a.h5
       --write-archive archive)

# Drawings in colors: a label is a color, and what is not painted is said.
expect("draw the labels" 0 ARGS show lf.h5 -o drawing.png --what labels)
expect("strokes in colors" 0 ERR "note: drawing.png: a label is a color: 1 = #.*, 2 = #.*, 3 = #.*\nnote: drawing.png: .*(unpainted|every pixel is painted)"
       ARGS label lf.h5 --scribbles drawing.png -o drawn.h5 --features image --regularizer none
       --trees 8 --json)
json_is("${out}" 3 labels)
json_near("${out}" 0.8 1 accuracy_center)
file(WRITE "${WORK}/empty.csv" "r,g,b,id,name\n")
expect("an empty table" 1 ERR "empty.csv: has no line r,g,b,id,name"
       ARGS label lf.h5 --scribbles drawing.png --colors empty.csv -o no.h5)
expect("a table without pictures" 2 ERR "--colors has no effect"
       ARGS label lf.h5 --colors empty.csv -o no.h5)
file(WRITE "${WORK}/one.csv" "1,2,3,4,nothing\n")
expect("a table that lacks colors" 1 ERR "drawing.png: has [0-9]+ px of the color #[0-9a-f]+ .*which the table of colors lacks"
       ARGS label lf.h5 --scribbles drawing.png --colors one.csv -o no.h5)
expect("a view in colors" 0 ARGS show lf.h5 -o view.png)
expect("a photograph" 1 ERR "view.png: has .*[0-9]+ colors, but labels have one each"
       ARGS label lf.h5 --scribbles view.png -o no.h5)

# Labels of other tools, there and back: as true labels, and in each form.
foreach(form labels voc coco labelme)
  expect("labels as ${form}" 0 ARGS convert lf.h5 as_${form} --to ${form} -q)
  expect("labels of ${form}" 0 ARGS convert lf.h5 of_${form}.h5 --labels as_${form} -q)
  expect("scores of ${form}" 0 ARGS label of_${form}.h5 --scribbles labels.h5 -o s_${form}.h5 --features image
         --regularizer none --trees 4 --json)
  string(JSON accuracy GET "${out}" accuracy_center)
  list(APPEND accuracies ${accuracy})
endforeach()
list(REMOVE_DUPLICATES accuracies)
list(LENGTH accuracies count)
if(NOT count EQUAL 1)
  fail_case("labels of the forms are not the same: accuracies ${accuracies}")
endif()
expect("a folder that is in use" 1 ERR "as_coco" ARGS convert lf.h5 as_coco --to coco)
expect("segmented labels" 0 ARGS convert l.h5 segmented_coco --to coco --truth lf.h5 --json)
if(NOT EXISTS "${WORK}/segmented_coco/images/00_00.png")
  fail_case("the views of labels are not written")
endif()
expect("labels of a map" 2 ERR "--labels is for a light field" ARGS convert lf.h5 m.pfm --labels as_labels)
expect("colors of own labels" 2 ERR "--colors has no effect on labels.h5, which states what"
       ARGS label lf.h5 --scribbles labels.h5 --colors one.csv -o no.h5)
expect("ignored ids of own labels" 2 ERR "--ignore has no effect on l.h5"
       ARGS convert lf.h5 no.h5 --labels l.h5 --ignore 2)
file(COPY "${WORK}/l.h5" DESTINATION "${WORK}/alone")  # no light field beside it
expect("labels as a light field" 1 ERR "l.h5: holds labels and no light field; name it with --labels"
       ARGS estimate epi_l alone/l.h5 -o no.h5)
expect("labels as a result" 1 ERR "l.h5: holds labels and no disparity; .* convert --to labels"
       ARGS evaluate l.h5 --truth lf.h5)
expect("ids that are none" 2 ERR "--ignore is 'x'" ARGS convert lf.h5 m.h5 --labels as_labels --ignore x)
expect("options of labels" 2 ERR "--ignore has no effect without --labels" ARGS convert lf.h5 m.h5 --ignore 255)
expect("0 as a label" 0 ERR "raised by one" ARGS convert lf.h5 z.h5 --labels as_labels --first-label 0)
expect("a picture of labels" 0 ARGS show l.h5 -o first.png --view 1,1)
expect("0 as the first color" 0 ERR "A first label of 0 has no effect on colors"
       ARGS label lf.h5 --scribbles first.png --first-label 0 -o colors_first.h5 --features image)
expect("computed labels as true ones" 0 ERR "" ARGS convert lf.h5 computed.h5 --labels l.h5)
expect("info of them" 0 OUT "labels +[1-9].*not ground truth: estimated by label from lf.h5\n"
       ARGS info computed.h5)
expect("info of them as JSON" 0 ARGS info computed.h5 --json)
json_is("${out}" label labels_estimated method)
expect("a form that cannot say so" 0 ERR "how labels were computed" ARGS convert computed.h5 computed/)
expect("an ignored id" 0 ERR "1 \\(.* % of the pixels\\) is taken for unlabeled"
       ARGS convert lf.h5 i.h5 --labels as_labels --ignore 1)
