# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""From settings to a grid of cameras, or to a sentence that says what is wrong with them."""

import math
import os
from dataclasses import dataclass

import bpy

from . import labels, visible_depth
from .camera_grid import CameraGrid, baseline_for_range, zero_plane_for_range


class BadSettings(Exception):
    """A sentence for the user."""


@dataclass(frozen=True)
class Plan:
    """A light field that can be rendered."""

    camera: object  # bpy.types.Object
    grid: CameraGrid
    near: float
    far: float
    folder: str

    @property
    def disparity_range(self):
        return self.grid.disparity(self.far), self.grid.disparity(self.near)


def light_field_camera(scene):
    """The camera of the scene. Raises BadSettings."""
    camera = scene.camera
    if camera is None or camera.type != "CAMERA":
        raise BadSettings(
            "The scene has no camera; add one and make it the active camera (Ctrl+Numpad 0)."
        )
    if camera.data.type != "PERSP":
        kind = "orthographic" if camera.data.type == "ORTHO" else "panoramic"
        raise BadSettings(
            f"The camera '{camera.name}' is {kind}, but light fields need perspective; change Type "
            "under Camera properties, Lens."
        )
    render = scene.render
    if not math.isclose(render.pixel_aspect_x, render.pixel_aspect_y):
        raise BadSettings(
            "Pixels are not square; set both values of Aspect under Output properties, Format, "
            "to 1."
        )
    return camera


def notes(scene, camera):
    """Sentences about what is rendered in another way than the scene would be."""
    told = []
    if camera.data.dof.use_dof:
        told.append("Depth of field is left out: a light field is sharp, and can be focused later.")
    if scene.render.use_motion_blur:
        told.append("Motion blur is left out: all views show the same moment.")
    return told


def measured_range(scene, camera, depsgraph):
    """Raises BadSettings if the camera sees no surface."""
    seen = visible_depth.visible_range(scene, camera, depsgraph)
    if seen is None:
        raise BadSettings(
            f"The camera '{camera.name}' sees no surface: all objects are behind it or outside its "
            "view; turn it towards the scene (it looks along its local -Z)."
        )
    return seen


def _depth_of_object(camera, target, depsgraph):
    axes = visible_depth.camera_axes(camera, depsgraph)
    place = target.evaluated_get(depsgraph).matrix_world.translation
    depth = -(axes.inverted() @ place).z
    if depth <= 0:
        raise BadSettings(
            f"The object '{target.name}' of the zero plane is behind the camera; choose "
            "another one."
        )
    return depth


def _baseline(settings, near, far, lens):
    if settings.spacing == "BASELINE":
        if settings.baseline <= 0:
            raise BadSettings("The baseline is 0, so that all views are the same; enlarge it.")
        return settings.baseline
    width = settings.disparity_max - settings.disparity_min
    if width <= 0:
        raise BadSettings(
            f"The disparity range {settings.disparity_min:g} … {settings.disparity_max:g} px is "
            "empty; the largest must exceed the smallest."
        )
    if far <= near * (1 + 1e-6):
        raise BadSettings(
            f"All that the camera sees has the depth {near:g}, which any baseline gives one "
            "disparity; set the baseline instead of the range."
        )
    return baseline_for_range(width, near, far, lens.focal_px)


def _zero_plane(settings, camera, near, baseline, lens, depsgraph):
    if settings.zero_plane == "DISTANCE":
        if settings.zero_distance <= 0:
            raise BadSettings("The zero plane has the distance 0; enlarge it.")
        return settings.zero_distance
    if settings.zero_plane == "OBJECT":
        if settings.zero_object is None:
            raise BadSettings("No object is chosen for the zero plane; choose one.")
        return _depth_of_object(camera, settings.zero_object, depsgraph)
    plane = zero_plane_for_range(settings.disparity_max, near, baseline, lens.focal_px)
    if not 0 < plane < float("inf"):
        raise BadSettings(
            f"No plane in front of the camera gives the nearest depth {near:g} the disparity "
            f"{settings.disparity_max:g} px at the baseline {baseline:g}; make the largest "
            "disparity smaller, or the baseline larger."
        )
    return plane


def grid_of(settings, scene, camera, seen, depsgraph):
    """The grid for depths `seen` = (near, far). Raises BadSettings."""
    near, far = seen
    lens = visible_depth.lens_of(scene, camera)
    baseline = _baseline(settings, near, far, lens)
    plane = _zero_plane(settings, camera, near, baseline, lens, depsgraph)
    return CameraGrid(settings.rows, settings.columns, baseline, plane, lens)


def _folder(settings):
    if not settings.folder:
        raise BadSettings("No folder is chosen; choose where to write the light field.")
    if settings.folder.startswith("//") and not bpy.data.filepath:
        raise BadSettings(
            "The folder is beside the .blend file, which is not saved yet; save it, or choose a "
            "folder by its full path."
        )
    return os.path.normpath(bpy.path.abspath(settings.folder))


def make_plan(scene, depsgraph):
    """Raises BadSettings."""
    camera = light_field_camera(scene)
    settings = camera.data.episcope
    if problem := labels.problem(settings.labels, scene):
        raise BadSettings(problem)
    if settings.transparent is not None and not settings.transparent.all_objects:
        raise BadSettings(
            f"The collection '{settings.transparent.name}' of transparent objects is empty; move "
            "the objects there, or clear the field."
        )
    seen = measured_range(scene, camera, depsgraph)
    grid = grid_of(settings, scene, camera, seen, depsgraph)
    return Plan(camera, grid, *seen, _folder(settings))
