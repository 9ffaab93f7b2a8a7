# SPDX-License-Identifier: BSD-3-Clause
import os
import signal
import subprocess
import threading
import time

import numpy
import pytest

import episcope
from conftest import SCENE


@pytest.mark.parametrize("method", ["epi_l", "epi_c", "st_av_s", "plane_pm", "epi_two_layer"])
def test_numbers_are_those_of_the_command_line(scene, method, tmp_path, cli):
    cli("estimate", method, "demo:" + SCENE, "-o", "cli.h5", "--quiet")
    episcope.estimate(scene, method).save(tmp_path / "python.h5")
    subprocess.run(
        [os.environ["EPISCOPE_SAME_RESULTS"], tmp_path / "cli.h5", tmp_path / "python.h5", "5", "5"], check=True
    )


def test_array_gives_the_numbers_of_its_file(scene, tmp_path, cli):
    numpy.save(tmp_path / "lf.npy", scene.views)
    cli("estimate", "epi_s", "lf.npy", "--axes", "vuyxc", "-o", "cli.h5", "--quiet")
    cli("convert", "cli.h5", "cli.npy", "--quiet")
    result = episcope.estimate(episcope.LightField(scene.views), "epi_s")
    assert numpy.array_equal(result.disparity[2, 2], numpy.load(tmp_path / "cli.npy"))


def test_result_has_maps_of_all_views(scene):
    result = episcope.estimate(scene, "epi_l", range=(-2, 2), threads=1)
    assert result.disparity.shape == result.confidence.shape == (5, 5, 64, 64)
    assert result.disparity.dtype == numpy.float32
    assert 0 <= numpy.nanmin(result.confidence) and numpy.nanmax(result.confidence) <= 1
    assert result.range == (-2, 2)
    assert result.method == "epi_l"
    assert result.parameters["range"] == [-2, 2]
    assert result.view is None
    assert result.seconds > 0


def test_result_of_one_view_is_one_map(scene):
    result = episcope.estimate(scene, "epi_l", views="center")
    assert result.disparity.shape == (64, 64)
    assert result.view == (2, 2)


def test_unknown_pixels_are_nan(scene):
    """A fourth channel is a weight: 0 = nothing was seen there."""
    weight = numpy.full((5, 5, 64, 64, 1), 255, numpy.uint8)
    weight[:, :, :8] = 0
    lf = episcope.LightField(numpy.concatenate([scene.views, weight], axis=4))
    disparity = episcope.estimate(lf, "epi_l").disparity
    assert numpy.isnan(disparity[:, :, :8]).all()
    assert not numpy.isnan(disparity[:, :, 8:]).any()


def test_keyword_that_python_reserves_has_a_line_below(scene):
    result = episcope.estimate(scene, "epi_s", views="center", lambda_=0.5)
    assert result.parameters["lambda"] == 0.5


@pytest.mark.parametrize("form", ["h5", "pfm", "tif", "npy", "npz", "mat", "csv", "ply"])
def test_result_is_saved_as_its_name_says(scene, form, tmp_path):
    result = episcope.estimate(scene, "epi_l")
    path = tmp_path / ("map." + form)
    result.save(path)
    assert path.stat().st_size > 0
    if form == "npy":
        assert numpy.array_equal(numpy.load(path), result.disparity[2, 2])


def test_progress_is_reported_to_its_end(scene):
    seen = []
    episcope.estimate(scene, "plane_pm", progress=lambda fraction, step: seen.append((fraction, step)))
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] and fractions[-1] <= 1
    assert any(step for _, step in seen)


def test_exception_of_the_listener_ends_the_estimate(scene):
    def stop(fraction, step):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        episcope.estimate(scene, "plane_pm", progress=stop)


@pytest.fixture(scope="module")
def slow_scene():
    """Large enough that a method takes seconds."""
    return episcope.demo("objects?size=256&grid=9")


def test_interrupt_ends_the_estimate(slow_scene):
    sent = []

    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.3, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        episcope.estimate(slow_scene, "epi_g")
    # 200 ms are promised; a loaded machine gets more.
    assert time.monotonic() - sent[0] < 2


def test_other_threads_go_on_meanwhile(slow_scene):
    count = 0
    over = threading.Event()

    def work():
        nonlocal count
        while not over.wait(0.005):
            count += 1

    other = threading.Thread(target=work)
    other.start()
    before = time.monotonic()
    episcope.estimate(slow_scene, "epi_s", views="center")
    seconds = time.monotonic() - before
    over.set()
    other.join()
    # With the lock held throughout there would be none.
    assert count > 10 * seconds


def test_methods_are_those_of_the_command_line(cli):
    assert episcope.methods() == cli("methods", "--json")["results"]
