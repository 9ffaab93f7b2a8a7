# SPDX-License-Identifier: BSD-3-Clause
import numpy
import pytest

import episcope


def test_exceptions_are_those_of_python_too():
    assert issubclass(episcope.InvalidInput, (episcope.Error, ValueError))
    assert issubclass(episcope.InvalidInput, ValueError)
    assert issubclass(episcope.IoError, episcope.Error) and issubclass(episcope.IoError, OSError)
    assert issubclass(episcope.Unavailable, episcope.Error) and issubclass(episcope.Unavailable, RuntimeError)


def test_missing_file_is_an_io_error(tmp_path):
    with pytest.raises(episcope.IoError, match="no_such.h5: "):
        episcope.open(tmp_path / "no_such.h5")


def test_unknown_scene_names_the_nearest():
    with pytest.raises(episcope.Unavailable, match="edge"):
        episcope.demo("egde")


def test_unknown_method_names_the_nearest(scene):
    with pytest.raises(episcope.Unavailable, match="plane_pm"):
        episcope.estimate(scene, "plane_pn")


@pytest.mark.parametrize(
    "parameters, sentence",
    [
        ({"outer_scal": 1}, "did you mean 'outer_scale'"),
        ({"outer_scale": -1}, "outer_scale is -1, but must be a number from"),
        ({"outer_scale": "wide"}, "outer_scale"),
        ({"range": (2, 1)}, "range"),
        ({"views": "some"}, "some"),
        ({"device": "tpu"}, "tpu"),
    ],
)
def test_bad_parameter_says_what_is_possible(scene, parameters, sentence):
    with pytest.raises(episcope.InvalidInput, match=sentence):
        episcope.estimate(scene, "epi_l", **parameters)


def test_unknown_reading_option_names_the_nearest():
    with pytest.raises(episcope.InvalidInput, match="did you mean 'flip'"):
        episcope.open("demo:edge?size=48&grid=3", flpi="u")


@pytest.mark.parametrize("map", [numpy.zeros((3, 64, 64)), numpy.zeros((64,)), 1.0])
def test_map_of_another_shape_is_refused(scene, map):
    with pytest.raises(episcope.InvalidInput, match="the maps have the shape"):
        episcope.score(map, scene)


def test_map_of_another_size_is_refused(scene):
    with pytest.raises(episcope.InvalidInput):
        episcope.score(numpy.zeros((32, 32)), scene)


def test_light_field_without_truth_is_not_judged(scene):
    bare = episcope.LightField(scene.views)
    with pytest.raises(episcope.InvalidInput, match="no true disparity"):
        episcope.score(numpy.zeros((64, 64)), bare)


def test_array_of_texts_is_refused(scene):
    with pytest.raises(episcope.InvalidInput, match="array of numbers is expected for the maps, not of <U1"):
        episcope.score(numpy.array([["a"]]), scene)
    with pytest.raises(episcope.InvalidInput, match="light field has whole numbers or floats"):
        episcope.LightField(numpy.full((3, 3, 8, 8, 3), "a"))


@pytest.mark.parametrize(
    "map, truth, sentence",
    [
        (None, None, "expected for the truth, not NoneType"),
        (None, numpy.zeros((8, 8)), "expected for the maps, not NoneType"),
        ("mine.npy", numpy.zeros((8, 8)), "not the path 'mine.npy'; read the file first"),
        (numpy.zeros((8, 8)), {}, "expected for the truth, not dict"),
    ],
)
def test_what_is_no_array_is_named(map, truth, sentence):
    with pytest.raises(episcope.InvalidInput, match=sentence):
        episcope.score(map, truth)


def test_strokes_of_fractions_are_refused(scene):
    with pytest.raises(episcope.InvalidInput, match="whole numbers"):
        episcope.label(scene, numpy.full((64, 64), 0.5))


def test_epi_is_of_a_row_or_a_column(scene):
    with pytest.raises(episcope.InvalidInput, match="row"):
        episcope.epi(scene)
    with pytest.raises(episcope.InvalidInput):
        episcope.epi(scene, row=64)
    for view in [(5, 0), 3, (0.5, 1)]:
        with pytest.raises(episcope.InvalidInput, match="5×5"):
            episcope.epi(scene, row=0, view=view)
    for row in ["a", 1.5]:
        with pytest.raises(episcope.InvalidInput, match=f"row is {row!r}, but must be a whole number"):
            episcope.epi(scene, row=row)


def test_a_path_is_no_light_field():
    for use in [
        lambda lf: episcope.estimate(lf, "epi_l"),
        lambda lf: episcope.label(lf),
        lambda lf: episcope.epi(lf, row=0),
    ]:
        with pytest.raises(TypeError, match="must be a LightField, not str; episcope.open"):
            use("scene")


def test_disparity_of_labels_is_a_result(scene):
    with pytest.raises(TypeError, match="must be a Result of episcope.estimate, not ndarray"):
        episcope.label(scene, disparity=numpy.zeros((64, 64)))


def test_nothing_but_a_result_is_replaced(scene, tmp_path):
    result = episcope.estimate(scene, "epi_l", views="center")
    (tmp_path / "lf.npy").touch()
    numpy.save(tmp_path / "lf.npy", scene.views)
    with pytest.raises(episcope.IoError, match="is not a result"):
        result.save(tmp_path / "lf.npy")
    result.save(tmp_path / "r.h5")
    result.save(tmp_path / "r.h5")


@pytest.mark.parametrize("form", ["h5", "npy", "npz", "csv", "ply"])
def test_another_result_is_replaced_when_asked(scene, form, tmp_path):
    path = tmp_path / ("r." + form)
    first = episcope.estimate(scene, "epi_l", views="center")
    other = episcope.estimate(scene, "epi_s", views="center")
    first.save(path)
    before = path.read_bytes()
    first.save(path)
    with pytest.raises(episcope.IoError, match="or pass overwrite=True"):
        other.save(path)
    if form != "h5":
        assert path.read_bytes() == before
    other.save(path, overwrite=True)
    assert path.read_bytes() != before


def test_name_that_tells_no_form_is_refused(scene, tmp_path):
    with pytest.raises(episcope.InvalidInput, match="let it end in"):
        episcope.estimate(scene, "epi_l", views="center").save(tmp_path / "r.xyz")
