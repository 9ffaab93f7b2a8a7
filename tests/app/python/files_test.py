# SPDX-License-Identifier: BSD-3-Clause
"""Other programs read result files, and find there what the numbers mean."""
import re
import shutil
import subprocess

import numpy
import pytest

import episcope

SCENE = "objects?size=64&grid=3"


@pytest.fixture
def result(tmp_path, cli):
    """A result of all views and one of the center view, and the folder they are in."""
    cli("estimate", "epi_two_layer", "demo:" + SCENE, "-o", "all.h5", "--quiet")
    cli("estimate", "plane_pm", "demo:" + SCENE, "-o", "center.h5", "--views", "center", "--quiet")
    return tmp_path


def test_h5py_reads_texts_axes_and_units(result):
    h5py = pytest.importorskip("h5py")
    for name, axes in [("all.h5", "vuyx"), ("center.h5", "yx")]:
        with h5py.File(result / name) as file:
            group = file["estimate"]
            for key in ["method", "parameters", "program", "version", "commit", "date", "device", "source",
                        "source_hash", "source_hash_of", "sign", "axis_order", "depth"]:
                assert isinstance(group.attrs[key], str) and group.attrs[key], key
            assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", group.attrs["date"])
            assert re.fullmatch("[0-9a-f]{16}", group.attrs["source_hash"])
            assert group.attrs["program"] == "Episcope"
            assert group.attrs["seconds"] > 0
            for key, dataset in group.items():
                assert dataset.attrs["units"] and dataset.attrs["long_name"], key
                if dataset.ndim > 1:
                    assert "".join(dimension.label for dimension in dataset.dims) == axes
                    assert [dimension[0].name[-1] for dimension in dataset.dims] == list(axes)
            assert group["disparity"].attrs["units"] == "px per view step"
            assert list(group["x"]) == list(range(64))


def test_depth_follows_from_the_file_alone(result):
    h5py = pytest.importorskip("h5py")
    camera = episcope.demo(SCENE).camera
    with h5py.File(result / "all.h5") as file:
        stated = dict(file["estimate"].attrs)
        depth = stated["dH"] * stated["focalLength"] / (file["estimate/disparity"][1, 1] + stated["shift"])
    assert stated["depth"].startswith("Z = dH * focalLength / (disparity + shift)")
    disparity = episcope.estimate(episcope.demo(SCENE), "epi_two_layer").disparity[1, 1]
    expected = camera.baseline * camera.focal_length / (disparity + camera.shift)
    numpy.testing.assert_allclose(depth, expected, rtol=1e-6)


def test_xarray_shows_axes(result):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    with xarray.open_dataset(result / "all.h5", group="estimate", engine="h5netcdf") as data:
        assert data["disparity"].dims == ("v", "u", "y", "x")
        assert data["disparity"].sel(v=1, u=1, y=10, x=20).shape == ()
        assert list(data["u"].values) == [0, 1, 2]


def test_h5dump_shows_texts_and_axes(result):
    if not shutil.which("h5dump"):
        pytest.skip("there is no h5dump")
    shown = subprocess.run(["h5dump", "-A", "all.h5"], cwd=result, check=True, capture_output=True, text=True).stdout
    assert "DIMENSION_LIST" in shown and '"px per view step"' in shown and '"Episcope"' in shown


def test_octave_reads_maps_and_axes(result):
    if not shutil.which("octave-cli"):
        pytest.skip("there is no Octave")
    code = ("file = load('-hdf5', 'all.h5').estimate;"
            "printf('%d ', size(file.disparity), double(file.y([1 end])));"
            "printf('%.9g', file.disparity(21, 11, 3, 2));")
    printed = subprocess.run(["octave-cli", "--norc", "--eval", code], cwd=result, check=True, capture_output=True, text=True).stdout
    *sizes, value = map(float, printed.split())
    assert sizes == [64, 64, 3, 3, 0, 63]
    expected = episcope.estimate(episcope.demo(SCENE), "epi_two_layer").disparity[1, 2, 10, 20]
    assert value == pytest.approx(expected, rel=1e-7, nan_ok=True)


@pytest.mark.parametrize("form", ["-hdf5", "-v6", "-v7"])
def test_maps_that_octave_saved_are_read_in_its_order(result, form, cli):
    if not shutil.which("octave-cli"):
        pytest.skip("there is no Octave")
    code = ("disparity = load('-hdf5', 'center.h5').estimate.disparity';"
            f"save('{form}', 'mine.bin', 'disparity');")
    subprocess.run(["octave-cli", "--norc", "--eval", code], cwd=result, check=True, capture_output=True)
    (result / "mine.bin").rename(result / ("mine.h5" if form == "-hdf5" else "mine.mat"))
    judged = []
    for name in ["center.h5", "mine.h5" if form == "-hdf5" else "mine.mat"]:
        judged.append(cli("evaluate", name, "--truth", "demo:" + SCENE, "--json", "--quiet")["results"][0])
    assert judged[1]["mse_100"] == pytest.approx(judged[0]["mse_100"], rel=1e-6)


def test_h5py_compresses_by_lzf_as_before(scene, tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "lf.h5", "w") as file:
        file.create_dataset("LF", data=scene.views, compression="lzf", shuffle=True)
    assert numpy.array_equal(episcope.open(tmp_path / "lf.h5").views, scene.views)
