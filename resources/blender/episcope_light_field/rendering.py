# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Renders a light field, view by view from the center outwards."""

import os

import bpy
import numpy
from mathutils import Matrix

from . import labels
from .changes import Changes
from .folder import PART_NAMES, Folder, view_pattern
from .passes import render_still, render_truth
from .visible_depth import camera_axes

SUFFIX = {"PNG8": ".png", "PNG16": ".png", "EXR": ".exr"}


def _parts(settings):
    parts = []
    if settings.depth:
        parts.append("depth")
        if settings.transparent is not None:
            parts.append("depth_behind")
    if settings.labels != "NONE":
        parts.append("labels")
    if settings.normals:
        parts.append("normals")
    return parts


def _axes(plan):
    return camera_axes(plan.camera, bpy.context.evaluated_depsgraph_get())


def _principal_point(plan):
    """Where the optical axis of the center view meets the image, x right and y down from the outer
    corner of the first pixel."""
    lens, data = plan.grid.lens, plan.camera.data
    scale = lens.shift_unit * lens.focal_px
    return lens.width / 2 - data.shift_x * scale, lens.height / 2 + data.shift_y * scale


def _facts(plan, scene, settings):
    grid = plan.grid
    files = {"views": view_pattern(SUFFIX[settings.picture])}
    files.update({part: PART_NAMES[part] for part in _parts(settings)})
    smallest, largest = plan.disparity_range
    return {
        "scene": os.path.basename(bpy.data.filepath),
        "blender": bpy.app.version_string,
        "grid": {"rows": grid.rows, "columns": grid.columns},
        "size": {"width": grid.lens.width, "height": grid.lens.height},
        "camera": {
            "baseline": grid.baseline,
            "focal_length_px": grid.lens.focal_px,
            "zero_plane": grid.zero_plane,
            "principal_point_px": list(_principal_point(plan)),
            "matrix": [list(row) for row in _axes(plan)],
        },
        "depth_range": [plan.near, plan.far],
        "disparity_range": [smallest, largest],
        "picture": settings.picture,
        "samples": settings.samples,
        "seed": settings.seed,
        "denoise": settings.denoise,
        "engine": scene.render.engine,
        "labels": [] if settings.labels == "NONE" else labels.names(settings.labels, scene),
        "files": files,
    }


class _GridCamera:
    """A camera that is moved from view to view; the user's own is left alone."""

    def __init__(self, changes, scene, plan):
        self._axes = _axes(plan)
        self._grid = plan.grid
        data = plan.camera.data.copy()
        data.animation_data_clear()
        data.dof.use_dof = False
        self._shift = data.shift_x, data.shift_y
        self._object = bpy.data.objects.new("light field view", data)
        scene.collection.objects.link(self._object)
        changes.on_exit(lambda: bpy.data.cameras.remove(data))
        changes.set(scene, camera=self._object)

    def place(self, view):
        right, up = self._grid.offset(*view)
        shift_x, shift_y = self._grid.lens_shift(*view)
        self._object.matrix_world = self._axes @ Matrix.Translation((right, up, 0))
        self._object.data.shift_x = self._shift[0] + shift_x
        self._object.data.shift_y = self._shift[1] + shift_y


def _prepare(changes, scene, settings):
    """What holds for all renders of the light field."""
    render = scene.render
    changes.set(
        render,
        use_motion_blur=False,
        use_border=False,
        use_multiview=False,
        use_compositing=False,
        use_sequencer=False,
        use_file_extension=False,
        use_overwrite=True,
        use_placeholder=False,
        use_persistent_data=True,
        dither_intensity=0,
    )
    layer = bpy.context.view_layer
    changes.set(
        layer,
        use_pass_z=True,
        use_pass_object_index=settings.labels in {"EACH", "OBJECT"},
        use_pass_material_index=settings.labels == "MATERIAL",
        use_pass_normal=settings.normals,
    )
    for other in scene.view_layers:
        changes.set(other, use=other == layer)
    cycles = getattr(scene, "cycles", None)
    if cycles is not None:
        changes.set(
            cycles,
            samples=settings.samples,
            use_denoising=settings.denoise,
            use_animated_seed=False,
        )
    eevee = getattr(scene, "eevee", None)
    if eevee is not None:
        changes.set(eevee, taa_render_samples=settings.samples)


def _render_picture(scene, settings, path, seed):
    with Changes() as changes:
        image = scene.render.image_settings
        is_exr = settings.picture == "EXR"
        changes.set(image, file_format="OPEN_EXR" if is_exr else "PNG", color_mode="RGB")
        changes.set(image, color_depth={"PNG8": "8", "PNG16": "16", "EXR": "32"}[settings.picture])
        changes.set(scene.render, filepath=path)
        if hasattr(scene, "cycles"):
            changes.set(scene.cycles, seed=seed)
        render_still(scene)


def _render_view(scene, settings, grid, folder, view, transparent):
    seed = settings.seed + view[0] * grid.columns + view[1]
    folder.save_picture(view, lambda path: _render_picture(scene, settings, path, seed))
    files = folder.facts["files"]
    truth = {}
    if len(files) > 1:
        temporary = os.path.join(folder.path, ".unfinished_passes.exr")
        truth = render_truth(scene, transparent, temporary)
    for part in truth.keys() & files.keys():
        folder.save_array(part, view, truth[part])
    folder.finish(view, _disparities(grid, truth))


def _disparities(grid, truth):
    """Smallest and largest of a view; None if no depth was rendered."""
    depths = [truth[part] for part in ("depth", "depth_behind") if part in truth]
    known = [depth[numpy.isfinite(depth)] for depth in depths]
    known = [depth for depth in known if depth.size]
    if not known:
        return None
    near, far = min(d.min() for d in known), max(d.max() for d in known)
    return [grid.disparity(float(far)), grid.disparity(float(near))]


def render_light_field(scene, plan, on_view=lambda done, count, view: None):
    """Renders what is missing in the folder of the plan. `on_view` is called after every view; what
    it raises stops rendering, and the folder can be continued. Raises FolderProblem."""
    settings = plan.camera.data.episcope
    transparent = list(settings.transparent.all_objects) if settings.transparent else []
    views = plan.grid.views_from_center()
    with Changes() as changes:
        if settings.labels == "EACH":
            labels.number_objects(changes, scene)
        folder = Folder(plan.folder, _facts(plan, scene, settings))
        _prepare(changes, scene, settings)
        camera = _GridCamera(changes, scene, plan)
        for number, view in enumerate(views):
            if view in folder.complete:
                continue
            camera.place(view)
            _render_view(scene, settings, plan.grid, folder, view, transparent)
            on_view(len(folder.complete), len(views), view)
