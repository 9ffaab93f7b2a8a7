# `show` writes movies: of the views, of maps over them, of the focus plane, of two results in turns.
include("${CMAKE_CURRENT_LIST_DIR}/../cli_support.cmake")
expect(synthesize 0 ARGS synthesize objects -o lf.h5 --views 5x5 --size 48x40)
expect(all_views 0 ARGS estimate epi_l lf.h5 -o all.h5 --quiet)
expect(center 0 ARGS estimate st_ch_l lf.h5 -o center.h5 --quiet)

expect(parallax 0 OUT "a.mp4: parallax, 16 pictures in 3.0 s"
       ARGS show lf.h5 -o a.mp4 --what parallax --quiet)
expect_file(a.mp4)
expect(by_name 0 OUT "b.gif: view, 8 pictures in 2.0 s"
       ARGS show lf.h5 -o b.gif --path swing --seconds 2 --quiet)
expect_file(b.gif 474946383961)
expect(refocus 0 OUT "c.webm: refocus, 12 pictures in 1.0 s"
       ARGS show lf.h5 -o c.webm --what refocus --seconds 1 --width 96 --quiet)
expect_file(c.webm 1a45dfa3)
expect(map 0 OUT "d.gif: disparity, 16 pictures"
       ARGS show all.h5 -o d.gif --over-view 0.5 --quiet)
expect(one_view 1 ERR "none of the views along the path has such a picture" ARGS show center.h5 -o e.gif --what error --quiet)
expect(flip 0 OUT "f.gif: flip, 2 pictures in 3.0 s"
       ARGS show all.h5 -o f.gif --movie flip --minus center.h5 --quiet)
expect(images 0 OUT "frames: view, 48 pictures"
       ARGS show lf.h5 -o frames --movie parallax --path snake --quiet)
expect_file(frames/frame_0000.png 89504e47)
expect_file(frames/frame_0047.png 89504e47)
file(MAKE_DIRECTORY "${WORK}/empty")
foreach(folder empty/ named/)
  expect("images into ${folder}" 0 ARGS show lf.h5 -o ${folder} --movie parallax --seconds 1 --quiet)
  expect_file(${folder}frame_0000.png 89504e47)
endforeach()
expect("no images among others" 1 ERR "holds other files" ARGS show lf.h5 -o empty --movie parallax)

expect(as_png 2 ERR "a movie cannot be written as PNG" ARGS show lf.h5 -o a.png --what parallax)
expect(unknown_form 2 ERR "writes PNG and movies" ARGS show lf.h5 -o a.mkv --what parallax)
expect(epi 2 ERR "no movie of it" ARGS show lf.h5 -o a.mp4 --what epi)
expect(alone 2 ERR "--minus RESULT" ARGS show all.h5 -o a.mp4 --movie flip)
expect(no_view 1 ERR "only the view of a light field can be refocused"
       ARGS show all.h5 -o a.mp4 --movie refocus)
