# SPDX-License-Identifier: BSD-3-Clause
import ast
import gc
import inspect
import pathlib

import numpy
import pytest

import episcope
from conftest import SCENE


def test_views_have_the_axes_v_u_y_x_c(scene):
    assert scene.views.shape == (5, 5, 64, 64, 3)
    assert scene.views.dtype == numpy.uint8
    assert scene.center == (2, 2)


def test_views_are_no_copy_and_cannot_be_written(scene):
    assert scene.views.__array_interface__["data"][0] == scene.views.__array_interface__["data"][0]
    with pytest.raises(ValueError):
        scene.views[0, 0, 0, 0, 0] = 1


def test_views_outlive_their_light_field():
    views = episcope.demo(SCENE).views
    copy = views.copy()
    gc.collect()
    assert numpy.array_equal(views, copy)


def test_views_in_another_order_are_strided(scene, tmp_path, cli):
    """Columns that are stored from right to left are turned around without moving samples."""
    numpy.save(tmp_path / "mirrored.npy", scene.views[:, ::-1])
    mirrored = episcope.open(tmp_path / "mirrored.npy", axes="vuyxc", flip="u")
    assert numpy.array_equal(mirrored.views, scene.views)


def test_truth_follows_from_the_camera(scene):
    assert scene.truth.shape == (5, 5, 64, 64)
    assert scene.truth.dtype == numpy.float32
    depth = scene.camera.depth(scene.truth)
    # The camera computes in double precision, the truth is stored in single.
    assert numpy.allclose(scene.camera.disparity(depth), scene.truth, atol=1e-5, equal_nan=True)


def test_labels_are_whole_numbers(scene):
    assert scene.labels.shape == (5, 5, 64, 64)
    assert scene.labels.dtype == numpy.int32
    assert scene.labels.min() >= 1


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32", "float64", ">u2"])
def test_array_becomes_a_light_field(scene, dtype):
    given = scene.views.astype(dtype)
    if given.dtype.kind == "f":
        given /= 255
    opened = episcope.LightField(given)
    assert opened.views.shape == scene.views.shape
    assert opened.truth is None
    assert opened.source == ""


def test_array_of_another_order_is_named_by_its_axes(scene):
    moved = numpy.transpose(scene.views, (2, 3, 0, 1, 4))
    assert numpy.array_equal(episcope.LightField(moved, axes="yxvuc").views, scene.views)


def test_gray_array_has_one_channel(scene):
    assert episcope.LightField(scene.views[..., 1]).views.shape == (5, 5, 64, 64, 1)
    assert episcope.LightField(scene.views[:3, :3, ..., 1]).views.shape == (3, 3, 64, 64, 1)


def test_list_of_colored_views_is_read_as_its_file(scene, tmp_path):
    given = scene.views.reshape(25, 64, 64, 3)
    numpy.save(tmp_path / "list.npy", given)
    assert episcope.open(tmp_path / "list.npy").views.shape == (5, 5, 64, 64, 3)
    assert numpy.array_equal(episcope.LightField(given).views, scene.views)
    moved = numpy.transpose(scene.views, (2, 3, 0, 1, 4))
    assert episcope.LightField(moved).views.shape == (5, 5, 64, 64, 3)


def test_array_is_copied(scene):
    given = scene.views.copy()
    opened = episcope.LightField(given)
    given[:] = 0
    assert numpy.array_equal(opened.views, scene.views)


def test_horizontal_epi_is_the_row_of_each_view(scene):
    epi = episcope.epi(scene, row=20)
    assert numpy.allclose(epi, scene.views[2, :, 20] / 255, rtol=1e-6)  # of single precision


def test_vertical_epi_is_the_column_of_each_view(scene):
    epi = episcope.epi(scene, column=9, view=(0, 3))
    assert numpy.allclose(epi, scene.views[:, 3, :, 9] / 255, rtol=1e-6)


def test_random_demo_is_the_same_for_a_seed():
    one, other = (episcope.demo("random?seed=7&size=48&grid=3") for _ in range(2))
    assert numpy.array_equal(one.views, other.views)
    assert not numpy.array_equal(one.views, episcope.demo("random?seed=8&size=48&grid=3").views)


def test_option_that_a_form_lacks_is_noted():
    assert any("snake" in note for note in episcope.open("demo:edge?size=48&grid=3", snake=True).notes)


def test_functions_have_signatures_and_texts():
    for name in episcope.__all__:
        thing = getattr(episcope, name)
        assert thing.__doc__, name
        if not inspect.isclass(thing):
            assert inspect.signature(thing), name
    assert "progress" in inspect.signature(episcope.estimate).parameters


def test_stubs_name_what_there_is():
    stubs = ast.parse(pathlib.Path(episcope.__file__).with_suffix(".pyi").read_text()).body
    named = {stub.name: stub for stub in stubs if isinstance(stub, (ast.ClassDef, ast.FunctionDef))}
    assert set(named) == set(episcope.__all__)
    for name, stub in named.items():
        if isinstance(stub, ast.ClassDef):
            members = {part.name for part in stub.body if isinstance(part, ast.FunctionDef)} - {"__init__"}
            assert members == {part for part in vars(getattr(episcope, name)) if not part.startswith("_")}, name
        else:
            stated = [argument.arg for argument in stub.args.args + stub.args.kwonlyargs]
            real = inspect.signature(getattr(episcope, name)).parameters.values()
            assert stated == [one.name for one in real if one.kind != one.VAR_KEYWORD], name


def test_booleans_are_black_and_white(scene):
    bright = scene.views > 100
    assert numpy.array_equal(episcope.LightField(bright).views, numpy.where(bright, 255, 0))


def test_masked_samples_do_not_count(scene):
    hidden = numpy.zeros(scene.views.shape, bool)
    hidden[:, :, :4] = True
    opened = episcope.LightField(numpy.ma.masked_array(scene.views, hidden))
    assert any("NaN" in note for note in opened.notes)
    nothing = numpy.ma.masked_array(scene.views, False)
    assert numpy.array_equal(episcope.LightField(nothing).views, scene.views)


def test_array_takes_nothing_from_the_current_folder(scene, tmp_path, monkeypatch):
    numpy.save(tmp_path / "array_disparity.npy", scene.truth[2, 2])
    monkeypatch.chdir(tmp_path)
    assert episcope.LightField(scene.views).truth is None
