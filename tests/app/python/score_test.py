# SPDX-License-Identifier: BSD-3-Clause
import numpy
import pytest

import episcope
from conftest import SCENE

# Not of the file, or of the moment.
OTHER = {"file", "seconds", "runtime_class", "method", "view"}


def of_command_line(cli, file, *options):
    answer = cli("evaluate", file, "--truth", "demo:" + SCENE, "--json", "--quiet", *options)
    scores = {**answer["results"][0], "protocol": answer["protocol"], "truth": answer["truth"]}
    return {key: value for key, value in scores.items() if key not in OTHER}


def of_python(scores):
    return {key: value for key, value in scores.items() if key not in OTHER}


@pytest.fixture(scope="module")
def result(scene):
    return episcope.estimate(scene, "epi_l")


@pytest.mark.parametrize("protocol", ["vmv2013", "benchmark2016"])
def test_scores_of_a_result_are_those_of_the_command_line(scene, result, protocol, tmp_path, cli):
    result.save(tmp_path / "r.h5")
    expected = of_command_line(cli, "r.h5", "--protocol", protocol)
    scores = episcope.score(result, scene, protocol=protocol)
    assert of_python(scores) == expected
    assert scores["view"] == (2, 2)
    assert of_python(episcope.score(tmp_path / "r.h5", scene, protocol=protocol)) == expected


@pytest.mark.parametrize("invalid", ["bad", "compatible"])
def test_scores_of_an_array_are_those_of_its_file(scene, result, invalid, tmp_path, cli):
    map = result.disparity[2, 2].copy()
    map[:3] = numpy.nan
    map[30:34, 20:44] = numpy.nan
    numpy.save(tmp_path / "mine.npy", map)
    expected = of_command_line(cli, "mine.npy", "--invalid", invalid)
    assert of_python(episcope.score(map, scene, invalid=invalid)) == expected


def test_array_that_was_stored_otherwise_is_told_as_by_the_command_line(scene, result, tmp_path, cli):
    turned = result.disparity[2, 2].T.copy()
    numpy.save(tmp_path / "mine.npy", turned)
    expected = of_command_line(cli, "mine.npy")
    scores = of_python(episcope.score(turned, scene))
    assert expected["better_reading"]["options"] == "--map-transpose"
    assert len(scores.pop("notes")) == len(expected.pop("notes"))
    assert scores == expected
    assert "better_reading" not in episcope.score(result, scene)


@pytest.mark.parametrize("as_file", [False, True])
def test_map_is_read_as_the_advice_says(scene, result, as_file, tmp_path):
    truly = episcope.score(result, scene)["mse_100"]
    stored = (-100 * result.disparity[2, 2].T).copy()
    numpy.save(tmp_path / "mine.npy", stored)
    map = tmp_path / "mine.npy" if as_file else stored
    reading = {"map_transpose": True, "map_scale": -0.01}
    assert episcope.score(map, scene)["mse_100"] > 100 * truly
    assert episcope.score(map, scene, **reading)["mse_100"] == pytest.approx(truly, rel=1e-3)
    truth = scene.truth[2, 2]
    assert episcope.score(stored, truth, **reading)["mse_100"] == pytest.approx(truly, rel=1e-3)
    assert episcope.score(result, scene, map_scale=2)["mse_100"] > 10 * truly
    with pytest.raises(episcope.InvalidInput, match="map_turn"):
        episcope.score(stored, scene, map_turn=True)


@pytest.mark.parametrize("first", [0, 2, 8])
def test_part_of_a_map_is_found_its_place(scene, first):
    truth = scene.truth[2, 2]
    part = truth[first : first + 56, first : first + 56].copy()  # 4 is the middle
    scores = episcope.score(part, scene)
    assert scores["mse_100"] > 1
    found = scores["better_reading"]["reading"]
    assert found == {"map-down": first - 4, "map-right": first - 4}
    assert episcope.score(part, scene, **found)["mse_100"] < 1e-6


def test_map_on_its_side_is_told():
    oblong = episcope.demo("objects?size=64x48&grid=3")
    turned = oblong.truth[1, 1].T.copy()
    with pytest.raises(episcope.InvalidInput, match="map_transpose=True"):
        episcope.score(turned, oblong)
    assert episcope.score(turned, oblong, map_transpose=True)["mse_100"] < 1e-6


def test_map_that_explains_little_is_told(scene, result, tmp_path, cli):
    noise = numpy.random.default_rng(1).uniform(-1, 1, scene.truth.shape[2:]).astype("float32")
    numpy.save(tmp_path / "mine.npy", noise)
    expected = of_command_line(cli, "mine.npy")
    scores = of_python(episcope.score(noise, scene))
    assert "explains little of the ground truth" in scores["notes"][0]
    assert scores == expected
    assert "notes" not in episcope.score(result, scene)
    assert episcope.score(noise, scene.truth)["notes"] == scores["notes"]


def test_array_of_all_views_is_judged_in_the_center(scene, result):
    whole = episcope.score(result.disparity, scene)
    assert whole["mse_100"] == episcope.score(result, scene)["mse_100"]
    assert whole["all_views"]


def test_what_does_not_fit_is_told_as_by_the_command_line(scene, result):
    swapped = numpy.transpose(result.disparity, (1, 0, 2, 3))
    assert "another order, rows and columns of views exchanged" in episcope.score(swapped, scene)["notes"][0]
    other = episcope.demo("bars?size=64&grid=5")
    assert "estimated from other samples" in episcope.score(result, other)["notes"][0]


def test_order_of_views_is_checked_against_an_array(scene, result):
    swapped = numpy.transpose(result.disparity, (1, 0, 2, 3))
    notes = episcope.score(swapped, scene.truth)["notes"]
    assert "another order, rows and columns of views exchanged" in notes[0]


def test_sentences_name_arguments_of_python(scene, result):
    notes = episcope.score(-result.disparity[2, 2], scene)["notes"]
    assert "map_scale=-1" in notes[0] and "--" not in notes[0]
    with pytest.raises(episcope.InvalidInput, match=r"\(map_resize\)"):
        episcope.score(numpy.zeros((200, 300)), scene)


def test_another_reading_is_told_against_an_array(scene, result):
    scores = episcope.score(-result.disparity[2, 2], scene.truth[2, 2])
    assert scores["better_reading"]["options"] == "--map-scale=-1"
    assert "grey_levels" not in scores["better_reading"]
    assert "values negated" in scores["notes"][0]


def test_another_view_can_be_judged(scene, result):
    scores = episcope.score(result, scene, view=(0, 4))
    error = (scene.truth - result.disparity)[0, 4]
    # The mean of squares is summed in another order.
    assert scores["mse_100"] == pytest.approx(100 * numpy.nanmean(error.astype(float) ** 2), rel=1e-5)


def test_truth_may_be_an_array(scene, result):
    expected = episcope.score(result, scene)["mse_100"]
    assert episcope.score(result, scene.truth)["mse_100"] == expected
    assert episcope.score(result.disparity[2, 2], scene.truth[2, 2])["mse_100"] == expected
    assert episcope.score(result, scene.truth[2, 2])["mse_100"] == expected
    assert episcope.score(result.disparity[2, 2], scene.truth)["mse_100"] == expected
    of_corner = episcope.score(result, scene, view=(0, 0))["mse_100"]
    assert episcope.score(result, scene.truth, view=(0, 0))["mse_100"] == of_corner
    assert episcope.score(result.disparity[0, 0], scene, view=(0, 0))["mse_100"] == of_corner


def test_result_of_one_view_is_judged_in_that_view(scene, tmp_path, cli):
    cli("estimate", "st_ch_s", scene.source, "-o", "r.h5", "--view", "1,2", "--quiet")
    with_truth = episcope.score(tmp_path / "r.h5", scene)
    assert with_truth["view"] == (1, 2)
    assert "notes" not in with_truth
    cli("convert", "r.h5", "r.npy", "--quiet")
    assert episcope.score(tmp_path / "r.npy", scene, view=(1, 2))["mse_100"] == with_truth["mse_100"]
    assert episcope.score(numpy.load(tmp_path / "r.npy"), scene.truth[1, 2])["mse_100"] == pytest.approx(
        with_truth["mse_100"])


def test_masked_values_are_missing(scene, result):
    maps = result.disparity[2, 2].copy()
    hidden = numpy.zeros(maps.shape, bool)
    hidden[:20] = True
    with_nan = numpy.where(hidden, numpy.nan, maps)
    maps[hidden] = 7
    masked = numpy.ma.masked_array(maps, hidden)
    assert episcope.score(masked, scene) == episcope.score(with_nan, scene)
    truth = numpy.ma.masked_array(numpy.where(hidden, 7, scene.truth[2, 2]), hidden)
    assert episcope.score(result, truth)["mse_100"] == episcope.score(
        result, numpy.where(hidden, numpy.nan, scene.truth[2, 2]))["mse_100"]


def test_maps_may_have_an_axis_of_one_channel(scene, result):
    assert episcope.score(result.disparity[..., None], scene) == episcope.score(result.disparity, scene)
    with_truth = episcope.score(result, scene.truth[..., None])
    assert with_truth == episcope.score(result, scene.truth)
    assert episcope.score(result.disparity[2, 2, ..., None], scene) == episcope.score(result.disparity[2, 2], scene)


def test_truth_may_be_a_path(scene, result, tmp_path):
    expected = episcope.score(result, scene)
    result.save(tmp_path / "r.h5")
    assert episcope.score(result, scene.source) == expected
    by_paths = episcope.score(tmp_path / "r.h5", scene.source, view=(2, 2))
    assert by_paths == expected
    with pytest.raises(episcope.IoError, match="no_such"):
        episcope.score(result, tmp_path / "no_such")


def test_truth_has_no_error(scene):
    assert episcope.score(scene.truth, scene)["mse_100"] == 0


def test_result_of_two_layers_has_the_scores_of_the_command_line(tmp_path, cli):
    name = "transparent?size=64&grid=5"
    scene = episcope.demo(name)
    result = episcope.estimate(scene, "epi_two_layer")
    result.save(tmp_path / "r.h5")
    answer = cli("evaluate", "r.h5", "--truth", "demo:" + name, "--json", "--quiet")["results"][0]
    scores = episcope.score(result, scene)
    assert "layers_right" in scores
    assert scores["layers_right"] == answer["layers_right"]
