# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Rendering without a window: options of the command line override what the camera's panel says."""

import argparse
import sys
import time

import bpy

from .folder import FolderProblem
from .passes import RenderProblem
from .plan import BadSettings, make_plan, notes
from .rendering import render_light_field


def _pair(separator, kind, what):
    def parse(text):
        first, found, second = text.partition(separator)
        try:
            if found:
                return kind(first), kind(second)
        except ValueError:
            pass
        raise argparse.ArgumentTypeError(f"'{text}' must be {what}")

    return parse


GRID = _pair("x", int, "rows x columns, as 9x9")
SIZE = _pair("x", int, "width x height in px, as 512x512")
RANGE = _pair(",", float, "two numbers, as -1.5,1.8")


def parser():
    """The options, for whoever adds some of their own."""
    options = argparse.ArgumentParser(
        prog="blender -b SCENE.blend -P episcope_light_field.py --",
        description="Renders a light field with depth and labels of every view; goes on where it "
        "was stopped when the same command is given again.",
    )
    options.add_argument("--out", metavar="DIR", help="the folder to write")
    options.add_argument("--camera", help="name of the camera; without, that of the scene")
    options.add_argument("--grid", type=GRID, metavar="9x9", help="rows and columns of views")
    options.add_argument("--size", type=SIZE, metavar="512x512", help="width and height in px")
    options.add_argument("--baseline", type=float, help="distance of neighbors in scene units")
    options.add_argument("--range", type=RANGE, metavar="A,B", help="wanted disparities in px")
    options.add_argument(
        "--zero", metavar="Z|OBJECT", help="zero plane: depth, or an object's name"
    )
    options.add_argument("--samples", type=int)
    options.add_argument("--seed", type=int)
    options.add_argument("--denoise", action="store_true", default=None)
    options.add_argument("--views", choices=["png8", "png16", "exr"])
    options.add_argument("--labels", choices=["none", "each", "object", "material"])
    options.add_argument("--normals", action="store_true", default=None)
    options.add_argument("--no-depth", action="store_true")
    options.add_argument(
        "--transparent", metavar="COLLECTION", help="depth twice: with and without"
    )
    options.add_argument("--threads", type=int, help="number of threads; without, all cores")
    options.add_argument("--check", action="store_true", help="only say what would be rendered")
    return options


def _named(collection, name, what):
    found = collection.get(name)
    if found is None:
        names = ", ".join(item.name for item in collection) or "none"
        raise BadSettings(f"There is no {what} '{name}'; there are: {names}.")
    return found


def _apply_zero_plane(settings, text):
    try:
        settings.zero_distance = float(text)
        settings.zero_plane = "DISTANCE"
    except ValueError:
        settings.zero_object = _named(bpy.data.objects, text, "object")
        settings.zero_plane = "OBJECT"


def _apply_spacing(settings, given):
    if given.baseline is not None:
        settings.spacing, settings.baseline = "BASELINE", given.baseline
    if given.range is not None:
        settings.disparity_min, settings.disparity_max = given.range
        if given.baseline is None:
            settings.spacing = "RANGE"
        settings.zero_plane = "RANGE"
    if given.zero is not None:
        _apply_zero_plane(settings, given.zero)


def apply_options(scene, given):
    """Raises BadSettings."""
    if given.camera is not None:
        scene.camera = _named(bpy.data.objects, given.camera, "object")
    if scene.camera is None or scene.camera.type != "CAMERA":
        return  # make_plan says so
    settings = scene.camera.data.episcope
    if given.grid:
        settings.rows, settings.columns = given.grid
    if given.size:
        scene.render.resolution_x, scene.render.resolution_y = given.size
        scene.render.resolution_percentage = 100
    _apply_spacing(settings, given)
    for name in ("samples", "seed", "denoise", "normals"):
        if getattr(given, name) is not None:
            setattr(settings, name, getattr(given, name))
    if given.views:
        settings.picture = given.views.upper()
    if given.labels:
        settings.labels = given.labels.upper()
    if given.no_depth:
        settings.depth = False
    if given.transparent:
        settings.transparent = _named(bpy.data.collections, given.transparent, "collection")
    if given.out:
        settings.folder = given.out
    if given.threads:
        scene.render.threads_mode, scene.render.threads = "FIXED", given.threads


def describe(plan):
    smallest, largest = plan.disparity_range
    grid = plan.grid
    return (
        f"{grid.rows}×{grid.columns} views of {grid.lens.width}×{grid.lens.height} px, baseline "
        f"{grid.baseline:.6g}, zero plane {grid.zero_plane:.6g}, depth {plan.near:.4g} … "
        f"{plan.far:.4g}, disparity {smallest:.3f} … {largest:.3f} px"
    )


class _Report:
    """One line for each view."""

    def __init__(self):
        self._start = time.monotonic()
        self._rendered = 0

    def __call__(self, done, count, view):
        self._rendered += 1
        seconds = (time.monotonic() - self._start) / self._rendered
        left = round(seconds * (count - done))
        print(
            f"light field: view {done} of {count} (row {view[0]}, column {view[1]}), "
            f"{seconds:.1f} s a view, {left // 60} min {left % 60} s left",
            flush=True,
        )


def render(scene, given):
    """Renders the scene with options of the `parser`. Gives the exit code."""
    try:
        apply_options(scene, given)
        plan = make_plan(scene, bpy.context.evaluated_depsgraph_get())
        print("light field: " + describe(plan), flush=True)
        for note in notes(scene, plan.camera):
            print("light field: " + note, flush=True)
        if not given.check:
            render_light_field(scene, plan, _Report())
            print(f"light field: complete in {plan.folder}", flush=True)
    except (BadSettings, FolderProblem, RenderProblem) as problem:
        print(f"light field: {problem}", file=sys.stderr, flush=True)
        return 1
    except KeyboardInterrupt:
        print("light field: stopped; the same command goes on.", file=sys.stderr, flush=True)
        return 130
    return 0


def run(arguments):
    """Renders the open file. Gives the exit code."""
    return render(bpy.context.scene, parser().parse_args(arguments))
