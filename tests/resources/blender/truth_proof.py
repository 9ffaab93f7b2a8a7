# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Depth, disparity and labels that the add-on writes, against an analytic scene."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy

import proof

# Sensor fit, lens shift of the user, size, grid.
LENSES = (
    ("AUTO", (0, 0), "240x180", "5x5"),
    ("HORIZONTAL", (0.06, -0.04), "120x160", "3x4"),
    ("VERTICAL", (-0.03, 0.05), "160x120", "2x3"),
)
# Of a smaller light field with less noise.
WARPED_CENTER = (1, 1)
NEIGHBOURS = ((0, 1), (2, 1), (1, 0), (1, 2))
DEPTH_TOLERANCE = 1e-4  # relative
MOST_OVER_NOISE = 1.5
LEAST_AGREEMENT = 0.999
SAME_SURFACE = 0.005  # relative difference of depths


def prove_depth(folder, manifest):
    worst = 0.0
    for view in manifest["complete"]:
        expected, surface = proof.exact(manifest, view)
        depth = proof.array(folder, manifest, "depth", view)
        is_safe = proof.away_from_edges(surface)
        assert is_safe.mean() > 0.5, "the scene leaves too little to compare"
        worst = max(worst, (abs(depth - expected) / expected)[is_safe].max())
    print(f"proof: depth differs by {worst:.2e} at most, allowed {DEPTH_TOLERANCE:.0e}")
    assert worst <= DEPTH_TOLERANCE


def prove_disparity(folder, manifest, noise):
    """The neighbors of the center, warped with the truth, leave the noise of rendering."""
    center = proof.picture(folder, manifest, WARPED_CENTER)
    depth, surface = proof.exact(manifest, WARPED_CENTER)
    d = proof.disparity(manifest, depth)
    is_safe = proof.away_from_edges(surface, reach=6)
    y, x = numpy.nonzero(is_safe)
    spread = noise[is_safe].std() / numpy.sqrt(2)
    for view in NEIGHBOURS:
        image = proof.picture(folder, manifest, view)
        at_x = x - d[y, x] * (view[1] - WARPED_CENTER[1])
        at_y = y - d[y, x] * (view[0] - WARPED_CENTER[0])
        left = (proof.sampled(image, at_x, at_y) - center[y, x]).std()
        unwarped = (image[y, x] - center[y, x]).std()
        print(
            f"proof: view {view} leaves {left:.3f} grey levels, {left / spread:.2f} times the "
            f"noise of {spread:.3f}; unwarped {unwarped:.3f}"
        )
        assert left <= MOST_OVER_NOISE * spread
        assert unwarped > 2 * left, "the scene has too little texture to prove anything"


def prove_labels(folder, manifest):
    """Every pixel of every view, carried to the center along the truth."""
    center = manifest["complete"][0]
    center_depth = proof.array(folder, manifest, "depth", center)
    center_labels = proof.array(folder, manifest, "labels", center)
    height, width = center_labels.shape
    y, x = numpy.mgrid[0:height, 0:width]
    seen = agreeing = 0
    for view in manifest["complete"]:
        depth = proof.array(folder, manifest, "depth", view)
        labels = proof.array(folder, manifest, "labels", view)
        d = proof.disparity(manifest, depth)
        at_x = numpy.rint(x + d * (view[1] - center[1])).astype(int)
        at_y = numpy.rint(y + d * (view[0] - center[0])).astype(int)
        is_inside = (at_x >= 0) & (at_x < width) & (at_y >= 0) & (at_y < height)
        at_x, at_y = at_x[is_inside], at_y[is_inside]
        ours = depth[is_inside]
        is_visible = abs(center_depth[at_y, at_x] - ours) <= SAME_SURFACE * ours
        seen += is_visible.sum()
        agreeing += (is_visible & (center_labels[at_y, at_x] == labels[is_inside])).sum()
    print(f"proof: labels agree on {100 * agreeing / seen:.4f} % of {seen} visible pixels")
    assert seen > 0.5 * len(manifest["complete"]) * height * width
    assert agreeing >= LEAST_AGREEMENT * seen


def main():
    (work,) = proof.arguments(1)
    proof.fresh_folder(work)
    scene = proof.build_scene()
    camera = scene.camera.data
    for fit, shift, size, grid in LENSES:
        camera.sensor_fit, camera.shift_x, camera.shift_y = fit, *shift
        folder = os.path.join(work, fit.lower())
        options = ["--size", size, "--grid", grid, "--range=-1.4,1.6", "--samples", "1"]
        manifest = proof.render(scene, folder, *options)
        names = [label["name"] for label in manifest["labels"]]
        assert names == ["ball 0", "ball 1", "square", "wall"], names
        prove_depth(folder, manifest)
        prove_labels(folder, manifest)

    camera.sensor_fit, camera.shift_x, camera.shift_y = "AUTO", 0, 0
    common = ["--size", "240x180", "--range=-1.4,1.6", "--views", "png16", "--samples", "64"]
    folder, again = os.path.join(work, "colors"), os.path.join(work, "again")
    manifest = proof.render(scene, folder, *common, "--grid", "3x3")
    other = proof.render(scene, again, *common, "--grid", "1x1", "--seed", "5000")
    noise = proof.picture(folder, manifest, WARPED_CENTER) - proof.picture(again, other, (0, 0))
    prove_disparity(folder, manifest, noise)


main()
