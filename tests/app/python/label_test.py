# SPDX-License-Identifier: BSD-3-Clause
import numpy
import pytest

import episcope
from conftest import SCENE


@pytest.fixture(scope="module")
def strokes(scene):
    """[y, x]: a few true labels of the center view."""
    painted = numpy.zeros((64, 64), numpy.int32)
    painted[::9, ::2] = scene.labels[2, 2, ::9, ::2]
    return painted


@pytest.fixture(scope="module")
def labeling(scene, strokes):
    return episcope.label(scene, strokes, features="image", trees=16)


def test_every_pixel_has_a_painted_label(scene, strokes, labeling):
    assert labeling.labels.shape == scene.labels.shape
    assert labeling.ids == sorted(set(strokes.flat) - {0})
    assert set(numpy.unique(labeling.labels)) <= set(labeling.ids)


def test_scores_compare_with_the_true_labels(scene, labeling):
    assert labeling.scores["accuracy_all_views"] == pytest.approx((labeling.labels == scene.labels).mean())


def test_strokes_may_be_named_by_their_view(scene, strokes, labeling):
    same = episcope.label(scene, {(2, 2): strokes.astype(float)}, features="image", trees=16)  # as MATLAB has them
    assert numpy.array_equal(same.labels, labeling.labels)
    all_views = numpy.zeros(scene.labels.shape, numpy.uint8)
    all_views[2, 2] = strokes
    same = episcope.label(scene, all_views, features="image", trees=16)
    assert numpy.array_equal(same.labels, labeling.labels)


def test_disparity_may_be_given(scene, strokes):
    given = episcope.estimate(scene, "net", corners=False)
    one = episcope.label(scene, strokes, disparity=given, trees=16)
    # That is what estimates it by default.
    assert numpy.array_equal(one.labels, episcope.label(scene, strokes, trees=16).labels)


def test_scores_are_those_of_the_command_line(tmp_path, cli):
    """The demo has strokes of its own."""
    demo = episcope.demo("demo?size=64&grid=3")
    labeling = episcope.label(demo, features="image", trees=16)
    answer = cli(
        "label", "demo:demo?size=64&grid=3", "-o", "cli.h5", "--features", "image", "--trees", "16", "--json", "--quiet"
    )
    for key, share in labeling.scores.items():
        assert answer[key] == share, key


def test_labels_are_saved_and_replace_nothing_else(strokes, labeling, tmp_path):
    for _ in range(2):
        labeling.save(tmp_path / "labels.h5")
    others = episcope.label(episcope.demo(SCENE), {(2, 2): strokes}, features="image", trees=8)
    with pytest.raises(episcope.IoError, match="with trees 16; choose another name, or pass overwrite=True"):
        others.save(tmp_path / "labels.h5")
    others.save(tmp_path / "labels.h5", overwrite=True)
    more = strokes.copy()
    more[strokes == strokes.max()] = 0
    fewer = episcope.label(episcope.demo(SCENE), more, features="image", trees=8)
    with pytest.raises(episcope.IoError, match="labels of other strokes, disparity or probabilities; choose"):
        fewer.save(tmp_path / "labels.h5")
    (tmp_path / "other.h5").write_text("mine")
    with pytest.raises(episcope.IoError, match="not a file of labels"):
        labeling.save(tmp_path / "other.h5")


def test_what_contradicts_is_told(scene, strokes):
    others = episcope.label(scene, 85 * strokes, features="image", trees=4).notes
    assert any("GT_LABELS do not have label" in note for note in others)
    assert any("once labels are matched by overlap" in note for note in others)
    given = episcope.estimate(episcope.demo("bars?size=64&grid=5"), "epi_l")
    notes = episcope.label(scene, strokes, disparity=given, trees=4).notes
    assert any("estimated from other samples" in note for note in notes)


def test_labels_are_no_other_form(labeling, tmp_path):
    with pytest.raises(episcope.InvalidInput, match="labels are saved as HDF5; let the name end in .h5"):
        labeling.save(tmp_path / "labels.npy")


def test_ids_beyond_32_bits_are_refused(scene, strokes):
    with pytest.raises(episcope.InvalidInput, match="at most 2147483646"):
        episcope.label(scene, numpy.where(strokes > 0, strokes.astype("int64") + 2**32, 0), trees=16)
    with pytest.raises(episcope.InvalidInput, match="at most 2147483646"):
        episcope.label(scene, numpy.where(strokes > 0, strokes.astype(float) + 2**32, 0), trees=16)


def test_ignored_numbers_and_nan_are_unpainted(scene, strokes, labeling):
    other = numpy.where(strokes == 0, numpy.nan, strokes)
    other[1, 1], other[1, 3], other[2, 5] = 255, -1, numpy.nan
    same = episcope.label(scene, other, ignore=[255], features="image", trees=16)
    assert same.ids == labeling.ids
    assert numpy.array_equal(same.labels, labeling.labels)


def test_255_is_unlabeled_unless_it_says_otherwise(scene, strokes, labeling):
    other = strokes.copy()
    other[1::9] = 255
    same = episcope.label(scene, other, features="image", trees=16)
    assert numpy.array_equal(same.labels, labeling.labels)
    assert "255 is taken for unlabeled" in same.notes
    assert 255 in episcope.label(scene, other, ignore=(), features="image", trees=16).ids


def test_masked_strokes_are_unpainted(scene, strokes, labeling):
    hidden = strokes == 0
    masked = numpy.ma.masked_array(numpy.where(hidden, 7, strokes), hidden)
    assert numpy.array_equal(episcope.label(scene, masked, features="image", trees=16).labels, labeling.labels)
